// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/bodies.hpp"
#include "contact/law/any_law.hpp"
#include "contact/law/linear_frictional.hpp"
#include "contact/law/material_pairs.hpp"
#include "contact/surface_surface/mean_node_masses.hpp"
#include "contact/surface_surface/pair_terms.hpp"
#include "contact/surface_surface/spread_contact.hpp"
#include "contact/surface_surface/structure_bond.hpp"
#include "contact/surface_surface/structure_patch.hpp"
#include "contact/surface_surface/touching_patches.hpp"
#include "contact/tracking/contact_record.hpp"
#include "contact/tracking/energy_loss.hpp"
#include "geometry/base/function_ref.hpp"
#include "geometry/base/parallel_sum.hpp"
#include "geometry/neighbor/cell_neighbours.hpp"
#include "geometry/primitives/surface_change.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace plekton::contact {

/// Contacts of structures with each other, and of a structure with itself where it folds.
///
/// The elastic force, and an attraction of bodies that touch, is the gradient of one energy, a sum
/// over pairs of features (surface_surface/nearest.hpp, surface_surface/extended.hpp) with the
/// weights of product_features.hpp: one contact for every part of the contact region, also where
/// it closes a ring (surface_surface/pair_terms.hpp), and one more for every diameter of length or
/// square diameter of area on which bodies run side by side. Friction and all else is decided once
/// per patch, a part of the region that hangs together: its spring is as stiff as the contacts it
/// counts, it acts where the elastic force acts, and it follows the
/// patch over the mesh. Facets that lie on each other have a spring for every pair of them instead
/// (surface_surface/spread_contact.hpp), for the part of the elastic force that their overlap has,
/// and so have bars on anything, for their shares of it. Under
/// a law that glues, what is glued is held by bonds of its own (structure_bond.hpp).
class StructureContacts {
 public:
  explicit StructureContacts(const geometry::Surface& surface)
      : surface_(&surface), terms_(surface) {}
  StructureContacts(StructureContacts&&) = default;  // a copy's springs would be those of another

  /// Takes a new list of cells that may touch, sorted; pairs in both lists keep their patches.
  /// @returns the energy (J) lost with patches that left the list
  double rebuild(std::span<const geometry::CellPair> pairs, const ContactMaterials& materials);

  /// Goes on with what is left of the surface and a new list of its cells: patches keep their
  /// histories as long as one of the features in contact is left.
  /// @param at  where the elastic energy of before and after is compared
  /// @returns the energy (J) lost, of histories and of elastic forces
  double follow(const geometry::SurfaceChange& change, std::span<const geometry::CellPair> pairs,
                const ContactMaterials& materials, const Motion& at, geometry::ThreadPool& pool);

  /// Goes on with other parameters of the same materials.
  void take_parameters(const ContactMaterials& materials);

  /// One step of all contacts: forces are found, not yet added.
  EnergyLoss advance(const Motion& motion, double dt, geometry::ThreadPool& pool);

  void add_forces(NodeForces& forces) const;

  /// Largest overlap of the last step over the smaller radius.
  double largest_overlap_ratio() const noexcept { return largest_overlap_ratio_; }

  /// Pairs of facets and cylinders whose cores met in the last step: overlaps beyond both radii.
  std::size_t crossings() const noexcept { return crossings_; }

  /// Number of patches in contact and of bonds.
  std::size_t touching() const noexcept { return patches_.size() + bonds_.size(); }
  /// Number of bonds that hold.
  std::size_t bond_count() const noexcept {
    return static_cast<std::size_t>(std::count_if(
        bonds_.begin(), bonds_.end(), [](const Bond& bond) { return !bond.is_broken; }));
  }

  /// Energy (J) stored in all contacts, at the positions of the last step.
  double elastic_energy() const;

  /// Calls visit(node, stiffness (N/m), radius (m), tangential over normal stiffness) for what
  /// every patch, and every bond over a distance, adds to the stiffness around its nodes.
  void for_each_stiffness(geometry::FunctionRef<void(NodeId, double, double, double)> visit) const;

  /// Calls visit(cells) for the listed pairs of cells that do not touch, but may be as near as a
  /// margin (m).
  template <class Visit>
  void for_each_near(double margin, Visit&& visit) const {
    for (std::uint32_t i = 0; i < pairs_.size(); ++i) {
      if (pairs_[i].patch < 0 && terms_.may_be_within(i, margin)) visit(pairs_[i].cells);
    }
  }

