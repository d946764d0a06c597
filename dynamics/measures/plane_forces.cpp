// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/plane_forces.hpp"

#include <algorithm>

namespace plekton::dynamics {

ForceAndMoment force_on_plane(const contact::Contacts& contacts, geometry::Positions x,
                              std::size_t plane, const Vec3& about) {
  ForceAndMoment sum;
  contacts.for_each_plane_record(x, [&](const contact::ContactRecord& row) {
    if (static_cast<std::size_t>(row.b.index) == plane)
      sum.add(row.point - about, row.force(), row.moment);
  });
  return sum;
}

double push_on_plane(const contact::Contacts& contacts, std::size_t plane) {
  double sum = 0.0;
  contacts.for_each_plane_force([&](std::size_t other, const Vec3&, double push) {
    if (other == plane) sum += push;
  });
  return sum;
}

void add_plane_reactions(const contact::Contacts& contacts, std::span<PlaneReaction> reactions) {
  contacts.for_each_plane_force([&](std::size_t plane, const Vec3& force, double push) {
    reactions[plane].force += force;
    reactions[plane].push += push;
  });
}

double power_on_turning(const contact::Contacts& contacts, std::span<const contact::Plane> planes,
                        geometry::Positions x) {
  if (std::ranges::none_of(planes, &contact::Plane::turns)) return 0.0;
  double power = 0.0;
  contacts.for_each_plane_record(x, [&](const contact::ContactRecord& row) {
    const contact::Plane& plane = planes[static_cast<std::size_t>(row.b.index)];
    const Vec3 lever = row.point - plane.point;
    power += plane.turning().dot(lever.cross(row.force()) + row.moment);
  });
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
