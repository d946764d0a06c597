// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/structure_patches.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace plekton::contact::structure {
namespace {

/// Where the successors of one patch end that begin here.
template <class Iterator>
Iterator end_of_group(Iterator begin, Iterator end) {
  return std::find_if(begin, end, [&](const PatchSuccessor& successor) {
    return successor.old_patch != begin->old_patch;
  });
}

}  // namespace

double StructurePatches::rebuild(std::span<const geometry::CellPair> pairs,
                                 const ContactMaterials& materials) {
  listed_.clear();
  lives_.assign(patches_.size(), 0);
  auto old = pairs_.begin();
  for (const geometry::CellPair& cells : pairs) {
    while (old != pairs_.end() && old->cells < cells) ++old;
    const bool known = old != pairs_.end() && old->cells == cells;
    listed_.push_back(known ? *old : PairOfCells{cells});
    if (known && old->patch >= 0) lives_[static_cast<std::size_t>(old->patch)] = 1;
  }
  pairs_.swap(listed_);
  structure_pairs_.know_structures(*surface_, materials);
  terms_.rebuild(pairs, [&](std::int32_t first, std::int32_t second) {
    return structure_pairs_.place_of(first, second, materials.pairs);
  });
  double lost = 0.0;
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    if (lives_[i] != 0) continue;
    lost += history_energy(patches_[i]);
    patches_[i].memory = {};  // so that it is not lost again when nothing follows the patch
  }
  return lost;
}

void StructurePatches::take_parameters(const ContactMaterials& materials) {
  structure_pairs_.take_parameters(*surface_, materials);
}

// Which pairs of cells are one patch, and where their forces act.

void StructurePatches::find(const Motion& motion, geometry::ThreadPool& pool) {
  terms_.evaluate(structure_pairs_.springs(), motion, pool);
  previous_.clear();
  for (const StructurePatch& patch : patches_) {
    const double last_power =
        terms_.acting_changed() ? patch.last_power(structure_pair_of(patch), motion) : 0.0;
    previous_.push_back({patch.memory, patch.point_count(), history_energy(patch), last_power,
                         patch.id, patch.normal_force, patch.is_torn});
  }
  if (terms_.acting_changed()) {
    take_parts();
    find_places();
  }
  find_successors();
  add_up_patches(motion.position, pool);
}

/// Each part is a patch, with its number.
void StructurePatches::take_parts() {
  const TermParts& parts = terms_.parts();
  for (std::uint32_t i = 0; i < pairs_.size(); ++i) {
    PairOfCells& pair = pairs_[i];
    pair.old_patch = pair.patch;
    pair.old_sides = pair.sides;
    pair.patch = parts.part_of(i);
    if (pair.patch >= 0) pair.sides = parts.sides_of(i);
  }
  set_patch_count(parts.count());
}

/// Those that are no more keep their room for others.
void StructurePatches::set_patch_count(std::size_t count) {
  for (; patches_.size() > count; patches_.pop_back()) spare_.push_back(std::move(patches_.back()));
  while (patches_.size() < count && !spare_.empty()) {
    patches_.push_back(std::move(spare_.back()));
    spare_.pop_back();
  }
  patches_.resize(count);
}

void StructurePatches::find_places() {
  for (StructurePatch& patch : patches_) {
    patch.first.clear();
    patch.second.clear();
  }
  places_.clear();
  for (const std::uint32_t acting : terms_.acting()) {
    const PairTerm& term = terms_[acting];
    const Holder& holder = terms_.holders(term).front();
    const PairOfCells& pair = pairs_[holder.pair];
    const Sides sides = holder.sides.with(pair.sides);
    places_.push_back({static_cast<std::uint32_t>(pair.patch), sides, {}, {}});
    StructurePatch& patch = patches_[places_.back().patch];
    patch.structure_pair = term.spring;
    for (const NodeId node : term.a) sides.first(patch.first, patch.second).add(node);
    for (const NodeId node : term.b) sides.second(patch.first, patch.second).add(node);
  }
  for (StructurePatch& patch : patches_) {
    patch.first.sort();
    patch.second.sort();
  }
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const PairTerm& term = terms_[terms_.acting()[i]];
    TermPlaces& places = places_[i];
    const StructurePatch& patch = patches_[places.patch];
    const PatchSide& side_a = places.sides.first(patch.first, patch.second);
    const PatchSide& side_b = places.sides.second(patch.first, patch.second);
    for (std::size_t k = 0; k < term.a.count; ++k) places.a[k] = side_a.place_of(term.a.ids[k]);
    for (std::size_t k = 0; k < term.b.count; ++k) places.b[k] = side_b.place_of(term.b.ids[k]);
  }
}