  /// Gives a number after the last one to every patch that has none.
  void assign_ids(std::int64_t& last) {
    for (Patch& patch : patches_) {
      if (patch.id == 0) patch.id = ++last;
    }
    for (Bond& bond : bonds_) {
      if (bond.id == 0) bond.id = ++last;
    }
  }

  /// Calls visit(ContactRecord) for every patch that pushed in the last step, in the order of the
  /// list, then for every bond.
  void for_each_record(Positions x, VisitRecord visit) const;

  /// Calls visit(ContactRecord, force (N), torque (N m)) for the same rows, with what each did to
  /// one node: exactly, wherever in the patch that is. Linear in the nodes of the scene.
  using VisitRecordOn = geometry::FunctionRef<void(const ContactRecord&, const Vec3&, const Vec3&)>;
  void for_each_record_on(NodeId node, Positions x, VisitRecordOn visit) const;

  /// @param list  makes the list anew by rebuild()
  void exchange(const geometry::StateArchive& archive, geometry::FunctionRef<void()> list);

 private:
  using PairTerm = structure::PairTerm;
  using StructurePair = structure::StructurePair;
  using Patch = structure::StructurePatch;
  using Bond = structure::StructureBond;
  using Spread = structure::SpreadContact;

  struct PairOfCells {
    geometry::CellPair cells;
    std::int32_t patch = -1;  ///< -1: does not touch
    bool is_turned = false;   ///< its first cell is on the second side of its patch
    std::int32_t old_patch = -1;
    bool was_turned = false;
    std::int32_t bond = -1;    ///< -1: none
    std::int32_t spread = -1;  ///< of the last step; -1: none
  };
  /// What is glued in a patch, and what can be: numbers of contacts.
  struct Gluing {
    double bonds = 0.0;
    double near = 0.0;      ///< of the nearest points of all pairs of cells
    double positive = 0.0;  ///< of those that count as more than 0
    double wide = 0.0;      ///< of their extents
    double wants = 0.0;     ///< that they want together
    double pressing = 0.0;  ///< N, on the bonds

    /// What a pair of cells is to have. The less the nearest points are beside the extents, the
    /// more goes with these: on bodies that lie flat the nearest points are anywhere.
    double count_of(double of_near, double of_wide) const noexcept {
      const double all = near + wide;
      if (!(near > 0.0)) return wide > 0.0 ? std::max(0.0, all) / wide * of_wide : 0.0;
      return (1.0 + near / all) * of_wide + near / all * near / positive * std::max(0.0, of_near);
    }
  };
  /// A pair of cells that presses in a patch that can be glued.
  struct Pressed {
    std::uint32_t pair;
    std::uint32_t patch;
    std::uint32_t term;
    bool is_turned;  ///< feature a of the term is on its second cell
    double near;     ///< contacts
    double wide;     ///< contacts
    double wants;    ///< contacts
  };
  /// Where the forces of an acting term go.
  struct Places {
    std::uint32_t patch;
    bool is_turned;  ///< feature a is on the second side
    std::array<std::uint32_t, 3> a;
    std::array<std::uint32_t, 3> b;
  };
  /// What a patch of the last step leaves to those of this one.
  struct Predecessor {
    ContactMemory<AnyLaw> memory;
    std::uint32_t structure_pair;
    double count;
    double energy;  ///< J, of the history
    std::int64_t id;
    double normal_force;  ///< N
    bool is_torn;
  };
  /// What the spread contacts of a patch do to its second side.
  struct SpreadSum {
    Vec3 force = Vec3::Zero();
    Vec3 moment = Vec3::Zero();
    bool sticks = false;  ///< one of them at least
  };
  /// How hard a patch presses, added up along the normals of its terms.
  struct Pressing {
    double all = 0.0;       ///< N
    double deepest = 0.0;   ///< N, of one contact where it is deepest
    double bars = 0.0;      ///< N, of pairs of cells with a bar in them
    double positive = 0.0;  ///< N, of those of these that push
    double energy = 0.0;    ///< J, of the pairs with a bar
    bool wraps = false;     ///< around a bend of a chain

    /// How much its bars press in directions of their own: 0 where they are one contact, as at a
    /// joint that passes over another cylinder, 1 from two contacts on.
    double spread() const noexcept {
      return deepest > 0.0 ? std::clamp(all / deepest - 1.0, 0.0, 1.0) : 0.0;
    }
  };
  /// Of a history, between spread contacts.
  struct Transfer {
    std::uint32_t from;  ///< of the last step
    std::uint32_t to;
    double less;            ///< contacts, that the one counts for less
    double more;            ///< contacts, that the other counts for more
    double contacts = 0.0;  ///< handed over
    friend auto operator<=>(const Transfer& p, const Transfer& q) {
      return std::pair{p.from, p.to} <=> std::pair{q.from, q.to};
    }
    friend bool operator==(const Transfer& p, const Transfer& q) {
      return p.from == q.from && p.to == q.to;
    }
  };
  /// A patch of the last step that lives on in one of this.
  struct Successor {
    std::uint32_t old_patch;
    std::uint32_t patch;
    bool is_turned;
    friend constexpr auto operator<=>(const Successor&, const Successor&) = default;
  };

