// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/beam_bonds.hpp"

#include "geometry/base/problems.hpp"
#include "geometry/base/state_archive.hpp"
#include "geometry/base/vector_width.hpp"

#include <algorithm>
#include <bit>
#include <sstream>
#include <stdexcept>
#include <string>

namespace plekton::dynamics {
namespace {

PackVec3<double> numbers_of(const Vec3& v) noexcept {
  return {v[0], v[1], v[2]};
}

}  // namespace

BeamBonds::BeamBonds(std::span<const BeamBond> bonds, std::size_t node_count) {
  std::ostringstream problems;
  for (std::size_t i = 0; i < bonds.size(); ++i) {
    list_problems(bonds[i], node_count, "bond " + std::to_string(i), problems);
  }
  geometry::throw_if_any(problems);

  std::vector<NodeId> ends;
  ends.reserve(2 * bonds.size());
  for (const BeamBond& bond : bonds) ends.insert(ends.end(), bond.nodes.begin(), bond.nodes.end());
  blocks_ = BeamBlocks(ends, node_count);
  rows_.resize(blocks_.row_count());
  slots_.resize(bonds.size());
  is_broken_.assign(bonds.size(), false);
  for (const BeamBlocks::Block& block : blocks_.blocks()) fill_block(block, bonds);
  gather_nodes(node_count);
}

/// Lanes that are left over have a copy of the block's first bond without stiffness.
void BeamBonds::fill_block(const BeamBlocks::Block& block, std::span<const BeamBond> bonds) {
  for (std::size_t n = 0; n < block.row_count * BeamRow::kLanes; ++n) {
    const bool is_left_over = n >= block.bond_count;
    const BeamBlocks::Bond& place = blocks_.bonds(block)[is_left_over ? 0 : n];
    const BeamBond& bond = bonds[place.index];
    BeamSpringOf<double> spring = spring_of(bond);
    if (is_left_over) spring.axial = spring.bending = spring.twist = 0.0;
    const std::size_t slot = block.slot(n);
    if (!is_left_over) slots_[place.index] = static_cast<std::uint32_t>(slot);
    BeamRow& row = rows_[slot / BeamRow::kLanes];
    const std::size_t lane = slot % BeamRow::kLanes;
    row.spring.set(lane, spring);
    for (std::size_t side = 0; side < 2; ++side) {
      row.nodes[side][lane] = bond.nodes[side];
      row.members[side][lane] = place.members[side];
    }
    row.tension.set(lane, 0.0);
    row.energy.set(lane, 0.0);
  }
}

void BeamBonds::gather_nodes(std::size_t node_count) {
  const ByNode sorted = by_node(blocks_.members(), node_count);
  sums_.resize(blocks_.members().size());
  members_ = sorted.numbers;
  start_.push_back(0);
  for (std::size_t n = 0; n < node_count; ++n) {
    if (sorted.start[n + 1] == sorted.start[n]) continue;
    nodes_.push_back(geometry::id_at<NodeId>(n));
    start_.push_back(sorted.start[n + 1]);
  }
}

void BeamBonds::advance(const NodeState& state, geometry::ThreadPool& pool) {
  const std::span<const BeamBlocks::Block> blocks = blocks_.blocks();
  pool.for_each_range(blocks.size(), [&](std::size_t begin, std::size_t end, int) {
    geometry::with_widest_vectors([&](auto width) __attribute__((always_inline)) {
      for (const BeamBlocks::Block& block : blocks.subspan(begin, end - begin)) {
        BeamSum* const sums = sums_.data() + block.first_member;
        std::fill_n(sums, block.member_count, BeamSum{});
        for (std::size_t row = 0; row < block.row_count; ++row)
          advance_row<width>(rows_[block.first_row + row], state, sums);
      }
    });
  });
}

void BeamBonds::add_forces(NodeForces& forces, geometry::ThreadPool& pool) const {
  pool.for_each_range(nodes_.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      Vec3& force = forces.force[index_of(nodes_[i])];
      Vec3& torque = forces.torque[index_of(nodes_[i])];
      for (std::uint32_t k = start_[i]; k < start_[i + 1]; ++k) {
        force += sums_[members_[k]].force;
        torque += sums_[members_[k]].torque;
      }
    }
  });
}

