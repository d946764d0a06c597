// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/structure/bond_law.hpp"
#include "dynamics/structure/bond_yield.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace plekton::geometry {
class StateArchive;
}

namespace plekton::dynamics {

/// The bonds of a scene that yield and break. They move the state at rest of the elastic bonds
/// before these give their forces; bonds without a law cost nothing.
class YieldingBonds {
 public:
  /// @param laws  without problems (list_problems)
  YieldingBonds(std::vector<BondLaw> laws, std::span<const BeamBond> bonds);

  /// Lets every bond keep its law where the nodes are, and breaks those that do: to be called
  /// before each BeamBonds::advance. Linear in the number of bonds with laws; no allocation; the
  /// same bits for any number of threads.
  /// @param drift  s, that brought the nodes there with their velocities
  void advance(BeamBonds& bonds, const NodeState& state, double drift, geometry::ThreadPool& pool);

  /// What any bond would carry after an advance to this state; nothing if it broke.
  BondForces forces_of(std::size_t bond, const BeamBonds& bonds,
                       const NodeState& state) const noexcept;

  /// Calls visit(bond, what it remembers) for every wire, ascending by bond.
  template <class Visit>
  void for_each_wire(const Visit& visit) const {
    for (const Wire& wire : wires_) visit(wire.bond, wire.memory);
  }

  /// The bonds that broke in the last advance, ascending.
  std::span<const std::size_t> broken() const noexcept { return broken_; }

  /// J, what yielding and breaking took from the bonds in all advances, less what was forgotten.
  double dissipated() const noexcept;
  /// Of each bond (J), by its place in Scene::bonds; 0 where it has no law.
  double dissipated(std::size_t bond) const noexcept;
  /// Counts from here: what happens before the start of a simulation is in its initial energy.
  void forget_dissipated() noexcept;

  /// Plastic strain of a bond: of a wire the stretch that is left when it is unloaded, over its
  /// first length; of a beam all stretch so far, in either direction. 0 where it has no law.
  double plastic_strain(std::size_t bond) const noexcept;

  /// What bonds remember. @throws geometry::StateMismatch
  void exchange(const geometry::StateArchive& archive);

 private:
  struct Beam {
    std::size_t bond;
    BondLimits limits;
    BeamYield memory;
  };
  struct Wire {
    std::size_t bond;
    std::size_t curve;
    double length;  ///< m, L0
    WireYield memory;
  };

  /// Where the nodes have come to.
  struct Drifted {
    const NodeState& state;
    double drift;  ///< s
  };
  void yield_one(Beam& beam, BeamBonds& bonds, const Drifted& to) noexcept;
  void yield_one(Wire& wire, BeamBonds& bonds, const Drifted& to) noexcept;
  template <class Bond>
  void yield_all(std::vector<Bond>& all, BeamBonds& bonds, const Drifted& to,
                 geometry::ThreadPool& pool);
  template <class Bond>
  void break_all(const std::vector<Bond>& all, BeamBonds& bonds) noexcept;

  std::vector<WireCurve> curves_;
  std::vector<Beam> beams_;           // ascending by bond
  std::vector<Wire> wires_;           // likewise
  std::vector<std::uint8_t> breaks_;  // by bond, 1 if it breaks in this advance
  std::vector<std::size_t> broken_;
};

}  // namespace plekton::dynamics
