// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/momentum_balance.hpp"

#include "contact/sphere_sphere/shared_motion.hpp"
#include "geometry/base/state_archive.hpp"
#include "geometry/base/vector_width.hpp"

#include <algorithm>
#include <span>

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
  for (std::size_t i = 0; i < parts.size(); ++i) parts[i] += other.parts[i];
  reach = std::max(reach, other.reach);
  return *this;
}

Vec3 MomentumBalance::NodeSums::vector(Part first) const noexcept {
  const auto i = static_cast<std::size_t>(first);
  return {parts[i].value(), parts[i + 1].value(), parts[i + 2].value()};
}

/// @param node_at  place of node i of so many, at most a chunk
template <class NodeAt>
MomentumBalance::NodeSums MomentumBalance::sum_of(const InnerForces& inner, const NodeAt& node_at,
                                                  std::size_t count) const {
  constexpr std::size_t kChunk = geometry::ParallelSum<NodeSums>::kChunk;
  std::array<std::array<double, kChunk>, 8> of_nodes;
  const auto set = [&](std::size_t i, NodeSums::Part first, const Vec3& vector) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      of_nodes[static_cast<std::size_t>(first) + axis][i] = vector[static_cast<int>(axis)];
  };
  NodeSums sums;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t node = node_at(i);
    const Vec3& force = inner.forces.force[node];
    const Vec3& torque = inner.forces.torque[node];
    const Vec3 lever = inner.position[node] - sums_.about;
    const double magnitude = force.norm();
    set(i, NodeSums::force, force);
    set(i, NodeSums::moment, lever.cross(force) + torque);
    of_nodes[NodeSums::of_forces][i] = magnitude;
    of_nodes[NodeSums::of_moments][i] = lever.norm() * magnitude + torque.norm();
    if (magnitude > 0.0) sums.reach = std::max(sums.reach, lever.norm());
  }
  geometry::with_widest_vectors([&](auto width) __attribute__((always_inline)) {
    const std::size_t whole = (count + width - 1) / width * width;
    for (std::size_t part = 0; part < of_nodes.size(); ++part) {
      for (std::size_t i = count; i < whole; ++i) of_nodes[part][i] = 0.0;
      sums.parts[part].template add<width>(of_nodes[part].data(), whole);
    }
  });
  return sums;
}

MomentumBalance::NodeSums MomentumBalance::node_sums(const InnerForces& inner,
                                                     geometry::ThreadPool& pool) {
  if (inner.shared == nullptr) {
    return sum_(inner.position.size(), pool, [&](std::size_t begin, std::size_t end, int) {
      return sum_of(
          inner, [begin](std::size_t i) { return begin + i; }, end - begin);
    });
  }
  const auto sum_over = [&](std::span<const geometry::NodeId> nodes) {
    return sum_(nodes.size(), pool, [&](std::size_t begin, std::size_t end, int) {
      return sum_of(
          inner, [&](std::size_t i) { return geometry::index_of(nodes[begin + i]); }, end - begin);
    });
  };
  NodeSums sums = sum_over(inner.shared->common());
  inner.shared->add_up(sum_over(inner.shared->own()), sums);
  return sums;
}

void MomentumBalance::look(const InnerForces& inner, geometry::ThreadPool& pool) {
  const NodeSums sums = node_sums(inner, pool);
  ForceAndMoment made{sums.vector(NodeSums::force), sums.vector(NodeSums::moment)};
  const double force = sums.parts[NodeSums::of_forces].value();
  const double moment = sums.parts[NodeSums::of_moments].value();
  double reach = sums.reach;
  for (std::size_t i = 0; i < inner.planes.size(); ++i) {
    const contact::PlaneAction& action = inner.contacts.on_plane(i);
    made.add(inner.planes[i].point - sums_.about, action.force, action.moment);
  }
  inner.ties.for_each_on_fixed_point([&](const Vec3& place, const Vec3& pull) {
    const Vec3 lever = place - sums_.about;
    made.add(lever, pull, Vec3::Zero());
    reach = std::max(reach, lever.norm());
  });
  sums_.linear += inner.kick * made.force;
  sums_.angular += inner.kick * made.moment;
  sums_.most_linear = std::max(sums_.most_linear, sums_.linear.norm());
  sums_.most_angular = std::max(sums_.most_angular, sums_.angular.norm());
  sums_.carried_linear += inner.kick * (force + inner.carried);
  sums_.carried_angular += inner.kick * (moment + reach * inner.carried);
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
