// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/surface_surface/spread_contact.hpp"
#include "contact/surface_surface/structure_patches.hpp"

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace plekton::contact::structure {

/// Friction of facets that lie on each other, and of bars (spread_contact.hpp): which pairs of
/// cells have one in this step, and what histories go from pair to pair.
class SpreadContacts {
 public:
  /// What the spread contacts of a patch do to its second side.
  struct Sum {
    Vec3 force = Vec3::Zero();
    Vec3 moment = Vec3::Zero();
    bool is_empty = true;  ///< there is none
    bool sticks = false;   ///< one of them at least
  };

  /// Finds the pairs of the last step in a new list.
  void follow_list(const StructurePatches& patches) noexcept;

  /// Finds what presses by its extent or has a bar in it, and takes that from the patches.
  void find(StructurePatches& patches, Positions x, geometry::ThreadPool& pool);

  /// Hands the histories of the last step over: to the same pairs, and, of bars, what these count
  /// for less to those beside them that come to count for more, so that a contact that moves over a
  /// joint keeps its force. What nothing takes over is dissipated.
  EnergyLoss carry(StructurePatches& patches, const Motion& motion, double dt);

  /// One step of the law. @returns the energy (J) dissipated
  double apply_law(const StructurePatches& patches, const Motion& motion, double dt,
                   geometry::ThreadPool& pool);

  /// By patch, about the point of its row.
  std::vector<Sum> sums(const StructurePatches& patches) const;

  void add_forces(const StructurePatches& patches, NodeForces& forces) const;
  /// Of those of one patch.
  void add_forces_of(std::uint32_t patch, const StructurePatches& patches,
                     NodeForces& forces) const;
  double elastic_energy() const;
  /// Of bars; the patch tells that of facets.
  void for_each_stiffness(
      const StructurePatches& patches,
      geometry::FunctionRef<void(NodeId, const PairStiffness&, double)> visit) const;

  std::size_t size() const noexcept { return contacts_.size(); }
  SpreadContact& operator[](std::int32_t place) noexcept {
    return contacts_[static_cast<std::size_t>(place)];
  }

  void clear() { contacts_.clear(); }
  void exchange(const geometry::StateArchive& archive, const StructurePatches& patches);

 private:
  /// How hard a patch presses, added up along the normals of its terms.
  struct Pressing {
    double all = 0.0;       ///< N
    double deepest = 0.0;   ///< N, of one contact where it is deepest
    double bars = 0.0;      ///< N, of pairs of cells with a bar in them
    double positive = 0.0;  ///< N, of those of these that push
    double energy = 0.0;    ///< J, of the pairs with a bar
    double wrapped = 0.0;   ///< contacts that it gets back around bends of chains

    /// How much its bars press in directions of their own: 0 where they are one contact, as at a
    /// joint that passes over another cylinder, 1 from two contacts on.
    double spread() const noexcept {
      return deepest > 0.0 ? std::clamp(all / deepest - 1.0, 0.0, 1.0) : 0.0;
    }
    /// How much each of its bars has a whole spring, whatever its share of the push: 0 where none
    /// wraps, 1 from one contact on.
    double whole() const noexcept { return std::clamp(wrapped, 0.0, 1.0); }
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

  void share_pushes(const StructurePatches& patches);
  void take_bars_from_patches(StructurePatches& patches) const;
  bool locate(const StructurePatches& patches, std::uint32_t place, SpreadContact& spread,
              Positions x) const;
  void take_from_patches(StructurePatches& patches);
  bool locate_bar(const StructurePatches& patches, const PairTerm& term, SpreadContact& spread,
                  Positions x) const;
  void bound_by_patches(const StructurePatches& patches);
  double bars_before(const PairOfCells& pair) const;
  double bars_now(std::uint32_t pair) const;
  void find_transfers(const StructurePatches& patches);
  void list_transfers_at_joints(const StructurePatches& patches);
  void list_transfers_of_gone(const StructurePatches& patches);
  void share_transfers();
  void take_over(std::uint32_t old, SpreadContact& spread, double contacts, const Motion& motion,
                 double dt, EnergyLoss& loss);

  std::vector<SpreadContact> contacts_;  ///< by term
  std::vector<SpreadContact> previous_;
  std::vector<std::uint32_t> of_cells_;  ///< places of terms in range of two cells
  std::vector<char> presses_;            ///< by these
  std::vector<double> bar_push_;         ///< N, by pair of cells
  std::vector<Pressing> pressing_;       ///< by patch
  std::vector<double> pressed_;          ///< N, by patch, of all its spread contacts
  std::vector<std::int32_t> at_;         ///< by pair of cells; -1: none
  std::vector<Transfer> transfers_;
  std::vector<char> goes_on_;  ///< by spread contact of the last step: its pair presses still
  /// Of bars: patch and place of spread contacts.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> by_patch_;
  std::vector<double> asked_;  ///< contacts, by spread contact: what others would hand to it
};

}  // namespace plekton::contact::structure