  std::vector<StructurePair> find_structure_pairs(const ContactMaterials& materials) const;
  void make_structure_pairs(const ContactMaterials& materials);
  double normal_energy(const geometry::Surface& surface, std::span<const geometry::CellPair> pairs,
                       const Motion& at, geometry::ThreadPool& pool) const;
  void renumber(const geometry::SurfaceChange& change);
  void hand_to_sides(const PairOfCells& pair,
                     const std::array<geometry::FeatureNodes, 2>& witness_features,
                     const geometry::SurfaceChange& change, std::vector<PairOfCells>& left) const;
  void find_patches();
  void number_patches();
  void find_places();
  void find_successors();
  void add_up_patches(Positions x);
  EnergyLoss transfer(const Motion& motion, double dt);
  void hand_on_number(const Predecessor& old, std::span<const Successor> successors);
  void share_pushes();
  void find_spreads(Positions x);
  bool locate_bar(const PairTerm& term, Spread& spread, Positions x) const;
  void find_transfers();
  template <class Now, class Before>
  void find_transfers_of_gone(Now now, Before before);
  EnergyLoss carry_spreads(const Motion& motion, double dt);
  double advance_spreads(const Motion& motion, double dt, geometry::ThreadPool& pool);
  std::vector<SpreadSum> sum_spreads() const;
  double prepare_bonds(const Motion& motion, geometry::ThreadPool& pool);
  std::int32_t patch_of(const Bond& bond) const;
  double form_bonds(Positions x);
  void list_pressed_pairs();
  void add_near_push(const PairTerm& term);
  double glue_pair(const Pressed& pressed, double count, Positions x);
  double advance_bonds(const Motion& motion, double dt, geometry::ThreadPool& pool);
  double hand_to_patch(Bond& bond);
  double hand_to_spread(const Bond& bond, Spread& spread);
  void drop_broken_bonds();
  void match_bonds();
  double keep_bonds(const geometry::SurfaceChange& change);
  ContactRecord row_of(const Bond& bond) const;
  ContactRecord row_of(const Patch& patch, const SpreadSum& spread, Positions x) const;
  std::vector<PairOfCells> touching_pairs() const;
  void exchange_pair(geometry::RowFields& row, PairOfCells& pair) const;
  void place_spreads() noexcept;
  const StructurePair& structure_pair_of(const Patch& patch) const {
    return structure_pairs_[patch.structure_pair];
  }
  double history_energy(const Patch& patch) const {
    return patch.history_energy(structure_pair_of(patch));
  }
  const geometry::Surface* surface_;
  std::vector<PairOfCells> pairs_;
  std::vector<StructurePair> structure_pairs_;    ///< of all structures that may ever meet
  std::vector<structure::NormalSpring> springs_;  ///< of the structure pairs
  structure::PairTerms terms_;
  std::vector<Places> places_;  ///< of the acting terms
  structure::TouchingPatches connected_;
  std::vector<Patch> patches_;
  std::vector<Predecessor> previous_;
  std::vector<Successor> successors_;
  std::vector<Spread> spreads_;  ///< by term
  std::vector<Spread> previous_spreads_;
  std::vector<double> bar_push_;         ///< N, by pair of cells
  std::vector<Pressing> pressing_;       ///< by patch
  std::vector<std::int32_t> spread_at_;  ///< by pair of cells; -1: none
  std::vector<Transfer> transfers_;
  std::vector<char> goes_on_;  ///< by spread contact of the last step: its pair presses still
  /// Of bars: patch and place of spread contacts.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> by_patch_;
  std::vector<double> asked_;  ///< contacts, by spread contact: what others would hand to it
  std::vector<Bond> bonds_;
  bool glues_ = false;          ///< whether any two structures stick where they come to touch
  std::vector<Gluing> gluing_;  ///< by patch
  std::vector<Pressed> pressed_;
  std::vector<double> near_push_;  ///< N, by pair of cells
  double largest_overlap_ratio_ = 0.0;
  std::size_t crossings_ = 0;
};

}  // namespace plekton::contact
