// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/structure_contacts.hpp"

#include "contact/tracking/contact_state.hpp"
#include "contact/tracking/slip_state.hpp"

#include <vector>

namespace plekton::contact {

using structure::PairOfCells;
using structure::SpreadContacts;
using structure::StructureBond;
using structure::StructurePair;
using structure::StructurePatch;

namespace {

ContactBody body_of(const geometry::FeatureNodes& nodes, const geometry::Surface& surface) {
  return {BodyKind::structure, static_cast<std::int32_t>(surface.structure_of(nodes.ids[0])),
          geometry::feature_of(surface, nodes)};
}

}  // namespace

double StructureContacts::rebuild(std::span<const geometry::CellPair> pairs,
                                  const ContactMaterials& materials) {
  const double lost = patches_.rebuild(pairs, materials);
  spread_.follow_list(patches_);
  if (!bonds_.empty()) bonds_.follow_list(patches_);
  return lost;
}

double StructureContacts::follow(const geometry::SurfaceChange& change,
                                 std::span<const geometry::CellPair> pairs,
                                 const ContactMaterials& materials, const Motion& at,
                                 geometry::ThreadPool& pool) {
  double lost = patches_.normal_energy(change.before(), at, pool);
  const bool had_pairs = !patches_.pairs().empty();
  patches_.follow(change);
  lost += bonds_.follow(change, patches_);
  bonds_.follow_list(patches_);
  lost += rebuild(pairs, materials);
  // What was not listed was not in the energy before: the first list comes with this change.
  if (!had_pairs) return lost;
  return lost - patches_.normal_energy(change.after(), at, pool);
}

EnergyLoss StructureContacts::advance(const Motion& motion, double dt, geometry::ThreadPool& pool) {
  if (patches_.empty() && bonds_.empty()) return {};
  bonds_.drop_broken(patches_);
  patches_.find(motion, pool);
  spread_.find(patches_, motion.position, pool);
  EnergyLoss loss;
  loss.tracking = bonds_.find(patches_, motion, pool);
  loss += patches_.transfer(motion, dt);
  loss += spread_.carry(patches_, motion, dt);
  loss.dissipated += patches_.apply_law(motion, dt);
  loss.dissipated += spread_.apply_law(patches_, motion, dt, pool);
  loss.dissipated += bonds_.apply_law(patches_, spread_, motion, dt, pool);
  return loss;
}

void StructureContacts::add_forces(NodeForces& forces) const {
  patches_.add_forces(forces);
  spread_.add_forces(patches_, forces);
  bonds_.add_forces(patches_, forces);
}

double StructureContacts::elastic_energy() const {
  return patches_.elastic_energy() + spread_.elastic_energy() + bonds_.elastic_energy(patches_);
}

void StructureContacts::for_each_stiffness(
    geometry::FunctionRef<void(NodeId, const PairStiffness&, double)> visit) const {
  patches_.for_each_stiffness(visit);
  spread_.for_each_stiffness(patches_, visit);
  bonds_.for_each_stiffness(patches_, visit);
}

// Contacts of structures as they are reported.

void StructureContacts::for_each_record(Positions x, VisitRecord visit) const {
  const std::vector<SpreadContacts::Sum> spread = spread_.sums(patches_);
  const auto patches = patches_.patches();
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (patches[i].pushes()) visit(row_of(patches[i], spread[i], x));
  }
  for (const StructureBond& bond : bonds_.all()) visit(row_of(bond, x));
}

void StructureContacts::for_each_balanced(Positions x, VisitRecord visit) const {
  const geometry::Surface& surface = patches_.surface();
  const auto centre = [&](const geometry::FeatureNodes& nodes) {
    Vec3 sum = Vec3::Zero();
    for (const NodeId node : nodes) sum += x[index_of(node)];
    return Vec3(sum / static_cast<double>(nodes.count));
  };
  for (const StructurePatch& patch : patches_.patches()) {
    if (patch.pushes() || !(patch.deepest_overlap > 0.0)) continue;
    ContactRecord row;
    row.a = body_of(patch.deepest[0], surface);
    row.b = body_of(patch.deepest[1], surface);
    row.point_a = centre(patch.deepest[0]);
    row.point_b = centre(patch.deepest[1]);
    row.point = 0.5 * (row.point_a + row.point_b);
    row.deepest = patch.deepest_overlap;
    row.gap = -row.deepest;
    visit(row);
  }
}

