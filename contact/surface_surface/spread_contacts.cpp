// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/spread_contacts.hpp"

#include "contact/tracking/slip_state.hpp"

namespace plekton::contact::structure {

/// A pair that has left the list has none.
void SpreadContacts::follow_list(const StructurePatches& patches) noexcept {
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  for (SpreadContact& spread : contacts_) spread.pair = kNone;
  const auto pairs = patches.pairs();
  for (std::uint32_t i = 0; i < pairs.size(); ++i)
    if (pairs[i].spread >= 0) (*this)[pairs[i].spread].pair = i;
}

// Where they press.

void SpreadContacts::find(StructurePatches& patches, Positions x, geometry::ThreadPool& pool) {
  share_pushes(patches);
  take_bars_from_patches(patches);
  previous_.swap(contacts_);
  const PairTerms& terms = patches.terms();
  of_cells_.clear();
  for (std::uint32_t i = 0; i < patches.places().size(); ++i)
    if (terms[terms.acting()[i]].is_of_cells) of_cells_.push_back(i);
  contacts_.resize(of_cells_.size());
  presses_.resize(of_cells_.size());
  pool.for_each_shared(of_cells_.size(), [&](std::size_t i, int) {
    presses_[i] = locate(patches, of_cells_[i], contacts_[i], x);
  });
  take_from_patches(patches);
  bound_by_patches(patches);
}

/// @param place  of a term in range of two cells
/// @returns whether it presses by its extent or has a bar in it
bool SpreadContacts::locate(const StructurePatches& patches, std::uint32_t place,
                            SpreadContact& spread, Positions x) const {
  const PairTerms& terms = patches.terms();
  const std::uint32_t acting = terms.acting()[place];
  const PairTerm& term = terms[acting];
  spread = {};
  spread.pair = terms.holders(term).front().pair;
  spread.patch = patches.places()[place].patch;
  spread.sides = patches.places()[place].sides;
  spread.structure_pair = term.spring;
  if (const PairForces* const extent = terms.extent(acting))
    return spread.locate(term, *extent, patches.structure_pairs()[term.spring], x);
  return locate_bar(patches, term, spread, x);
}

/// Keeps those that press. What facets carry by their extent no patch carries.
void SpreadContacts::take_from_patches(StructurePatches& patches) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (presses_[i] == 0) continue;
    if (kept != i) contacts_[kept] = contacts_[i];
    const SpreadContact& spread = contacts_[kept++];
    StructurePatch& patch = patches.patches()[spread.patch];
    if (!spread.is_of_bar && patch.pushes())
      patch.point_part -= spread.normal_force / patch.normal_force;
  }
  contacts_.resize(kept);
  for (StructurePatch& patch : patches.patches())
    patch.point_part = std::clamp(patch.point_part, 0.0, 1.0);
}

/// Where a patch pushes as a part of one pair of cells, what its terms press with does not act:
/// together they press no more than the patch does.
void SpreadContacts::bound_by_patches(const StructurePatches& patches) {
  pressed_.assign(patches.patches().size(), 0.0);
  for (const SpreadContact& spread : contacts_) pressed_[spread.patch] += spread.normal_force;
  for (SpreadContact& spread : contacts_) {
    const double force = patches.patches()[spread.patch].normal_force;
    if (!patches.is_of_one(spread.patch) || !(force > 0.0 && force < pressed_[spread.patch]))
      continue;
    const double part = force / pressed_[spread.patch];
    spread.elastic_force *= part;
    spread.normal_force *= part;
    spread.count *= part;
  }
}

