// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/surface_surface/spread_contacts.hpp"
#include "contact/surface_surface/structure_bonds.hpp"
#include "contact/surface_surface/structure_patches.hpp"
#include "contact/tracking/contact_record.hpp"
#include "contact/tracking/energy_loss.hpp"
#include "geometry/base/function_ref.hpp"
#include "geometry/neighbor/cell_neighbours.hpp"
#include "geometry/primitives/surface_change.hpp"

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
/// weights of product_features.hpp: one contact for every part of the contact region, also where it
/// closes a cycle (surface_surface/pair_terms.hpp), and one more for every diameter of length or
/// square diameter of area on which bodies run side by side, but never less than PatchEnergy says.
/// Friction and all else is decided once per patch, a part of the region that hangs together: its
/// spring is as stiff as the contacts it counts, it acts where the elastic force acts, and it
/// follows the patch over the mesh. Facets that lie on each other have a spring for every pair of
/// them instead (surface_surface/spread_contact.hpp), for the part of the elastic force that their
/// overlap has, and so have bars on anything, for their shares of it. Under a law that glues, what
/// is glued is held by bonds of its own (structure_bond.hpp).
class StructureContacts {
 public:
  explicit StructureContacts(const geometry::Surface& surface) : patches_(surface) {}

  /// Before the first list. @param are_rigid  by StructureId: all nodes have the mass of the whole
  void set_rigid(std::vector<char> are_rigid) { patches_.set_rigid(std::move(are_rigid)); }

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
  void take_parameters(const ContactMaterials& materials) { patches_.take_parameters(materials); }

  /// One step of all contacts: forces are found, not yet added.
  EnergyLoss advance(const Motion& motion, double dt, geometry::ThreadPool& pool);

  void add_forces(NodeForces& forces) const;

  /// Largest overlap of the last step over the smaller radius.
  double largest_overlap_ratio() const noexcept { return patches_.largest_overlap_ratio(); }

  /// Pairs of facets and cylinders whose cores met in the last step: overlaps beyond both radii.
  std::size_t crossings() const noexcept { return patches_.crossings(); }

  /// Number of patches in contact and of bonds.
  std::size_t touching() const noexcept { return patches_.patches().size() + bonds_.all().size(); }
  /// Number of bonds that hold.
  std::size_t bond_count() const noexcept { return bonds_.count(); }

  /// Energy (J) stored in all contacts, at the positions of the last step.
  double elastic_energy() const;

  /// Calls visit(node, stiffness, radius (m) of its body) for what every patch that pushes, every
  /// contact of a bar and every bond over a distance adds to the stiffness around its nodes.
  void for_each_stiffness(
      geometry::FunctionRef<void(NodeId, const PairStiffness&, double)> visit) const;

  /// Lets a probe ask how patches push with nodes near where they were in the last step.
  void probe(StructureProbe& probe) const { patches_.probe(probe); }

  /// Calls visit(cells) for the listed pairs of cells that do not touch, but may be as near as a
  /// margin (m).
  template <class Visit>
  void for_each_near(double margin, Visit&& visit) const {
    const auto pairs = patches_.pairs();
    for (std::uint32_t i = 0; i < pairs.size(); ++i) {
      if (pairs[i].patch < 0 && patches_.terms().may_be_within(i, margin)) visit(pairs[i].cells);
    }
  }

  /// Gives a number after the last one to every patch that has none.
  void assign_ids(std::int64_t& last) {
    for (structure::StructurePatch& patch : patches_.patches()) {
      if (patch.id == 0) patch.id = ++last;
    }
    for (structure::StructureBond& bond : bonds_.all()) {
      if (bond.id == 0) bond.id = ++last;
    }
  }

  /// Calls visit(ContactRecord) for every patch that pushed in the last step, in the order of the
  /// list, then for every bond.
  void for_each_record(Positions x, VisitRecord visit) const;
  /// See Contacts::for_each_balanced().
  void for_each_balanced(Positions x, VisitRecord visit) const;

  /// Calls visit(ContactRecord, force (N), torque (N m)) for the same rows, with what each did to
  /// one node: exactly, wherever in the patch that is. Linear in the nodes of the scene.
  using VisitRecordOn = geometry::FunctionRef<void(const ContactRecord&, const Vec3&, const Vec3&)>;
  void for_each_record_on(NodeId node, Positions x, VisitRecordOn visit) const;

  /// @param list  makes the list anew by rebuild()
  void exchange(const geometry::StateArchive& archive, geometry::FunctionRef<void()> list);

 private:
  ContactRecord row_of(const structure::StructureBond& bond, Positions x) const;
  ContactRecord row_of(const structure::StructurePatch& patch,
                       const structure::SpreadContacts::Sum& spread, Positions x) const;
  void exchange_pair(geometry::RowFields& row, structure::PairOfCells& pair) const;

  structure::StructurePatches patches_;
  structure::SpreadContacts spread_;
  structure::StructureBonds bonds_;
};

}  // namespace plekton::contact
