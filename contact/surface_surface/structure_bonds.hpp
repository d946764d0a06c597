// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/surface_surface/spread_contacts.hpp"
#include "contact/surface_surface/structure_bond.hpp"
#include "contact/surface_surface/structure_patches.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::contact::structure {

/// Bonds between structures (structure_bond.hpp): where they are formed and broken.
///
/// The bonds of a patch together count for as many contacts as it did at most so far. Each pair of
/// cells has one, with a share by how hard it presses, so sheets peel off little by little. They
/// carry their part of the tangential force; the patch has the rest. Where a bond has broken the
/// patch forms no others: what slides or comes back is held by friction alone until it has parted.
class StructureBonds {
 public:
  /// Takes out those that broke in the last step.
  void drop_broken(StructurePatches& patches);

  /// Finds the pairs of cells of all bonds in a new list.
  void follow_list(StructurePatches& patches);

  /// Bonds on cells that have broken away are gone. @returns the energy (J) lost with them
  double follow(const geometry::SurfaceChange& change, const StructurePatches& patches);

  /// Finds where all bonds are, and forms new ones. @returns the energy (J) lost
  double find(StructurePatches& patches, const Motion& motion, geometry::ThreadPool& pool);

  /// One step of the law for all bonds, after that for the patches. What a broken bond still holds
  /// goes to the facets or the patch of its cells, if they touch.
  /// @returns the energy (J) dissipated
  double apply_law(StructurePatches& patches, SpreadContacts& spread, const Motion& motion,
                   double dt, geometry::ThreadPool& pool);

  void add_forces(const StructurePatches& patches, NodeForces& forces) const;
  double elastic_energy(const StructurePatches& patches) const;
  /// Of bonds over a distance; the patch tells that of what touches.
  void for_each_stiffness(
      const StructurePatches& patches,
      geometry::FunctionRef<void(NodeId, const PairStiffness&, double)> visit) const;

  bool empty() const noexcept { return bonds_.empty(); }
  std::span<StructureBond> all() noexcept { return bonds_; }
  std::span<const StructureBond> all() const noexcept { return bonds_; }
  /// Of those that hold.
  std::size_t count() const noexcept {
    return static_cast<std::size_t>(std::ranges::count(bonds_, false, &StructureBond::is_broken));
  }

  void clear() { bonds_.clear(); }
  void exchange(const geometry::StateArchive& archive, const StructurePatches& patches);

 private:
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
    Sides sides;   ///< how the features of the term go with its cells
    double near;   ///< contacts
    double wide;   ///< contacts
    double wants;  ///< contacts
  };

  std::int32_t patch_of(const StructureBond& bond, const StructurePatches& patches) const;
  double form(StructurePatches& patches, Positions x);
  void list_pressed_pairs(const StructurePatches& patches);
  static double wide_count(const PairTerms& terms, std::uint32_t acting,
                           const AnyLaw::Parameters& parameters, double deepest,
                           const Vec3& normal);
  void add_near_push(const StructurePatches& patches, const PairTerm& term);
  double glue_pair(StructurePatches& patches, const Pressed& pressed, double count, Positions x);
  void free_patches_of_pressing(StructurePatches& patches);
  double hand_over(StructureBond& bond, StructurePatches& patches, SpreadContacts& spread) const;
  double hand_to_patch(const StructureBond& bond, Sides sides, StructurePatch& patch,
                       const StructurePatches& patches) const;
  double hand_to_spread(const StructureBond& bond, SpreadContact& spread,
                        const StructurePatches& patches) const;

  std::vector<StructureBond> bonds_;
  std::vector<Gluing> gluing_;  ///< by patch
  std::vector<Pressed> pressed_;
  std::vector<double> near_push_;  ///< N, by pair of cells
};

}  // namespace plekton::contact::structure