/// How hard every pair of cells with a bar in it presses: its part of what all terms do that it
/// has, of each as much as every other pair has that has it. That is the rule of inclusion and
/// exclusion again: the joints of a chain take from the bars beside them what these have together.
void SpreadContacts::share_pushes(const StructurePatches& patches) {
  const PairTerms& terms = patches.terms();
  const auto pairs = patches.pairs();
  bar_push_.assign(pairs.size(), 0.0);
  pressing_.assign(patches.patches().size(), {});
  if (!terms.have_bars()) return;
  for (std::size_t i = 0; i < patches.places().size(); ++i) {
    const PairTerm& term = terms[terms.acting()[i]];
    const auto holders = terms.holders(term);
    const double part = 1.0 / static_cast<double>(holders.size());
    std::size_t bars = 0;
    for (const Holder& holder : holders) {
      const PairTerm& cells = terms.of_cells(holder.pair);
      if (cells.a.count == 3 && cells.b.count == 3) continue;
      bar_push_[holder.pair] += part * term.push;
      ++bars;
    }
    const double of_bars = bars == holders.size() ? 1.0 : part * static_cast<double>(bars);
    Pressing& pressing = pressing_[patches.places()[i].patch];
    pressing.all += term.push;
    const NormalSpring& spring = patches.spring_of(term);
    pressing.deepest = std::max(pressing.deepest, spring.force(spring.range() - term.overlap));
    pressing.bars += of_bars * term.push;
    pressing.energy += of_bars * term.forces.energy;
    pressing.wrapped += terms.wrapped(terms.acting()[i]);
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (bar_push_[i] > 0.0)
      pressing_[static_cast<std::size_t>(pairs[i].patch)].positive += bar_push_[i];
  }
}

void SpreadContacts::take_bars_from_patches(StructurePatches& patches) const {
  for (std::size_t i = 0; i < pressing_.size(); ++i) {
    const Pressing& of = pressing_[i];
    StructurePatch& patch = patches.patches()[i];
    if (of.bars > 0.0 && of.energy > 0.0 && of.positive > 0.0)
      patch.bar_part = std::clamp(of.bars / of.all, 0.0, 1.0);
    patch.point_part -= patch.bar_part;
  }
}

/// What pairs push less than nothing is taken from the others of their patch. Pairs of a patch that
/// is one contact have its normal, so that their springs add up to one.
/// @returns whether it presses
bool SpreadContacts::locate_bar(const StructurePatches& patches, const PairTerm& term,
                                SpreadContact& spread, Positions x) const {
  const Pressing& of = pressing_[spread.patch];
  const StructurePatch& patch = patches.patches()[spread.patch];
  const double push = bar_push_[spread.pair];
  if (!(push > 0.0) || !(patch.bar_part > 0.0)) return false;
  spread.is_wrapped = of.wrapped > 0.0;
  const double own = of.spread();
  Vec3 towards = spread.sides.sign() * (1.0 - own) * patch.elastic_force;
  if (patch.pushes()) towards /= patch.normal_force;
  const StructurePair& bodies = patches.structure_pairs()[term.spring];
  const double overlap = mean_overlap(bodies.parameters, of.energy, of.bars);
  return spread.locate_bar(
      term, {push * std::min(1.0, of.bars / of.positive), overlap, towards, own, of.whole()},
      bodies, x);
}

// What those of the last step leave to those of this one.

EnergyLoss SpreadContacts::carry(StructurePatches& patches, const Motion& motion, double dt) {
  EnergyLoss loss;
  at_.assign(patches.pairs().size(), -1);
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    at_[contacts_[i].pair] = static_cast<std::int32_t>(i);
  find_transfers(patches);
  for (SpreadContact& spread : contacts_) {
    const std::int32_t before = patches.pairs()[spread.pair].spread;
    if (before < 0) continue;
    const auto old = static_cast<std::uint32_t>(before);
    take_over(old, spread, std::min(previous_[old].count, spread.count), motion, dt, loss);
  }
  for (const Transfer& of : transfers_)
    take_over(of.from, contacts_[of.to], of.contacts, motion, dt, loss);
  for (const SpreadContact& old : previous_) {
    if (!old.is_followed)
      loss.dissipated += old.loss_at_end(patches.structure_pairs()[old.structure_pair], motion, dt);
  }
  for (SpreadContact& spread : contacts_) {
    spread.memory.normal = spread.normal();
    spread.find_energy(patches.structure_pairs()[spread.structure_pair],
                       patches.patches()[spread.patch].free_part);
    loss.tracking -= spread.energy;
  }
  for (std::size_t i = 0; i < at_.size(); ++i) patches.pairs()[i].spread = at_[i];
  return loss;
}

