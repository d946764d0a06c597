// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/structure_bonds.hpp"

#include "contact/surface_surface/pressed_points.hpp"

#include <cmath>
#include <optional>

namespace plekton::contact::structure {

// Which pairs of cells they belong to.

void StructureBonds::drop_broken(StructurePatches& patches) {
  if (std::erase_if(bonds_, [](const StructureBond& bond) { return bond.is_broken; }) > 0)
    follow_list(patches);
}

void StructureBonds::follow_list(StructurePatches& patches) {
  const auto pairs = patches.pairs();
  for (PairOfCells& pair : pairs) pair.bond = -1;
  for (std::size_t i = 0; i < bonds_.size(); ++i) {
    StructureBond& bond = bonds_[i];
    const auto pair = std::ranges::lower_bound(pairs, bond.cells, {}, &PairOfCells::cells);
    const bool is_listed = pair != pairs.end() && pair->cells == bond.cells;
    bond.pair = is_listed ? static_cast<std::int32_t>(pair - pairs.begin()) : -1;
    if (is_listed) pair->bond = static_cast<std::int32_t>(i);
  }
}

double StructureBonds::follow(const geometry::SurfaceChange& change,
                              const StructurePatches& patches) {
  double lost = 0.0;
  std::erase_if(bonds_, [&](StructureBond& bond) {
    const auto a = change.now(bond.cells.a);
    const auto b = change.now(bond.cells.b);
    const bool is_left = a && b;
    if (is_left) {
      bond.cells = {*a, *b};
      bond.a.feature = *change.now(bond.a.feature);
      bond.b.feature = *change.now(bond.b.feature);
    } else {
      lost += bond.history_energy(patches.structure_pairs()[bond.structure_pair]);
    }
    return !is_left;
  });
  return lost;
}

/// That of its cells, or one that follows the patch of the last step; -1: there is none.
std::int32_t StructureBonds::patch_of(const StructureBond& bond,
                                      const StructurePatches& patches) const {
  if (bond.pair >= 0) {
    const PairOfCells& pair = patches.pairs()[static_cast<std::size_t>(bond.pair)];
    if (pair.patch >= 0) return pair.patch;
  }
  if (bond.patch < 0) return -1;
  const auto successors = patches.successors_of(static_cast<std::uint32_t>(bond.patch));
  return successors.empty() ? -1 : static_cast<std::int32_t>(successors.front().patch);
}

// Where they are formed.

double StructureBonds::find(StructurePatches& patches, const Motion& motion,
                            geometry::ThreadPool& pool) {
  if (bonds_.empty() && !patches.glues()) return 0.0;
  for (StructureBond& bond : bonds_) bond.patch = patch_of(bond, patches);
  pool.for_each_range(bonds_.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i)
      bonds_[i].locate(patches.structure_pairs()[bonds_[i].structure_pair], motion.position);
  });
  const double lost = form(patches, motion.position);
  free_patches_of_pressing(patches);
  return lost;
}

/// What presses on bonds is not held by the friction of their patch.
void StructureBonds::free_patches_of_pressing(StructurePatches& patches) {
  for (const StructureBond& bond : bonds_) {
    if (bond.patch >= 0) gluing_[static_cast<std::size_t>(bond.patch)].pressing += bond.pressing;
  }
  for (std::size_t i = 0; i < gluing_.size(); ++i) {
    StructurePatch& patch = patches.patches()[i];
    const double share = gluing_[i].pressing / patch.normal_force;
    if (gluing_[i].pressing > 0.0) patch.free_part = std::max(0.0, 1.0 - share);
  }
}

/// Glues what patches count for beyond their bonds. @returns the energy (J) lost
double StructureBonds::form(StructurePatches& patches, Positions x) {
  constexpr double kLeastGrowth = 1e-6;  // part of a patch that is worth the time
  gluing_.assign(patches.patches().size(), {});
  for (const StructureBond& bond : bonds_) {
    if (bond.patch >= 0) gluing_[static_cast<std::size_t>(bond.patch)].bonds += bond.count;
  }
  if (!patches.glues()) return 0.0;
  list_pressed_pairs(patches);
  for (Pressed& pressed : pressed_) {
    Gluing& gluing = gluing_[pressed.patch];
    const std::int32_t bond = patches.pairs()[pressed.pair].bond;
    const double has = bond < 0 ? 0.0 : bonds_[static_cast<std::size_t>(bond)].count;
    pressed.wants = std::max(0.0, gluing.count_of(pressed.near, pressed.wide) - has);
    gluing.wants += pressed.wants;
  }
  double lost = 0.0;
  for (const Pressed& pressed : pressed_) {
    const Gluing& gluing = gluing_[pressed.patch];
    const double missing = gluing.near + gluing.wide - gluing.bonds;
    if (pressed.wants > 0.0 && missing > kLeastGrowth * (gluing.near + gluing.wide))
      lost += glue_pair(patches, pressed, missing * pressed.wants / gluing.wants, x);
  }
  return lost;
}