void StructureContacts::for_each_record_on(NodeId node, Positions x, VisitRecordOn visit) const {
  NodeForces forces(x.size());
  Vec3& force = forces.force[index_of(node)];
  Vec3& torque = forces.torque[index_of(node)];
  const auto patches = patches_.patches();
  std::uint32_t patch = 0;
  auto bond = bonds_.all().begin();
  for_each_record(x, [&](const ContactRecord& row) {
    force = torque = Vec3::Zero();
    while (patch < patches.size() && !patches[patch].pushes()) ++patch;
    if (patch < patches.size()) {
      patches[patch].add_forces(patches_.structure_pair_of(patches[patch]), forces);
      spread_.add_forces_of(patch, patches_, forces);
      ++patch;
    } else {
      bond->add_forces(patches_.structure_pairs()[bond->structure_pair], forces);
      ++bond;
    }
    visit(row, force, torque);
  });
}

ContactRecord StructureContacts::row_of(const StructureBond& bond, Positions x) const {
  const StructurePair& structure_pair = patches_.structure_pairs()[bond.structure_pair];
  const auto body = [&](const geometry::CorePoint& core) {
    return ContactBody{BodyKind::structure,
                       static_cast<std::int32_t>(patches_.surface().structure_of(core.nodes[0])),
                       core.feature};
  };
  ContactRecord row;
  row.id = bond.id;
  row.a = body(bond.a);
  row.b = body(bond.b);
  row.point_a = position(bond.a, x);
  row.point_b = position(bond.b, x);
  row.point = row.point_b + bond.lever_b(structure_pair);
  row.normal = bond.normal;
  row.gap = bond.gap;
  set_force(row, bond.other_force);
  row.moment = bond.moment;
  set_state<AnyLaw>(row, bond.parameters(structure_pair), bond.memory.history, bond.pressing);
  return row;
}

ContactRecord StructureContacts::row_of(const StructurePatch& patch,
                                        const SpreadContacts::Sum& spread, Positions x) const {
  const StructurePair& structure_pair = patches_.structure_pair_of(patch);
  const geometry::Surface& surface = patches_.surface();
  ContactRecord row;
  row.id = patch.id;
  row.a = body_of(patch.deepest[0], surface);
  row.b = body_of(patch.deepest[1], surface);
  row.point_a = patch.first.point();
  row.point_b = patch.second.point();
  row.point = row.point_b + patch.lever_of_second(structure_pair);
  row.normal = patch.memory.normal;
  row.gap = patch.gap;
  row.deepest = patch.deepest_overlap;
  const double point_force = patch.point_part * patch.normal_force;
  set_force(row, patch.other_force);
  set_state<AnyLaw>(row, patch.parameters(structure_pair), patch.memory.history, point_force);
  // What spread contacts carry all of has no friction of its own.
  const bool is_spread = !(patch.point_part > 0.0) && !spread.is_empty;
  row.is_slipping = (is_spread || row.is_slipping) && !spread.sticks;
  row.elastic_force = patch.normal_force;
  set_force(row, patch.elastic_force + patch.second.total_attraction() + patch.other_force +
                     spread.force);
  row.moment = patch.second.moment_about(row.point, x) + spread.moment;
  row.moment += patch.moment;
  return row;
}

// The state.

void StructureContacts::exchange(const geometry::StateArchive& archive,
                                 geometry::FunctionRef<void()> list) {
  // Of the pairs, those that are in a patch or have friction of their own.
  std::vector<PairOfCells> touching;
  if (archive.is_reading()) {
    patches_.clear();
    spread_.clear();
    bonds_.clear();
    list();
  } else {
    for (const PairOfCells& pair : patches_.pairs())
      if (pair.patch >= 0 || pair.spread >= 0) touching.push_back(pair);
  }
  patches_.exchange(archive);
  spread_.exchange(archive, patches_);
  bonds_.exchange(archive, patches_);
  archive.rows("pairs", touching,
               [&](geometry::RowFields& row, PairOfCells& pair) { exchange_pair(row, pair); });
  if (!archive.is_reading()) return;
  const auto pairs = patches_.pairs();
  std::size_t place = 0;
  for (const PairOfCells& kept : touching) {
    place =
        next_place(place, pairs.size(), [&](std::size_t i) { return pairs[i].cells < kept.cells; });
    if (place == pairs.size() || pairs[place].cells != kept.cells) throw_unlisted_contact();
    pairs[place] = kept;
  }
  spread_.follow_list(patches_);
  bonds_.follow_list(patches_);
}

void StructureContacts::exchange_pair(geometry::RowFields& row, PairOfCells& pair) const {
  row("cell_a", pair.cells.a);
  row("cell_b", pair.cells.b);
  row("patch", pair.patch);
  pair.sides.exchange(row, "are_crossed");
  row("spread", pair.spread);
  row.require(pair.patch >= -1 && pair.patch < std::ssize(patches_.patches()), "patch");
  row.require(pair.spread >= -1 && pair.spread < static_cast<std::ptrdiff_t>(spread_.size()),
              "spread");
}

}  // namespace plekton::contact