void StructurePatches::add_up_patches(Positions x, geometry::ThreadPool& pool) {
  energies_.resize(patches_.size());
  pool.for_each_shared(patches_.size(), [&](std::size_t i, int) { add_up_patch(i, x); });
  largest_overlap_ratio_ = 0.0;
  crossings_ = 0;
  for (const StructurePatch& patch : patches_) {
    const StructurePair& bodies = structure_pair_of(patch);
    const double radius = std::min(bodies.radius_first, bodies.radius_second);
    largest_overlap_ratio_ = std::max(largest_overlap_ratio_, patch.deepest_overlap / radius);
    crossings_ += patch.crossings;
  }
  for (const PatchSuccessor& successor : successors_)
    patches_[successor.patch].is_torn |= previous_[successor.old_patch].is_torn;
}

void StructurePatches::add_up_patch(std::size_t i, Positions x) {
  StructurePatch& patch = patches_[i];
  patch.reset();
  energies_[i] = energy_of(i);
  patch.energy = energies_[i].value();
  for (const std::uint32_t place : terms_.parts().places(i))
    add_up_term(terms_.acting()[place], places_[place], x);
  patch.find_totals(structure_pair_of(patch), x);
}

PatchEnergy StructurePatches::energy_of(std::size_t patch) const noexcept {
  PatchEnergy energy;
  for (const std::uint32_t place : terms_.parts().places(patch)) {
    const std::uint32_t acting = terms_.acting()[place];
    energy.add(acting, terms_[acting]);
  }
  return energy;
}

void StructurePatches::add_up_term(std::uint32_t acting, const TermPlaces& places, Positions x) {
  const PairTerm& term = terms_[acting];
  StructurePatch& patch = patches_[places.patch];
  patch.crossings += term.is_of_cells && term.meets ? 1 : 0;
  if (term.overlap > patch.deepest_overlap) {
    patch.deepest_overlap = term.overlap;
    patch.deepest = {places.sides.first(term.a, term.b), places.sides.second(term.a, term.b)};
  }
  PatchSide& side_a = places.sides.first(patch.first, patch.second);
  PatchSide& side_b = places.sides.second(patch.first, patch.second);
  const auto push = [&](const PairForces& by, double part) {
    for (std::size_t k = 0; k < term.a.count; ++k) side_a.add_force(places.a[k], part * by.on_a[k]);
    for (std::size_t k = 0; k < term.b.count; ++k) side_b.add_force(places.b[k], part * by.on_b[k]);
  };
  const PatchEnergy& energy = energies_[places.patch];
  if (!energy.is_of_one()) {
    push(term.forces, 1.0);
    if (const PairForces* const ends = terms_.at_ends(acting)) push(*ends, 1.0);
  } else if (energy.most_term == acting) {
    push(terms_.own_forces(acting, spring_of(term), x), PatchEnergy::kLeastOfOne);
  }
  const auto attract = [&](const PairForces* by) {
    if (by == nullptr) return;
    patch.attraction_energy += by->energy;
    for (std::size_t k = 0; k < term.a.count; ++k) side_a.add_attraction(places.a[k], by->on_a[k]);
    for (std::size_t k = 0; k < term.b.count; ++k) side_b.add_attraction(places.b[k], by->on_b[k]);
  };
  attract(terms_.attraction(acting));
  attract(terms_.attraction_at_ends(acting));
}

// What patches of one step leave to those of the next.

void StructurePatches::find_successors() {
  successors_.clear();
  if (!terms_.acting_changed()) {
    for (std::uint32_t i = 0; i < patches_.size(); ++i) successors_.push_back({i, i, {}});
    return;
  }
  for (const PairOfCells& pair : pairs_) {
    if (pair.old_patch < 0 || pair.patch < 0) continue;
    successors_.push_back({static_cast<std::uint32_t>(pair.old_patch),
                           static_cast<std::uint32_t>(pair.patch),
                           pair.old_sides.with(pair.sides)});
  }
  std::sort(successors_.begin(), successors_.end());
  successors_.erase(std::unique(successors_.begin(), successors_.end(),
                                [](const PatchSuccessor& p, const PatchSuccessor& q) {
                                  return p.old_patch == q.old_patch && p.patch == q.patch;
                                }),
                    successors_.end());
}

