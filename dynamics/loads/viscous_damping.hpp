// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/loads/load_step.hpp"
#include "dynamics/loads/loaded_nodes.hpp"
#include "dynamics/loads/node_members.hpp"
#include "dynamics/model/loads.hpp"
#include "dynamics/structure/beam_bond.hpp"
#include "dynamics/structure/yielding_bonds.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace plekton::dynamics {

/// N s/m, of the dashpot along a beam: 2 ratio sqrt(k m), k = EA/L0, m the reduced mass of its
/// nodes. 0 if both are held.
double dashpot_of(const BeamBond& bond, double ratio, const NodeProperties& properties);

/// Beams with dashpots along them: the force on the second node is -c ((v_b - v_a).n) n, n along
/// the beam from a to b, minus that on the first. It turns with the beam and leaves both momenta
/// alone. The velocities are those of the last drift. 0 where the nodes coincide.
///
/// A wire (WireCurve) is damped while it is taut, and pulls with its dashpot together, or not at
/// all: what is slack carries nothing, and nothing pushes.
class DampedBeams {
 public:
  DampedBeams(const BeamDamping& damping, std::span<const BeamBond> bonds,
              const NodeProperties& properties);

  /// Takes the tensions that wires have now: before each act().
  void look_at(const YieldingBonds& bonds) noexcept;

  LoadedNodes& act(const LoadStep& step, const NodeState& state, geometry::ThreadPool& pool);
  LoadedNodes& nodes() noexcept { return nodes_; }

  /// Takes the dashpots off beams that are broken.
  void follow(const BeamBonds& bonds);

  /// s, the largest c / k: these dashpots are nowhere above that times the stiffness of the beams.
  double relaxation_time() const noexcept { return relaxation_time_; }

 private:
  std::vector<std::size_t> bonds_;  // by group of members_
  NodeMembers<2> members_;
  LoadedNodes nodes_;
  std::vector<double> dashpots_;  // N s/m, by group of members_
  std::vector<double> tensions_;  // N, of wires, which must not push; else infinite; likewise
  std::vector<std::uint32_t> group_of_;  // by bond; past the end if it is not damped
  std::vector<Vec3> forces_;             // N, on the second node, likewise
  double relaxation_time_ = 0.0;
};

/// Nodes that are slowed down in proportion to their mass and inertia.
class DraggedNodes {
 public:
  DraggedNodes(const MassDamping& damping, const NodeProperties& properties);

  LoadedNodes& act(const LoadStep& step, const NodeState& state, geometry::ThreadPool& pool);
  LoadedNodes& nodes() noexcept { return nodes_; }
  double rate() const noexcept { return rate_; }  ///< 1/s

 private:
  double rate_;
  LoadedNodes nodes_;
  std::vector<double> mass_;     // kg, by place in nodes_
  std::vector<double> inertia_;  // kg m²
};

/// Longest stable step (s) of the leapfrog with forces of damping that see the velocity of the last
/// drift: of M x'' + C x' + K x = 0 it is stable for dt² K + 2 dt C < 4 M, as a root z of
/// (z - 1)² + dt² k z + dt c (z - 1) = 0 is in the unit circle for dt² k + 2 dt c < 4, k and c of any
/// motion of unit mass. With C <= relaxation_time K1 + rate M, K1 what is damped and no contact, and
/// the bounds 4 M / dt0² of K and 4 M / dt1² of K1 that is
///
///     dt² / dt0² + 2 (relaxation_time / dt1² + rate / 4) dt < 1.
///
/// @param undamped   s, dt0; may be infinite
/// @param of_damped  s, dt1, likewise; at least dt0
double damped_step(double undamped, double of_damped, double relaxation_time, double rate) noexcept;

}  // namespace plekton::dynamics