void BeamBonds::throw_no_bond(std::size_t bond) const {
  throw std::out_of_range("BeamBonds: there is no bond " + std::to_string(bond) + "; there are " +
                          std::to_string(size()));
}

BondForces BeamBonds::forces_of(std::size_t bond, const NodeState& state) const {
  return bond_forces(spring(bond), ends(bond, state));
}

std::array<Vec3, 2> BeamBonds::action_on(std::size_t bond, bool at_b,
                                         const NodeState& state) const {
  const auto vector = [](const PackVec3<double>& v) { return Vec3(v.x, v.y, v.z); };
  const BeamReactionOf<double> all = any_beam_reaction(spring(bond), ends(bond, state));
  if (at_b) return {vector(all.force), vector(all.torque_b)};
  return {-vector(all.force), vector(all.torque_a)};
}

double BeamBonds::lost_by_break(std::size_t bond, const BeamSpringOf<double>& spring,
                                const NodeState& state, double drift) const {
  if (is_broken(bond)) return 0.0;
  const auto [a, b] = nodes(bond);
  const auto turn = [&](NodeId node) { return drift * state.angular_velocity[index_of(node)]; };
  const auto turned_back = [&](NodeId node) {
    return detail::numbers_of(turned(state.orientation[index_of(node)], turn(node), -1.0));
  };
  const Vec3 way = drift * (state.velocity[index_of(b)] - state.velocity[index_of(a)]);
  const Vec3 chord = state.position[index_of(b)] - state.position[index_of(a)] - way;
  const BeamReactionOf<double> before =
      any_beam_reaction(spring, {numbers_of(chord), turned_back(a), turned_back(b)});
  const double work = before.force.dot(numbers_of(way)) + before.torque_a.dot(numbers_of(turn(a))) +
                      before.torque_b.dot(numbers_of(turn(b)));
  return row_of(bond).energy.number(lane_of(bond)) - 0.5 * work;
}

double BeamBonds::break_bond(std::size_t bond) {
  if (is_broken(bond)) return 0.0;
  is_broken_[bond] = true;
  BeamSpringOf<double> without = spring(bond);
  without.axial = without.bending = without.twist = 0.0;
  set_spring(bond, without);
  return row_of(bond).energy.number(lane_of(bond));
}

double BeamBonds::elastic_energy() const noexcept {
  double energy = 0.0;
  for (const BeamRow& row : rows_) {
    for (std::size_t lane = 0; lane < BeamRow::kLanes; ++lane) energy += row.energy.number(lane);
  }
  return energy;
}

void BeamBonds::exchange(const geometry::StateArchive& archive) {
  using Spring = std::array<double, sizeof(BeamSpringOf<double>) / sizeof(double)>;
  struct Kept {
    bool is_broken;
    Spring spring;
    double tension;  ///< N
    double energy;   ///< J
  };
  std::vector<Kept> kept(size());
  for (std::size_t bond = 0; bond < size(); ++bond) {
    const BeamRow& row = row_of(bond);
    kept[bond] = {is_broken(bond), std::bit_cast<Spring>(spring(bond)),
                  row.tension.number(lane_of(bond)), row.energy.number(lane_of(bond))};
  }
  archive.rows("bonds", kept, [](geometry::RowFields& row, Kept& bond) {
    row("is_broken", bond.is_broken);
    row("spring", bond.spring);
    row("tension", bond.tension);
    row("energy", bond.energy);
  });
  if (kept.size() != size())
    throw geometry::StateMismatch("the state has another number of bonds than there are here");
  if (!archive.is_reading()) return;
  for (std::size_t bond = 0; bond < size(); ++bond) {
    is_broken_[bond] = kept[bond].is_broken;
    set_spring(bond, std::bit_cast<BeamSpringOf<double>>(kept[bond].spring));
    BeamRow& row = rows_[slots_[bond] / BeamRow::kLanes];
    row.tension.set(lane_of(bond), kept[bond].tension);
    row.energy.set(lane_of(bond), kept[bond].energy);
  }
}

}  // namespace plekton::dynamics
