// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/node_state.hpp"
#include "dynamics/structure/beam_blocks.hpp"
#include "dynamics/structure/beam_bond.hpp"
#include "dynamics/structure/beam_rows.hpp"
#include "dynamics/structure/bond_forces.hpp"
#include "geometry/base/thread_pool.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::geometry {
class StateArchive;
}

namespace plekton::dynamics {

/// All beams of a scene: their forces and energy.
///
/// Let n be the unit vector from node a to node b, L their distance, and a, b the axes of the beam
/// as the two nodes carry them: a = b = n at rest. Let theta be the angle between a and b, from 0
/// to pi, q = a + b and m = q / |q| their mean direction. The stored energy is
///
///     U = 1/2 EA/L0 (L - L0)²                  stretching
///       + 1/2 EI/L0 theta²                     bending
///       + 3 EI/L0 |q| (|q| - q.n)              shear: the chord is not the mean direction
///       + 2 GJ/L0 (x² + 1/3 x⁴)                twist
///
/// with x the component along the beam of the unit quaternion that leads from frame a to frame b,
/// sin(angle / 2) for a pure twist. For small rotations alpha, beta of a and b against the chord
/// the two middle terms are 1/2 EI/L0 ((alpha - beta)² + 3 (alpha + beta)²), the energy of the 12 x
/// 12 Euler-Bernoulli stiffness matrix: beams loaded at their nodes are exact with one element
/// (Przemieniecki, Theory of Matrix Structural Analysis (1968), 5.6). In pure bending the chord is
/// the mean direction, which is the minimum of the shear term: it gives no force, and the moment is
/// EI/L0 theta at any angle. So elements under the same moment lie on a circle, exactly. The factor
/// |q| of the shear lets it fade where a and b become opposite and m has no direction. Pure twist
/// is linear to the fourth order of the angle. U > 0 unless the bond is at rest, as |q| >= q.n.
///
/// Force and torque are the exact derivatives of U; theta = |a - b| h with h = (theta / 2) /
/// sin(theta / 2), a smooth function of |q| = 2 cos(theta / 2) (half_angle_over_sine):
///
///     T_a = EI/L0 (3 |q| a x (n + (m.n) m - 2 m) + h (a - b) x m) + T_t,
///     T_b = EI/L0 (3 |q| b x (n + (m.n) m - 2 m) - h (a - b) x m) - T_t,
///     F_b = 3 EI/(L0 L) |q| (I - n n) q - EA/L0 (L - L0) n = -F_a.
///
/// Hence T_a + T_b + L n x F_b = 0: both momenta balance in any configuration. U is the same after
/// any rigid motion, so turning makes no energy. The torque of a twist grows up to 103 degrees in
/// one bond and is gone at half a turn, an unstable balance. That of bending grows up to half a
/// turn, where it changes its side: there it has none, m = 0. Use several bonds there.
///
/// Whatever takes a bond by its place throws std::out_of_range where there is none.
class BeamBonds {
 public:
  /// @throws std::invalid_argument listing every problem of every bond
  BeamBonds(std::span<const BeamBond> bonds, std::size_t node_count);

  std::size_t size() const noexcept { return slots_.size(); }

  std::array<NodeId, 2> nodes(std::size_t bond) const {
    const BeamRow& row = row_of(bond);
    return {row.nodes[0][lane_of(bond)], row.nodes[1][lane_of(bond)]};
  }

  /// Computes the forces of all bonds, summed block by block but not yet added. Linear in the
  /// number of bonds; no allocation. Coincident nodes: no shear force, and the chord has the mean
  /// direction of the axes.
  void advance(const NodeState& state, geometry::ThreadPool& pool);

  /// Adds the forces of the last advance to the nodes, in an order that follows from the bonds
  /// alone: the same bits for any number of threads.
  void add_forces(NodeForces& forces, geometry::ThreadPool& pool) const;

  /// Energy (J) stored in all bonds at the last advance.
  double elastic_energy() const noexcept;

  /// Axial force (N) of a bond at the last advance, tension positive.
  double axial_force(std::size_t bond) const { return row_of(bond).tension.number(lane_of(bond)); }

  /// What a bond carries where its nodes are as given.
  BondForces forces_of(std::size_t bond, const NodeState& state) const;

  /// Force (N) and torque (N m) of a bond on one of its nodes where they are as given.
  /// @param at_b  on the second node, or else the first
  std::array<Vec3, 2> action_on(std::size_t bond, bool at_b, const NodeState& state) const;

  /// What the force knows of a bond, and where its ends are.
  BeamSpringOf<double> spring(std::size_t bond) const {
    return row_of(bond).spring.at<BeamSpringOf<double>>(lane_of(bond));
  }
  BeamEndsOf<double> ends(std::size_t bond, const NodeState& state) const {
    return ends_of(row_of(bond), lane_of(bond), state);
  }
  /// Changes a bond from the next advance on. Several bonds may be changed at the same time.
  void set_spring(std::size_t bond, const BeamSpringOf<double>& spring) {
    rows_[slot(bond) / BeamRow::kLanes].spring.set(lane_of(bond), spring);
  }
  /// What is lost (J) if a bond breaks that nodes came to be at with their velocities in a drift:
  /// what it stored at the last advance, less the work of its forces of then on half of the way.
  /// That much the leapfrog still lets them do. The balance closes to rounding.
  /// @param spring  as it was at the last advance
  /// @param drift   s
  double lost_by_break(std::size_t bond, const BeamSpringOf<double>& spring, const NodeState& state,
                       double drift) const;

  /// Takes all stiffness from a bond, for good: from the next advance on it does nothing, and
  /// stores nothing. Again: no effect.
  /// @returns J, what it stored at the last advance
  double break_bond(std::size_t bond);
  bool is_broken(std::size_t bond) const { return slot(bond), is_broken_[bond]; }

  /// Where bonds are at rest, what is broken, and what the last advance found.
  /// @throws geometry::StateMismatch
  void exchange(const geometry::StateArchive& archive);

 private:
  std::size_t slot(std::size_t bond) const {
    if (bond >= slots_.size()) throw_no_bond(bond);
    return slots_[bond];
  }
  [[noreturn]] void throw_no_bond(std::size_t bond) const;
  const BeamRow& row_of(std::size_t bond) const { return rows_[slot(bond) / BeamRow::kLanes]; }
  std::size_t lane_of(std::size_t bond) const { return slot(bond) % BeamRow::kLanes; }
  void fill_block(const BeamBlocks::Block& block, std::span<const BeamBond> bonds);
  void gather_nodes(std::size_t node_count);

  BeamBlocks blocks_;
  std::vector<BeamRow> rows_;
  std::vector<BeamSum> sums_;         // by member of the blocks
  std::vector<std::uint32_t> slots_;  // by bond: row and lane, slot / kLanes and slot % kLanes
  std::vector<bool> is_broken_;       // by bond
  // Members by node: of nodes_[i], members_[start_[i]] up to start_[i + 1].
  std::vector<NodeId> nodes_;
  std::vector<std::uint32_t> start_;
  std::vector<std::uint32_t> members_;
};

}  // namespace plekton::dynamics