/// How many contacts a term of two cells counts for beside its nearest points: as many as give that
/// part of its force along the patch's normal at its mean overlap.
/// @param deepest  N, of one contact at the nearest points
double StructureBonds::wide_count(const PairTerms& terms, std::uint32_t acting,
                                  const AnyLaw::Parameters& parameters, double deepest,
                                  const Vec3& normal) {
  const PairTerm& term = terms[acting];
  double push = std::abs(force_on_a(term).dot(normal));
  double energy = term.forces.energy;
  double of_point = term.point_share * term.weight * deepest;
  // What the shares of points do as facets turn is no push: of two that have no area over each
  // other it is all there is.
  if (const PairForces* const extent = terms.extent(acting)) {
    const Vec3 force = extent->on_a[0] + extent->on_a[1] + extent->on_a[2];
    push = std::abs(force.dot(normal));
    energy = extent->energy;
    of_point = 0.0;
  }
  if (!(push > 0.0) || !(energy > 0.0)) return 0.0;
  push *= pushing_part(parameters, energy, push, term.overlap);
  const double one =
      AnyLaw::elastic_normal_force(parameters, -mean_overlap(parameters, energy, push));
  return one > 0.0 ? std::max(0.0, push - of_point) / one : 0.0;
}

/// Pairs of cells in patches that may have bonds, and how many contacts they count for: as many as
/// give their force along the patch's normal at its mean overlap.
void StructureBonds::list_pressed_pairs(const StructurePatches& patches) {
  const PairTerms& terms = patches.terms();
  pressed_.clear();
  near_push_.assign(patches.pairs().size(), 0.0);
  for (const std::uint32_t acting : terms.acting()) add_near_push(patches, terms[acting]);
  for (const std::uint32_t acting : terms.acting()) {
    const PairTerm& term = terms[acting];
    const AnyLaw::Parameters& parameters = patches.structure_pairs()[term.spring].parameters;
    if (!term.is_of_cells || !AnyLaw::cements(parameters)) continue;
    const Holder& holder = terms.holders(term).front();
    const auto at = static_cast<std::uint32_t>(patches.pairs()[holder.pair].patch);
    const StructurePatch& patch = patches.patches()[at];
    if (patch.is_torn || !patch.pushes()) continue;
    const NormalSpring& spring = patches.spring_of(term);
    const double deepest = spring.force(spring.range() - term.overlap);
    if (!(deepest > 0.0)) continue;
    const double near = near_push_[holder.pair] / deepest;
    const double wide = wide_count(terms, acting, parameters, deepest, patch.normal());
    pressed_.push_back({holder.pair, at, acting, holder.sides, near, wide, 0.0});
    gluing_[at].near += near;
    gluing_[at].positive += std::max(0.0, near);
    gluing_[at].wide += wide;
  }
}

/// Gives what a term does at its nearest points to the pairs of cells that have these: what is
/// taken off for a side goes to the cell that is nearest there, and leaves nothing of it. Of a
/// saddle between two cells each has an equal part.
void StructureBonds::add_near_push(const StructurePatches& patches, const PairTerm& term) {
  const PairTerms& terms = patches.terms();
  const NormalSpring& spring = patches.spring_of(term);
  const double push = term.point_share * term.weight * spring.force(spring.range() - term.overlap);
  const auto holders = terms.holders(term);
  const auto has_them = [&](const Holder& holder) {
    return terms.of_cells(holder.pair).overlap == term.overlap;
  };
  const auto having = std::count_if(holders.begin(), holders.end(), has_them);
  const double sharing = static_cast<double>(having > 0 ? having : std::ssize(holders));
  for (const Holder& holder : holders) {
    if (having == 0 || has_them(holder)) near_push_[holder.pair] += push / sharing;
  }
}

/// @returns the energy (J) lost
double StructureBonds::glue_pair(StructurePatches& patches, const Pressed& pressed, double count,
                                 Positions x) {
  PairOfCells& pair = patches.pairs()[pressed.pair];
  const PairTerm& term = patches.terms()[pressed.term];
  const StructurePair& bodies = patches.structure_pairs()[term.spring];
  const auto at = pressed_points(patches.surface(), term, patches.spring_of(term).range(), x);
  if (pair.bond >= 0) return bonds_[static_cast<std::size_t>(pair.bond)].grow(bodies, at, count, x);
  std::optional<StructureBond> bond = new_bond(bodies, at, count, x);
  if (!bond) return 0.0;
  bond->cells = pair.cells;
  bond->sides = pressed.sides;
  bond->structure_pair = term.spring;
  bond->pair = static_cast<std::int32_t>(pressed.pair);
  bond->patch = static_cast<std::int32_t>(pressed.patch);
  pair.bond = static_cast<std::int32_t>(bonds_.size());
  bonds_.push_back(*bond);
  return 0.0;
}