void SpreadContacts::take_over(std::uint32_t old, SpreadContact& spread, double contacts,
                               const Motion& motion, double dt, EnergyLoss& loss) {
  SpreadContact& from = previous_[old];
  spread.take_over(from, contacts, motion, dt);
  if (!from.is_followed) loss.tracking += from.energy;
  from.is_followed = true;
}

/// Contacts that a pair with a bar in it counted for in the last step, and does now; 0: none.
double SpreadContacts::bars_before(const PairOfCells& pair) const {
  if (pair.spread < 0) return 0.0;
  const SpreadContact& spread = previous_[static_cast<std::size_t>(pair.spread)];
  return spread.is_of_bar ? spread.count : 0.0;
}
double SpreadContacts::bars_now(std::uint32_t pair) const {
  if (at_[pair] < 0) return 0.0;
  const SpreadContact& spread = contacts_[static_cast<std::size_t>(at_[pair])];
  return spread.is_of_bar ? spread.count : 0.0;
}

/// What is given is no more than either has less or more.
void SpreadContacts::find_transfers(const StructurePatches& patches) {
  transfers_.clear();
  list_transfers_at_joints(patches);
  list_transfers_of_gone(patches);
  std::sort(transfers_.begin(), transfers_.end());
  transfers_.erase(std::unique(transfers_.begin(), transfers_.end()), transfers_.end());
  share_transfers();
}

/// From pairs that count for less than in the last step to those that share a term with them and
/// count for more.
void SpreadContacts::list_transfers_at_joints(const StructurePatches& patches) {
  const PairTerms& terms = patches.terms();
  const auto pairs = patches.pairs();
  if (!terms.have_bars()) return;
  for (const std::uint32_t acting : terms.acting()) {
    const auto holders = terms.holders(terms[acting]);
    if (holders.size() < 2) continue;
    for (const Holder& from : holders) {
      const double less = bars_before(pairs[from.pair]) - bars_now(from.pair);
      if (!(less > 0.0)) continue;
      for (const Holder& to : holders) {
        const double more = bars_now(to.pair) - bars_before(pairs[to.pair]);
        if (more > 0.0)
          transfers_.push_back({static_cast<std::uint32_t>(pairs[from.pair].spread),
                                static_cast<std::uint32_t>(at_[to.pair]), less, more});
      }
    }
  }
}

/// From pairs that press no more, and so have no term with others either: to those beside them in
/// the patches that follow theirs.
void SpreadContacts::list_transfers_of_gone(const StructurePatches& patches) {
  const auto pairs = patches.pairs();
  goes_on_.assign(previous_.size(), 0);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (pairs[i].spread >= 0 && at_[i] >= 0)
      goes_on_[static_cast<std::size_t>(pairs[i].spread)] = 1;
  by_patch_.clear();
  for (std::uint32_t from = 0; from < previous_.size(); ++from) {
    const SpreadContact& old = previous_[from];
    if (goes_on_[from] != 0 || !old.is_of_bar) continue;
    if (by_patch_.empty()) {
      for (std::uint32_t i = 0; i < contacts_.size(); ++i)
        if (contacts_[i].is_of_bar) by_patch_.push_back({contacts_[i].patch, i});
      std::sort(by_patch_.begin(), by_patch_.end());
    }
    for (const PatchSuccessor& successor : patches.successors_of(old.patch)) {
      auto at = std::lower_bound(by_patch_.begin(), by_patch_.end(),
                                 std::pair{successor.patch, std::uint32_t{0}});
      for (; at != by_patch_.end() && at->first == successor.patch; ++at) {
        const SpreadContact& to = contacts_[at->second];
        const double more = bars_now(to.pair) - bars_before(pairs[to.pair]);
        if (more > 0.0 && to.is_beside(old))
          transfers_.push_back({from, at->second, old.count, more});
      }
    }
  }
}

void SpreadContacts::share_transfers() {
  asked_.assign(contacts_.size(), 0.0);
  for (auto begin = transfers_.begin(); begin != transfers_.end();) {
    auto end = begin;
    double more = 0.0;
    for (; end != transfers_.end() && end->from == begin->from; ++end) more += end->more;
    for (; begin != end; ++begin) {
      begin->contacts = begin->less * (begin->more / more);
      asked_[begin->to] += begin->contacts;
    }
  }
  for (Transfer& of : transfers_) of.contacts *= std::min(1.0, of.more / asked_[of.to]);
}

