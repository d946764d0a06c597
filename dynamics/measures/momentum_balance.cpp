// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/momentum_balance.hpp"

#include "geometry/base/state_archive.hpp"

#include <algorithm>

namespace plekton::dynamics {
namespace {

double over(double part, double whole) noexcept {
  return whole > 0.0 ? part / whole : 0.0;
}

}  // namespace

MomentumBalance::MomentumBalance(geometry::Positions start) noexcept {
  if (start.empty()) return;
  Vec3 low = start[0], high = start[0];
  for (const Vec3& x : start) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  sums_.about = low + 0.5 * (high - low);
}

MomentumBalance::NodeSums& MomentumBalance::NodeSums::operator+=(const NodeSums& other) noexcept {
  made.force += other.made.force;
  made.moment += other.made.moment;
  force += other.force;
  moment += other.moment;
  reach = std::max(reach, other.reach);
  return *this;
}

MomentumBalance::NodeSums MomentumBalance::node_sums(const InnerForces& inner,
                                                     geometry::ThreadPool& pool) {
  const Vec3 about = sums_.about;
  return sum_(inner.position.size(), pool, [&](std::size_t begin, std::size_t end, int) {
    NodeSums sums;
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3& force = inner.forces.force[i];
      const Vec3& torque = inner.forces.torque[i];
      const Vec3 lever = inner.position[i] - about;
      const double magnitude = force.norm();
      sums.made.add(lever, force, torque);
      sums.force += magnitude;
      sums.moment += lever.norm() * magnitude + torque.norm();
      if (magnitude > 0.0) sums.reach = std::max(sums.reach, lever.norm());
    }
    return sums;
  });
}

void MomentumBalance::look(const InnerForces& inner, geometry::ThreadPool& pool) {
  NodeSums sums = node_sums(inner, pool);
  inner.contacts.for_each_plane_record(inner.position, [&](const contact::ContactRecord& row) {
    const Vec3 lever = row.point - sums_.about;
    sums.made.add(lever, row.force(), row.moment);
    sums.reach = std::max(sums.reach, lever.norm());
  });
  inner.ties.for_each_on_fixed_point([&](const Vec3& place, const Vec3& force) {
    const Vec3 lever = place - sums_.about;
    sums.made.add(lever, force, Vec3::Zero());
    sums.reach = std::max(sums.reach, lever.norm());
  });
  sums_.linear += inner.kick * sums.made.force;
  sums_.angular += inner.kick * sums.made.moment;
  sums_.most_linear = std::max(sums_.most_linear, sums_.linear.norm());
  sums_.most_angular = std::max(sums_.most_angular, sums_.angular.norm());
  sums_.carried_linear += inner.kick * (sums.force + inner.carried);
  sums_.carried_angular += inner.kick * (sums.moment + sums.reach * inner.carried);
}

MomentumDrift MomentumBalance::drift() const noexcept {
  return {over(sums_.most_linear, sums_.carried_linear),
          over(sums_.most_angular, sums_.carried_angular)};
}

void MomentumBalance::exchange(const geometry::StateArchive& archive) {
  archive("about", sums_.about);
  archive("linear", sums_.linear);
  archive("angular", sums_.angular);
  archive("most_linear", sums_.most_linear);
  archive("most_angular", sums_.most_angular);
  archive("carried_linear", sums_.carried_linear);
  archive("carried_angular", sums_.carried_angular);
}

}  // namespace plekton::dynamics
