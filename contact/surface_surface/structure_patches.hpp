// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/law/material_pairs.hpp"
#include "contact/law/pair_springs.hpp"
#include "contact/surface_surface/pair_terms.hpp"
#include "contact/surface_surface/sides.hpp"
#include "contact/surface_surface/structure_patch.hpp"
#include "contact/surface_surface/structure_probe.hpp"
#include "contact/tracking/energy_loss.hpp"
#include "geometry/base/function_ref.hpp"
#include "geometry/neighbor/cell_neighbours.hpp"
#include "geometry/primitives/surface_change.hpp"

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace plekton::contact::structure {

/// Two cells of the list, and where they stand in what is kept from the last step.
struct PairOfCells {
  geometry::CellPair cells;
  std::int32_t patch = -1;  ///< -1: does not touch
  Sides sides = {};         ///< how its cells go with those of its patch
  std::int32_t old_patch = -1;
  Sides old_sides = {};
  std::int32_t bond = -1;    ///< StructureBonds; -1: none
  std::int32_t spread = -1;  ///< SpreadContacts, of the last step; -1: none
};

/// A patch of the last step that lives on in one of this.
struct PatchSuccessor {
  std::uint32_t old_patch;
  std::uint32_t patch;
  Sides sides;  ///< how those of the old one go with those of the new one
  friend constexpr auto operator<=>(const PatchSuccessor&, const PatchSuccessor&) = default;
};

/// Where the forces of a term in range go.
struct TermPlaces {
  std::uint32_t patch;
  Sides sides;  ///< how the features go with those of the patch
  std::array<std::uint32_t, 3> a;
  std::array<std::uint32_t, 3> b;
};

/// What a patch stores elastically.
///
/// What hangs together is one contact at least, so that the terms of a patch add up to what any of
/// its pairs of cells stores by itself, or to more. They come to less, also below nothing, so that
/// bodies would draw each other in, where cycles of what lies flat are not given back (PairTerms),
/// as of a plate with holes that are finer than it is thick, and where bodies have gone into each
/// other by more than their thickness. So a patch stores kLeastOfOne of what the pair does that
/// stores most, and pushes as much, where that is more than the sum: of both, as functions of
/// positions, the larger one. (It leaps where such a patch comes to hang together with another one,
/// or parts from it.)
struct PatchEnergy {
  /// Below 1, so that point contacts, for which both are the same but for how the rims of facets
  /// share it, have no kink.
  static constexpr double kLeastOfOne = 0.5;

  double of_all = 0.0;          ///< J
  double most = 0.0;            ///< J, of one pair of cells
  std::uint32_t most_term = 0;  ///< that pair

  void add(std::uint32_t acting, const PairTerm& term) noexcept {
    of_all += term.forces.energy;
    if (!term.is_of_cells || !(term.own_energy > most)) return;
    most = term.own_energy;
    most_term = acting;
  }
  bool is_of_one() const noexcept { return of_all < kLeastOfOne * most; }
  double value() const noexcept { return is_of_one() ? kLeastOfOne * most : of_all; }
};

/// The parts of the contact region of structures that hang together, from step to step: which
/// pairs of cells form one, what their terms push with, and which patch of the last step goes on
/// as which of this, with its history and its number.
class StructurePatches {
 public:
  explicit StructurePatches(const geometry::Surface& surface)
      : surface_(&surface), terms_(surface) {}
  StructurePatches(StructurePatches&&) = default;  // a copy's springs would be those of another
  StructurePatches& operator=(StructurePatches&&) = default;

  /// @param are_rigid  by StructureId: all nodes have the mass of the whole; empty: none is
  void set_rigid(std::vector<char> are_rigid) { structure_pairs_.set_rigid(std::move(are_rigid)); }

  /// Takes a new list of cells that may touch, sorted; pairs in both lists keep their patches.
  /// @returns the energy (J) lost with patches that left the list
  double rebuild(std::span<const geometry::CellPair> pairs, const ContactMaterials& materials);

  /// Goes on with other parameters of the same materials.
  void take_parameters(const ContactMaterials& materials);

  /// Pairs of cells keep their patches when a surface loses some of its elements. Those of a torn
  /// facet go to its sides that hold the nearest points: there the contact goes on. A list for the
  /// surface as it is now has to follow.
  void follow(const geometry::SurfaceChange& change);

  /// J, of the elastic normal forces and of the attraction of the listed pairs of a surface, where
  /// the nodes are at a moment.
  double normal_energy(const geometry::Surface& surface, const Motion& at,
                       geometry::ThreadPool& pool) const;

  /// Finds the patches of this step, and how they push.
  void find(const Motion& motion, geometry::ThreadPool& pool);

  /// Hands the histories of the last step's patches to this step's. A spring that comes to count
  /// for more contacts keeps its force, one that counts for less keeps its stretch: neither gains
  /// energy. What a patch stored that nothing follows is dissipated.
  EnergyLoss transfer(const Motion& motion, double dt);

  /// One step of the law. @returns the energy (J) dissipated
  double apply_law(const Motion& motion, double dt);
  /// How many contacts all patches between the structures of a patch count for in that step: the
  /// feet of a rigid table carry its mass together.
  double count_beside(const StructurePatch& patch) const noexcept {
    return counts_[patch.structure_pair];
  }

  void add_forces(NodeForces& forces) const;
  double elastic_energy() const;
  void for_each_stiffness(
      geometry::FunctionRef<void(NodeId, const PairStiffness&, double)> visit) const;

  void probe(StructureProbe& probe) const {
    if (patches_.empty()) return probe.clear();
    probe.begin(terms_, structure_pairs_.springs());
  }

  /// Nothing is listed and nothing touches.
  bool empty() const noexcept { return terms_.empty() && patches_.empty(); }
  double largest_overlap_ratio() const noexcept { return largest_overlap_ratio_; }
  std::size_t crossings() const noexcept { return crossings_; }

  const geometry::Surface& surface() const noexcept { return *surface_; }
  const PairTerms& terms() const noexcept { return terms_; }
  const NormalSpring& spring_of(const PairTerm& term) const noexcept {
    return structure_pairs_.springs()[term.spring];
  }
  const StructurePairs& structure_pairs() const noexcept { return structure_pairs_; }
  const StructurePair& structure_pair_of(const StructurePatch& patch) const noexcept {
    return structure_pairs_[patch.structure_pair];
  }
  /// Whether any two structures stick where they come to touch.
  bool glues() const noexcept { return structure_pairs_.glues(); }
  double history_energy(const StructurePatch& patch) const {
    return patch.history_energy(structure_pair_of(patch));
  }

  std::span<PairOfCells> pairs() noexcept { return pairs_; }
  std::span<const PairOfCells> pairs() const noexcept { return pairs_; }
  std::span<StructurePatch> patches() noexcept { return patches_; }
  std::span<const StructurePatch> patches() const noexcept { return patches_; }
  /// Whether a patch pushes as a part of one of its pairs of cells, and not as its terms add up to.
  bool is_of_one(std::uint32_t patch) const noexcept { return energies_[patch].is_of_one(); }
  /// Of the terms in range, in their order.
  std::span<const TermPlaces> places() const noexcept { return places_; }
  /// Patches of this step in which one of the last step lives on.
  std::span<const PatchSuccessor> successors_of(std::uint32_t old_patch) const noexcept;

  /// Nothing is listed, nothing touches.
  void clear();
  /// All but the list, and what pairs() say.
  void exchange(const geometry::StateArchive& archive);

 private:
  /// What a patch of the last step leaves to those of this one.
  struct Predecessor {
    ContactMemory<AnyLaw> memory;
    double count;
    double energy;      ///< J, of the history
    double last_power;  ///< W, see StructurePatch::last_power(); of what may have ended
    std::int64_t id;
    double normal_force;  ///< N
    bool is_torn;
  };

  void hand_to_sides(const PairOfCells& pair,
                     const std::array<geometry::FeatureNodes, 2>& witness_features,
                     const geometry::SurfaceChange& change, std::vector<PairOfCells>& left) const;
  void take_parts();
  void set_patch_count(std::size_t count);
  void find_places();
  void find_successors();
  void add_up_patches(Positions x, geometry::ThreadPool& pool);
  void add_up_patch(std::size_t patch, Positions x);
  /// Of the terms as they hang together now.
  PatchEnergy energy_of(std::size_t patch) const noexcept;
  void add_up_term(std::uint32_t acting, const TermPlaces& places, Positions x);
  void hand_on_history(const Predecessor& old, std::span<const PatchSuccessor> successors,
                       const Motion& motion, double dt);
  void hand_on_number(const Predecessor& old, std::span<const PatchSuccessor> successors);

  const geometry::Surface* surface_;
  std::vector<PairOfCells> pairs_;
  StructurePairs structure_pairs_;
  PairTerms terms_;
  std::vector<TermPlaces> places_;
  std::vector<StructurePatch> patches_;
  std::vector<StructurePatch> spare_;  ///< of earlier steps
  std::vector<PatchEnergy> energies_;  ///< of the patches
  std::vector<double> counts_;         ///< by structure pair, in the last step of the law
  std::vector<Predecessor> previous_;
  std::vector<PatchSuccessor> successors_;
  std::vector<PairOfCells> listed_;  ///< working space, as is the next
  std::vector<char> lives_;          ///< by patch
  double largest_overlap_ratio_ = 0.0;
  std::size_t crossings_ = 0;
};

}  // namespace plekton::contact::structure
