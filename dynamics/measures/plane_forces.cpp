// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/plane_forces.hpp"

#include <algorithm>

namespace plekton::dynamics {

double power_on_turning(const contact::Contacts& contacts, std::span<const contact::Plane> planes) {
  double power = 0.0;
  for (std::size_t i = 0; i < planes.size(); ++i)
    if (planes[i].turns()) power += planes[i].turning().dot(contacts.on_plane(i).moment);
  return power;
}

PlanePress press_on_plane(const contact::Contacts& contacts, std::span<const contact::Plane> planes,
                          std::size_t plane, double way, geometry::Positions x) {
  PlanePress press;
  contacts.for_each_near_plane_pair(
      way, planes, x, [&](NodeId, std::size_t near, const contact::PairSprings& pair, double gap) {
        if (near != plane || !(gap < way)) return;
        press.force += pair.normal_force(gap - way);
        press.stiffness += pair.stiffness(gap - way).normal;
        if (gap < 0.0) press.damping += pair.stiffness(gap).normal_damping;
      });
  return press;
}

double fastest_on_planes(std::span<const contact::Plane> planes, geometry::Positions x) {
  double fastest = 0.0;
  for (const contact::Plane& plane : planes) {
    fastest = std::max(fastest, plane.speed());
    if (!plane.turns()) continue;
    for (const Vec3& place : x) fastest = std::max(fastest, plane.velocity_at(place).norm());
  }
  return fastest;
}

}  // namespace plekton::dynamics
