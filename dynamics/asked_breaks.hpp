// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/broken_elements.hpp"
#include "dynamics/structure/yielding_bonds.hpp"

#include <array>

namespace plekton::geometry {
class StateArchive;
}

namespace plekton::dynamics {

class EnergyLedger;

/// What of a scene has been asked to break, and does in the next step.
class AskedBreaks {
 public:
  /// @throws std::out_of_range for a bond or node that is none
  /// @throws std::invalid_argument if there is no cylinder or facet between these nodes
  void ask_bond(std::size_t bond, std::size_t bond_count);
  void ask_cylinder(NodeId a, NodeId b, const Scene& scene);
  void ask_facet(const std::array<NodeId, 3>& nodes, const Scene& scene);

  /// Before bonds and sheets find what they do where their nodes have come to.
  /// @param drift  s, that brought the nodes there with their velocities
  /// @param ledger  to which the energy of the bonds is added; sheets count theirs by themselves
  void break_all(BeamBonds& bonds, SheetFacets& sheets, const NodeState& state, double drift,
                 EnergyLedger& ledger) const;

  /// Adds what broke by itself in the last advance, since it was too much.
  void add_broken(const YieldingBonds& yielding_bonds, const SheetFacets& sheets);
  const BrokenParts& parts() const noexcept { return parts_; }
  void clear() noexcept { parts_.clear(); }
  bool empty() const noexcept { return parts_.empty(); }

  /// @throws geometry::StateMismatch for what is none
  void exchange(const geometry::StateArchive& archive, std::size_t bond_count,
                std::size_t node_count);

 private:
  BrokenParts parts_;
};

}  // namespace plekton::dynamics