// What they do.

double SpreadContacts::apply_law(const StructurePatches& patches, const Motion& motion, double dt,
                                 geometry::ThreadPool& pool) {
  pool.for_each_range(contacts_.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      SpreadContact& spread = contacts_[i];
      const StructurePatch& patch = patches.patches()[spread.patch];
      spread.apply_law(patches.structure_pairs()[spread.structure_pair],
                       patches.count_beside(patch), patch.free_part, motion, dt);
    }
  });
  double dissipated = 0.0;
  for (const SpreadContact& spread : contacts_) dissipated += spread.dissipated;
  return dissipated;
}

std::vector<SpreadContacts::Sum> SpreadContacts::sums(const StructurePatches& patches) const {
  std::vector<Sum> sums(patches.patches().size());
  for (const SpreadContact& spread : contacts_) {
    const StructurePair& structure_pair = patches.structure_pairs()[spread.structure_pair];
    const StructurePatch& patch = patches.patches()[spread.patch];
    const double sign = spread.sides.sign();
    const Vec3 force = sign * spread.other_force;
    const Vec3 about = patch.second.point() + patch.lever_of_second(structure_pair);
    const Vec3 point = spread.b.point + spread.lever_b(structure_pair);
    Sum& sum = sums[spread.patch];
    sum.force += force;
    sum.moment += sign * spread.moment + (point - about).cross(force);
    const Vec3 along =
        spread.other_force - spread.other_force.dot(spread.memory.normal) * spread.memory.normal;
    sum.is_empty = false;
    sum.sticks =
        sum.sticks || !is_at_limit<AnyLaw>(spread.parameters(structure_pair, patch.free_part),
                                           spread.memory.history, spread.normal_force, along);
  }
  return sums;
}

void SpreadContacts::add_forces(const StructurePatches& patches, NodeForces& forces) const {
  for (const SpreadContact& spread : contacts_)
    spread.add_forces(patches.structure_pairs()[spread.structure_pair], forces);
}

void SpreadContacts::add_forces_of(std::uint32_t patch, const StructurePatches& patches,
                                   NodeForces& forces) const {
  for (const SpreadContact& spread : contacts_) {
    if (spread.patch == patch)
      spread.add_forces(patches.structure_pairs()[spread.structure_pair], forces);
  }
}

double SpreadContacts::elastic_energy() const {
  double energy = 0.0;
  for (const SpreadContact& spread : contacts_) energy += spread.energy;
  return energy;
}

void SpreadContacts::for_each_stiffness(
    const StructurePatches& patches,
    geometry::FunctionRef<void(NodeId, const PairStiffness&, double)> visit) const {
  for (const SpreadContact& spread : contacts_) {
    if (!spread.is_of_bar) continue;
    const StructurePair& structure_pair = patches.structure_pairs()[spread.structure_pair];
    // Joints in a wrap move one by one, against the whole spring of a bar.
    const double contacts = spread.is_wrapped ? std::max(1.0, spread.count) : spread.count;
    const auto parameters = AnyLaw::scaled(structure_pair.parameters, contacts);
    const PairStiffness stiffness = PairSprings(parameters).stiffness(spread.gap);
    const auto on = [&](const SpreadContact::Side& side, double radius) {
      for (std::size_t i = 0; i < 3; ++i) visit(side.nodes[i], side.shares[i] * stiffness, radius);
    };
    on(spread.a, structure_pair.radius_first);
    on(spread.b, structure_pair.radius_second);
  }
}

void SpreadContacts::exchange(const geometry::StateArchive& archive,
                              const StructurePatches& patches) {
  archive.rows("spread", contacts_, [&](geometry::RowFields& row, SpreadContact& spread) {
    spread.exchange(row, patches.structure_pairs(), patches.surface());
    row.require(spread.patch < patches.patches().size(), "patch");
  });
}

}  // namespace plekton::contact::structure