EnergyLoss StructurePatches::transfer(const Motion& motion, double dt) {
  EnergyLoss loss;
  auto begin = successors_.begin();
  for (std::uint32_t i = 0; i < previous_.size(); ++i) {
    const Predecessor& old = previous_[i];
    if (begin == successors_.end() || begin->old_patch != i) {
      loss.dissipated += old.energy - dt * old.last_power;
      continue;
    }
    const auto end = end_of_group(begin, successors_.end());
    loss.tracking += old.energy;
    hand_on_number(old, {begin, end});
    hand_on_history(old, {begin, end}, motion, dt);
    begin = end;
  }
  for (const StructurePatch& patch : patches_) loss.tracking -= history_energy(patch);
  return loss;
}

/// Each gets as much of the force as it pushes. With these forces F_i in all F, and contacts c_i,
/// their springs store as much as one of F² / sum F_i² / c_i contacts: where that is what the old
/// one was, as where it splits, both its force and its energy stay. One that pushes without energy
/// counts for no contact, and gets nothing.
void StructurePatches::hand_on_history(const Predecessor& old,
                                       std::span<const PatchSuccessor> successors,
                                       const Motion& motion, double dt) {
  double total = 0.0, squares = 0.0;
  for (const PatchSuccessor& successor : successors) {
    const StructurePatch& patch = patches_[successor.patch];
    total += patch.normal_force;
    if (patch.point_count() > 0.0)
      squares += patch.normal_force * patch.normal_force / patch.point_count();
  }
  if (!(squares > 0.0 && old.count > 0.0)) return;
  const double contacts = std::min(old.count, total * total / squares);
  for (const PatchSuccessor& successor : successors) {
    StructurePatch& patch = patches_[successor.patch];
    if (!(patch.point_count() > 0.0)) continue;
    const double sign = successor.sides.sign();
    const Vec3 normal = sign / patch.normal_force * patch.elastic_force;
    const Vec3 spin =
        0.5 * (patch.first.angular_velocity(motion) + patch.second.angular_velocity(motion));
    auto carried = carried_history<AnyLaw>(old.memory, normal, dt * spin.dot(normal));
    AnyLaw::scale_history(carried, patch.point_count() / old.count);
    const double share = patch.normal_force / total * contacts / patch.point_count();
    AnyLaw::accumulate_history(patch.memory.history, carried, sign * share);
  }
}

std::span<const PatchSuccessor> StructurePatches::successors_of(
    std::uint32_t old_patch) const noexcept {
  const auto begin =
      std::ranges::lower_bound(successors_, old_patch, {}, &PatchSuccessor::old_patch);
  const auto end =
      std::ranges::upper_bound(begin, successors_.end(), old_patch, {}, &PatchSuccessor::old_patch);
  return {begin, end};
}

/// To the successor that pushes most; of patches that merge, the number of the one that pushed
/// most goes on.
void StructurePatches::hand_on_number(const Predecessor& old,
                                      std::span<const PatchSuccessor> successors) {
  const PatchSuccessor& largest = *std::max_element(
      successors.begin(), successors.end(), [&](const PatchSuccessor& p, const PatchSuccessor& q) {
        return patches_[p.patch].normal_force < patches_[q.patch].normal_force;
      });
  StructurePatch& patch = patches_[largest.patch];
  if (!(old.normal_force > patch.id_from)) return;
  patch.id = old.id;
  patch.id_from = old.normal_force;
}

// What becomes of the contacts of structures that lose some of their elements.

void StructurePatches::follow(const geometry::SurfaceChange& change) {
  std::vector<PairOfCells> left;
  for (std::uint32_t i = 0; i < pairs_.size(); ++i) {
    const PairOfCells& pair = pairs_[i];
    const auto a = change.now(pair.cells.a);
    const auto b = change.now(pair.cells.b);
    if (a && b) {
      left.push_back({{*a, *b}, pair.patch, pair.sides});
      left.back().spread = pair.spread;
    } else if (pair.patch >= 0) {
      hand_to_sides(pair, terms_.witness_features(i), change, left);
    }
  }
  std::stable_sort(left.begin(), left.end(),
                   [](const PairOfCells& p, const PairOfCells& q) { return p.cells < q.cells; });
  left.erase(
      std::unique(left.begin(), left.end(),
                  [](const PairOfCells& p, const PairOfCells& q) { return p.cells == q.cells; }),
      left.end());
  pairs_.swap(left);
  surface_ = &change.after();
  // Patches may be left of what is listed no more, which the terms of now know nothing of.
  terms_ = PairTerms(*surface_);
}

