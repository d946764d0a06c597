// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/stiffness/nodal_stiffness.hpp"
#include "dynamics/structure/beam_blocks.hpp"
#include "dynamics/structure/sheet_bounds.hpp"
#include "dynamics/structure/sheet_spring.hpp"
#include "geometry/base/thread_pool.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace plekton::geometry {
class StateArchive;
}

namespace plekton::dynamics {

/// All facets of thin elastic sheets of a scene: their forces and energy.
///
/// Let F be the gradient of the deformation of a facet (3 x 2), A its area at rest, and n_i the
/// facet's normal as node i carries it. The stored energy is
///
///     U = A/2 N : E,  E = 1/2 (F^T F - I)                                stretching
///       + 1/2 q . K q,  q_ij = n_i . (x_j - x_i)                         bending
///       + 1/2 c sum w_i²,  c = (1 - nu) D                                turning in the plane
///
/// with N = E t / (1 - nu²) ((1 - nu) E + nu tr E I), plane stress (St. Venant-Kirchhoff): the
/// constant-strain triangle. q_ij is the distance at which the tangent plane of node i passes node
/// j, and K the discrete Kirchhoff triangle (Batoz, Bathe & Ho, Int. J. Numer. Meth. Engng 15
/// (1980) 1771-1812), so for small deflections this is Kirchhoff's plate. w_i is the angle between
/// node i and the mean rotation of the facet about the normal; its energy is there only because
/// nodes have rotations about the normal, of which a sheet knows nothing, and is of the order (t /
/// size)² of the rest.
///
/// Force and torque are the exact derivatives of U, polynomials of positions and normals: they are
/// defined wherever the nodes are, also in a facet without area. U does not change with any rigid
/// motion: both momenta balance in any configuration, and turning makes no energy. There is no
/// history, and a curved sheet is at rest as it was given.
///
/// A rim is clamped where its nodes' rotations are held, hinged where only their positions are,
/// free where nothing is. Beams on the same nodes are joined rigidly, as are sheets that meet in a
/// fold; any number of facets may meet at an edge.
///
/// What it can: large displacements and rotations, small strain. It converges to membrane and plate
/// theory as facets get smaller (tests/validation: second order for deflections). What it cannot:
/// shear across the thickness (thick plates), wrinkles smaller than a facet, strains beyond about
/// 10 percent (this elastic law gets too soft under compression and lets a facet turn inside out
/// below 0.58 of its length). It stays elastic until it tears. A normal that is turned by much
/// against its facet (more than 45 degrees) resists less and less: use facets small against the
/// radius of curvature.
class SheetFacets {
 public:
  /// Linear in the number of facets and nodes.
  /// @throws std::invalid_argument listing every problem of every facet
  SheetFacets(std::span<const SheetFacet> facets, std::size_t node_count);

  std::size_t size() const noexcept { return springs_.size(); }

  const std::array<NodeId, 3>& nodes(std::size_t facet) const noexcept { return nodes_[facet]; }

  /// Whether it broke: it carries and stores nothing any more.
  bool is_broken(std::size_t facet) const noexcept { return broken_[facet] != 0; }

  /// Computes what all facets do to their nodes, facet by facet. No allocation.
  /// @param drift  s, that brought the nodes there with their velocities
  void advance(const NodeState& state, double drift, geometry::ThreadPool& pool);

  /// Breaks the facets that the last advance took beyond their strength (SheetSection); the others
  /// are not touched. To be called after each advance, where the nodes are then. Costs nothing
  /// where no facet has a strength; no allocation; the same for any number of threads.
  ///
  /// A crack is as wide as a facet, and the energy that it takes is the one stored in the facets
  /// along it: that gets smaller with the facets, so a strength is that of a mesh. Where the stress
  /// is even everything tears at once; a hole or a weaker facet says where it begins.
  void tear(geometry::Positions positions, geometry::ThreadPool& pool);
  /// Breaks one where its nodes have come to, before the advance there. Again: no effect.
  /// @param drift  s, that brought the nodes there with their velocities
  void break_facet(std::size_t facet, const NodeState& state, double drift);
  /// The facets that tore after the last advance, ascending.
  std::span<const std::size_t> broken() const noexcept { return just_broken_; }
  /// J, what breaking took in all steps, less what was forgotten: what a facet stored at the advance
  /// before it broke, less the work of its forces of then on half of the way from there. That much
  /// the leapfrog still lets them do. The balance closes to rounding.
  double dissipated() const noexcept { return dissipated_; }
  /// Counts from here: what happens before the start of a simulation is in its initial energy.
  void forget_dissipated() noexcept { dissipated_ = 0.0; }

  /// Adds the forces of the last advance to the nodes, at each in the order of the facets: the same
  /// bits for any number of threads.
  void add_forces(NodeForces& forces, geometry::ThreadPool& pool) const;

  /// Force (N) of a facet on one of its corners at the last advance.
  const Vec3& corner_force(std::size_t facet, std::size_t corner) const noexcept {
    return reactions_[facet].force[corner];
  }

  /// Likewise the torque (N m).
  const Vec3& corner_torque(std::size_t facet, std::size_t corner) const noexcept {
    return reactions_[facet].torque[corner];
  }

  /// Energy (J) stored in all facets at the last advance.
  double elastic_energy() const noexcept;

  /// Membrane forces (N/m) of a facet at the last advance, per length as it is now (Cauchy), in
  /// world axes: the force on a cut across the unit vector m is this matrix times m. Tension
  /// positive; zero where the facet has no area any more.
  Mat3 membrane_force(std::size_t facet, geometry::Positions positions) const noexcept;

  /// Adds the stiffness of all facets as they are now; see NodalStiffness. Bending counts as if the
  /// nodes were turned little against the facets.
  void add_to(NodalStiffness& stiffness, const NodeState& state) const;
  /// That of one facet.
  void add_to(NodalStiffness& stiffness, const NodeState& state, std::size_t facet) const;

  /// What is broken, and what the last advance found. @throws geometry::StateMismatch
  void exchange(const geometry::StateArchive& archive);

 private:
  double lost_by_break(std::size_t facet, const NodeState& state, double drift) const noexcept;
  void take_out(std::size_t facet, double lost);

  std::vector<std::array<NodeId, 3>> nodes_;
  std::vector<SheetSpring> springs_;
  std::vector<SheetBounds> bounds_;
  std::vector<SheetReaction> reactions_;
  std::vector<std::uint8_t> broken_;      ///< 1 if it broke
  std::vector<std::size_t> limited_;      ///< those with a strength, ascending
  std::vector<double> strength_;          ///< N/m, of these
  std::vector<double> lost_;              ///< J, of these, if it tears now
  std::vector<std::uint8_t> tears_;       ///< of these, 1 if it tears now
  std::vector<std::size_t> just_broken_;  ///< since the last advance
  double dissipated_ = 0.0;
  ByNode corners_;  ///< 3 facet + corner
};

}  // namespace plekton::dynamics