// What they do, and what is left of them when they break.

double StructureBonds::apply_law(StructurePatches& patches, SpreadContacts& spread,
                                 const Motion& motion, double dt, geometry::ThreadPool& pool) {
  pool.for_each_range(bonds_.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i)
      bonds_[i].apply_law(patches.structure_pairs()[bonds_[i].structure_pair], motion, dt);
  });
  double dissipated = 0.0;
  for (StructureBond& bond : bonds_) {
    dissipated += bond.dissipated;
    if (bond.is_broken) dissipated += hand_over(bond, patches, spread);
  }
  return dissipated;
}

/// @returns the energy (J) lost
double StructureBonds::hand_over(StructureBond& bond, StructurePatches& patches,
                                 SpreadContacts& spread) const {
  double lost = bond.history_energy(patches.structure_pairs()[bond.structure_pair]);
  if (bond.patch >= 0) {
    StructurePatch& patch = patches.patches()[static_cast<std::size_t>(bond.patch)];
    patch.is_torn = true;
    if (bond.pair >= 0) {
      const PairOfCells& pair = patches.pairs()[static_cast<std::size_t>(bond.pair)];
      if (pair.spread >= 0)
        lost -= hand_to_spread(bond, spread[pair.spread], patches);
      else if (pair.patch >= 0 && patch.pushes())
        lost -= hand_to_patch(bond, bond.sides.with(pair.sides), patch, patches);
    }
  }
  bond.memory.history = {};
  return lost;
}

/// @param sides  how the bond's points go with those of the patch
/// @returns the energy (J) that the patch gains
double StructureBonds::hand_to_patch(const StructureBond& bond, Sides sides, StructurePatch& patch,
                                     const StructurePatches& patches) const {
  const double sign = sides.sign();
  const double before = patches.history_energy(patch);
  AnyLaw::accumulate_history(patch.memory.history,
                             carried_history<AnyLaw>(bond.memory, sign * patch.memory.normal, 0.0),
                             sign);
  return patches.history_energy(patch) - before;
}

/// The bond's points a and b are on the facets a and b. @returns the energy (J) that these gain
double StructureBonds::hand_to_spread(const StructureBond& bond, SpreadContact& spread,
                                      const StructurePatches& patches) const {
  const double before = spread.energy;
  auto carried = carried_history<AnyLaw>(bond.memory, spread.memory.normal, 0.0);
  if (bond.count > 0.0) AnyLaw::scale_history(carried, spread.count / bond.count);
  AnyLaw::accumulate_history(spread.memory.history, carried,
                             std::min(1.0, bond.count / spread.count));
  spread.find_energy(patches.structure_pairs()[spread.structure_pair],
                     patches.patches()[spread.patch].free_part);
  return spread.energy - before;
}

void StructureBonds::add_forces(const StructurePatches& patches, NodeForces& forces) const {
  for (const StructureBond& bond : bonds_)
    bond.add_forces(patches.structure_pairs()[bond.structure_pair], forces);
}

double StructureBonds::elastic_energy(const StructurePatches& patches) const {
  double energy = 0.0;
  for (const StructureBond& bond : bonds_)
    energy += bond.history_energy(patches.structure_pairs()[bond.structure_pair]);
  return energy;
}

void StructureBonds::for_each_stiffness(
    const StructurePatches& patches,
    geometry::FunctionRef<void(NodeId, const PairStiffness&, double)> visit) const {
  for (const StructureBond& bond : bonds_) {
    if (bond.gap < 0.0 || bond.is_broken) continue;
    const StructurePair& structure_pair = patches.structure_pairs()[bond.structure_pair];
    const auto parameters = bond.parameters(structure_pair);
    const PairStiffness stiffness = PairSprings(parameters).stiffness(0.0);
    const auto on = [&](const geometry::CorePoint& core, double radius) {
      for (std::size_t i = 0; i < 3; ++i)
        visit(core.nodes[i], core.weights[static_cast<int>(i)] * stiffness, radius);
    };
    on(bond.a, structure_pair.radius_first);
    on(bond.b, structure_pair.radius_second);
  }
}

void StructureBonds::exchange(const geometry::StateArchive& archive,
                              const StructurePatches& patches) {
  archive.rows("bonds", bonds_, [&](geometry::RowFields& row, StructureBond& bond) {
    bond.exchange(row, patches.structure_pairs(), patches.surface());
    row.require(bond.patch >= -1 && bond.patch < std::ssize(patches.patches()), "patch");
  });
}

}  // namespace plekton::contact::structure