/// @param witness_features  corners of the features of both cells that hold the nearest points
void StructurePatches::hand_to_sides(const PairOfCells& pair,
                                     const std::array<geometry::FeatureNodes, 2>& witness_features,
                                     const geometry::SurfaceChange& change,
                                     std::vector<PairOfCells>& left) const {
  const auto has = [&](geometry::CellId cell, const geometry::FeatureNodes& feature) {
    const auto nodes = change.after().nodes_of(cell);
    return std::all_of(feature.begin(), feature.end(), [&](NodeId node) {
      return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
    });
  };
  const bool is_of_one =
      change.before().structure_of(pair.cells.a) == change.before().structure_of(pair.cells.b);
  for (const geometry::CellId a : change.left_of(pair.cells.a)) {
    for (const geometry::CellId b : change.left_of(pair.cells.b)) {
      if (!has(a, witness_features[0]) || !has(b, witness_features[1])) continue;
      const bool swaps = is_of_one && b < a;  // within one structure the lower cell comes first
      left.push_back({swaps ? geometry::CellPair{b, a} : geometry::CellPair{a, b}, pair.patch,
                      pair.sides.with(Sides(swaps))});
    }
  }
}

// What all patches come to.

double StructurePatches::normal_energy(const geometry::Surface& surface, const Motion& at,
                                       geometry::ThreadPool& pool) const {
  if (pairs_.empty()) return 0.0;
  std::vector<geometry::CellPair> listed;
  for (const PairOfCells& pair : pairs_) listed.push_back(pair.cells);
  StructurePatches there(surface);
  there.terms_.rebuild(listed, [this](std::int32_t first, std::int32_t second) {
    return structure_pairs_.place_of(first, second);
  });
  there.terms_.evaluate(structure_pairs_.springs(), at, pool);
  double energy = 0.0;
  for (std::size_t part = 0; part < there.terms_.parts().count(); ++part)
    energy += there.energy_of(part).value();
  for (const std::uint32_t acting : there.terms_.acting())
    if (const PairForces* of = there.terms_.attraction(acting)) energy += of->energy;
  return energy;
}

double StructurePatches::apply_law(const Motion& motion, double dt) {
  counts_.resize(structure_pairs_.size());  // of which those without a patch are never read
  for (const StructurePatch& patch : patches_) counts_[patch.structure_pair] = 0.0;
  for (const StructurePatch& patch : patches_) counts_[patch.structure_pair] += patch.count;
  double dissipated = 0.0;
  for (StructurePatch& patch : patches_)
    dissipated += patch.apply_law(structure_pair_of(patch), count_beside(patch), motion, dt);
  return dissipated;
}

void StructurePatches::add_forces(NodeForces& forces) const {
  for (const StructurePatch& patch : patches_) patch.add_forces(structure_pair_of(patch), forces);
}

double StructurePatches::elastic_energy() const {
  double energy = 0.0;
  for (const StructurePatch& patch : patches_)
    energy += patch.energy + patch.attraction_energy + history_energy(patch);
  return energy;
}

/// The contacts of bars tell that of pairs with a bar.
void StructurePatches::for_each_stiffness(
    geometry::FunctionRef<void(NodeId, const PairStiffness&, double)> visit) const {
  for (const StructurePatch& patch : patches_) {
    if (!patch.pushes() || patch.bar_part == 1.0) continue;
    const StructurePair& structure_pair = structure_pair_of(patch);
    const auto parameters = patch.whole_parameters(structure_pair);
    const PairStiffness stiffness = PairSprings(parameters).stiffness(patch.gap);
    const auto on = [&](double radius) {
      return [&, radius](NodeId node, double share) {
        visit(node, (1.0 - patch.bar_part) * std::abs(share) * stiffness, radius);
      };
    };
    patch.first.for_each_share(on(structure_pair.radius_first));
    patch.second.for_each_share(on(structure_pair.radius_second));
  }
}

// The state.

void StructurePatches::clear() {
  pairs_.clear();
  patches_.clear();
}

void StructurePatches::exchange(const geometry::StateArchive& archive) {
  archive("largest_overlap_ratio", largest_overlap_ratio_);
  archive("crossings", crossings_);
  terms_.exchange(archive.group("terms"));
  archive.rows("patches", patches_, [&](geometry::RowFields& row, StructurePatch& patch) {
    patch.exchange(row, structure_pairs_, *surface_);
  });
}

}  // namespace plekton::contact::structure
