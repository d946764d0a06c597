// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/node_state.hpp"
#include "dynamics/structure/beam_kernel.hpp"
#include "geometry/base/lanes.hpp"
#include "geometry/base/rows.hpp"

#include <array>
#include <cstdint>

/// Bonds in rows, so that a processor computes as many at once as its vectors have lanes.
namespace plekton::dynamics {

using geometry::Pack;

/// Sum of what bonds do to a node.
struct alignas(64) BeamSum {
  Vec3 force = Vec3::Zero();     ///< N
  Vec3 torque = Vec3::Zero();    ///< N m
  std::array<double, 2> unused;  ///< any numbers
};
static_assert(sizeof(BeamSum) == 64);

/// Bonds that are computed one after the other or side by side.
struct alignas(64) BeamRow {
  static constexpr std::size_t kLanes = 8;
  using LaneNodes = std::array<NodeId, kLanes>;
  using LaneMembers = std::array<std::uint32_t, kLanes>;

  geometry::RowsOf<BeamSpringOf<double>, kLanes> spring;
  std::array<LaneNodes, 2> nodes;      ///< a and b
  std::array<LaneMembers, 2> members;  ///< which sums of the block are theirs
  // Of the last step:
  geometry::RowsOf<double, kLanes> tension;  ///< N
  geometry::RowsOf<double, kLanes> energy;   ///< J

  std::size_t node(std::size_t side, std::size_t lane) const noexcept {
    return index_of(nodes[side][lane]);
  }
};
static_assert(sizeof(BeamRow) == 8 * 128);

namespace detail {

template <class Part>
using PackOf = typename Part::Pack;

/// A position as four numbers, x, y, y, z: nothing behind it is read.
template <class Part>
PLEKTON_INLINE PackOf<Part> part_of_position(const Vec3& position, Part part) noexcept {
  const double* const x = position.data();
  if constexpr (sizeof(PackOf<Part>) == sizeof(Pack<4>))
    return geometry::side_by_side(Pack<2>::load(x), Pack<2>::load(x + 1));
  else
    return PackOf<Part>::load(x + part.first / 2);
}

/// The chords of W bonds. Differences are taken before the numbers change places.
template <int W>
PLEKTON_INLINE PackVec3<Pack<W>> chords(const BeamRow& row, std::size_t first,
                                        const Vec3* positions) noexcept {
  const auto [x, y, y_too, z] = geometry::gather_things<W, 4>([&](
      std::size_t lane, auto part) __attribute__((always_inline)) {
    return part_of_position(positions[row.node(1, first + lane)], part) -
           part_of_position(positions[row.node(0, first + lane)], part);
  });
  return {x, y, z};
}

/// The orientations of the nodes at one side of W bonds.
template <int W>
PLEKTON_INLINE QuatOf<Pack<W>> turns(const BeamRow& row, std::size_t side, std::size_t first,
                                     const Quat* orientations) noexcept {
  const auto [x, y, z, w] = geometry::gather_things<W, 4>([&](
      std::size_t lane, auto part) __attribute__((always_inline)) {
    return PackOf<decltype(part)>::load(orientations[row.node(side, first + lane)].coeffs().data() +
                                        part.first);
  });
  return {x, y, z, w};
}

inline QuatOf<double> numbers_of(const Quat& q) noexcept {
  return {q.x(), q.y(), q.z(), q.w()};
}

}  // namespace detail

/// The ends of one bond.
inline BeamEndsOf<double> ends_of(const BeamRow& row, std::size_t lane,
                                  const NodeState& state) noexcept {
  const std::size_t a = row.node(0, lane);
  const std::size_t b = row.node(1, lane);
  const Vec3 chord = state.position[b] - state.position[a];
  return {{chord[0], chord[1], chord[2]},
          detail::numbers_of(state.orientation[a]),
          detail::numbers_of(state.orientation[b])};
}

/// One step of W bonds from a lane on.
/// @returns whether all of them could be computed side by side; otherwise nothing has been done
template <int W>
PLEKTON_INLINE bool advance_side_by_side(BeamRow& row, std::size_t first, const NodeState& state,
                                         BeamSum* sums) noexcept {
  using Real = Pack<W>;
  const auto spring = row.spring.template load<BeamSpringOf<Real>>(first);
  const BeamEndsOf<Real> ends{detail::chords<W>(row, first, state.position.data()),
                              detail::turns<W>(row, 0, first, state.orientation.data()),
                              detail::turns<W>(row, 1, first, state.orientation.data())};
  const BeamPoseOf<Real> pose = beam_pose(spring, ends);
  if (bits_of(geometry::flag(pose.length > Real(0.0))) != geometry::kAllBits<W>) return false;

  const BeamReactionOf<Real> answer = beam_reaction(spring, pose);
  row.tension.store(first, answer.tension);
  row.energy.store(first, answer.energy);
  const auto& [force, torque_a, torque_b, tension, energy] = answer;
  const Real zero = 0.0;
  geometry::add_things<W, 8>(
      {-force.x, -force.y, -force.z, torque_a.x, torque_a.y, torque_a.z, zero, zero},
      {force.x, force.y, force.z, torque_b.x, torque_b.y, torque_b.z, zero, zero},
      [&](std::size_t side, std::size_t lane) __attribute__((always_inline)) {
        return sums[row.members[side][first + lane]].force.data();
      });
  return true;
}

/// One step of a bond, wherever its nodes are.
inline void advance_one(BeamRow& row, std::size_t lane, const NodeState& state,
                        BeamSum* sums) noexcept {
  const BeamReactionOf<double> answer =
      any_beam_reaction(row.spring.at<BeamSpringOf<double>>(lane), ends_of(row, lane, state));
  row.tension.set(lane, answer.tension);
  row.energy.set(lane, answer.energy);
  const Vec3 force(answer.force.x, answer.force.y, answer.force.z);
  BeamSum& sum_a = sums[row.members[0][lane]];
  sum_a.force += -force;
  sum_a.torque += Vec3(answer.torque_a.x, answer.torque_a.y, answer.torque_a.z);
  BeamSum& sum_b = sums[row.members[1][lane]];
  sum_b.force += force;
  sum_b.torque += Vec3(answer.torque_b.x, answer.torque_b.y, answer.torque_b.z);
}

/// One step of all bonds of a row, W at a time.
template <int W>
PLEKTON_INLINE void advance_row(BeamRow& row, const NodeState& state, BeamSum* sums) noexcept {
  for (std::size_t first = 0; first < BeamRow::kLanes; first += std::size_t{W}) {
    if (advance_side_by_side<W>(row, first, state, sums)) continue;
    for (std::size_t lane = first; lane < first + std::size_t{W}; ++lane)
      advance_one(row, lane, state, sums);
  }
}

}  // namespace plekton::dynamics
