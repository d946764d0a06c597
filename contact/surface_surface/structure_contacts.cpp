// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/structure_contacts.hpp"

#include "contact/base/bodies.hpp"
#include "contact/tracking/contact_state.hpp"
#include "contact/tracking/slip_state.hpp"
#include "geometry/primitives/surface_change.hpp"

#include <algorithm>

namespace plekton::contact {

double StructureContacts::rebuild(std::span<const geometry::CellPair> pairs,
                                  const ContactMaterials& materials) {
  std::vector<PairOfCells> listed;
  std::vector<char> lives(patches_.size(), 0);
  auto old = pairs_.begin();
  for (const geometry::CellPair& cells : pairs) {
    while (old != pairs_.end() && old->cells < cells) ++old;
    const bool known = old != pairs_.end() && old->cells == cells;
    listed.push_back(known ? *old : PairOfCells{cells});
    if (known && old->patch >= 0) lives[static_cast<std::size_t>(old->patch)] = 1;
  }
  pairs_.swap(listed);
  place_spreads();
  if (!bonds_.empty()) match_bonds();
  if (structure_pairs_.empty()) make_structure_pairs(materials);
  terms_.rebuild(pairs);
  double lost = 0.0;
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    if (lives[i]) continue;
    lost += history_energy(patches_[i]);
    patches_[i].memory = {};  // so that it is not lost again when nothing follows the patch
  }
  return lost;
}

/// Tells those of the last step where their pairs are in the list; of a pair that has left it none.
void StructureContacts::place_spreads() noexcept {
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  for (Spread& spread : spreads_) spread.pair = kNone;
  for (std::uint32_t i = 0; i < pairs_.size(); ++i)
    if (pairs_[i].spread >= 0) spreads_[static_cast<std::size_t>(pairs_[i].spread)].pair = i;
}

EnergyLoss StructureContacts::advance(const Motion& motion, double dt, geometry::ThreadPool& pool) {
  if (terms_.empty() && patches_.empty() && bonds_.empty()) return {};
  terms_.evaluate(springs_, motion, pool);
  previous_.clear();
  for (const Patch& patch : patches_) {
    previous_.push_back({patch.memory, patch.structure_pair, patch.point_count(),
                         history_energy(patch), patch.id, patch.normal_force, patch.is_torn});
  }
  drop_broken_bonds();
  if (terms_.acting_changed()) {
    find_patches();
    find_places();
  }
  find_successors();
  add_up_patches(motion.position);
  find_spreads(motion.position);
  EnergyLoss loss;
  loss.tracking = prepare_bonds(motion, pool);
  loss += transfer(motion, dt);
  loss += carry_spreads(motion, dt);
  for (Patch& patch : patches_)
    loss.dissipated += patch.apply_law(structure_pair_of(patch), motion, dt);
  loss.dissipated += advance_spreads(motion, dt, pool);
  loss.dissipated += advance_bonds(motion, dt, pool);
  return loss;
}

// Which structures may touch, and with which parameters.

std::vector<structure::StructurePair> StructureContacts::find_structure_pairs(
    const ContactMaterials& materials) const {
  std::vector<StructurePair> structure_pairs;
  const std::vector<double> masses = materials.structure_masses.empty()
                                         ? structure::mean_node_masses(*surface_, materials)
                                         : materials.structure_masses;
  const auto part = [&](std::size_t i) {
    const auto id = geometry::id_at<geometry::StructureId>(i);
    return BodyPart{materials.of_structures[i], surface_->radius(id), masses[i],
                    shape_of(*surface_, id)};
  };
  for (std::size_t i = 0; i < surface_->structure_count(); ++i) {
    for (std::size_t k = i; k < surface_->structure_count(); ++k) {
      const AnyLaw::Parameters parameters = materials.pairs.combine(part(i), part(k));
      structure_pairs.push_back({AnyLaw::without_attraction(parameters), part(i).radius,
                                 part(k).radius, AnyLaw::attraction(parameters)});
    }
  }
  return structure_pairs;
}

void StructureContacts::make_structure_pairs(const ContactMaterials& materials) {
  structure_pairs_ = find_structure_pairs(materials);
  take_parameters(materials);
  for (const StructurePair& structure_pair : structure_pairs_) {
    springs_.push_back(structure::NormalSpring::of<AnyLaw>(
        structure_pair.parameters, structure_pair.radius_first + structure_pair.radius_second,
        &structure_pair.attraction));
  }
}

void StructureContacts::take_parameters(const ContactMaterials& materials) {
  if (structure_pairs_.empty()) return;
  std::vector<StructurePair> structure_pairs = find_structure_pairs(materials);
  for (std::size_t i = 0; i < structure_pairs.size(); ++i)
    structure_pairs_[i] = structure_pairs[i];  // springs point there
  glues_ = std::any_of(structure_pairs_.begin(), structure_pairs_.end(),
                       [](const StructurePair& of) { return AnyLaw::cements(of.parameters); });
}

// Which pairs of cells are one patch, and where their forces act.

/// Pairs of cells hang together where they share a feature that acts.
void StructureContacts::find_patches() {
  for (PairOfCells& pair : pairs_) {
    pair.old_patch = pair.patch;
    pair.was_turned = pair.is_turned;
    pair.patch = -1;
  }
  connected_.reset(pairs_.size());
  constexpr std::int32_t kTouches = 0;
  for (const std::uint32_t acting : terms_.acting()) {
    const auto holders = terms_.holders(terms_[acting]);
    const structure::Holder& first = holders.front();
    for (const structure::Holder& holder : holders) {
      connected_.unite(first.pair, holder.pair, first.is_turned != holder.is_turned);
      pairs_[holder.pair].patch = kTouches;
    }
  }
  number_patches();
}

void StructureContacts::number_patches() {
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < pairs_.size(); ++i) {
    if (pairs_[i].patch < 0) continue;
    const auto place = connected_.find(i);
    // The root is the lowest of its patch: it comes first.
    pairs_[i].patch =
        place.root == i ? static_cast<std::int32_t>(count++) : pairs_[place.root].patch;
    pairs_[i].is_turned = place.is_turned;
  }
  patches_.resize(count);
}

void StructureContacts::find_places() {
  for (Patch& patch : patches_) {
    patch.first.clear();
    patch.second.clear();
  }
  places_.clear();
  for (const std::uint32_t acting : terms_.acting()) {
    const PairTerm& term = terms_[acting];
    const structure::Holder& holder = terms_.holders(term).front();
    const PairOfCells& pair = pairs_[holder.pair];
    const bool is_turned = holder.is_turned != pair.is_turned;
    places_.push_back({static_cast<std::uint32_t>(pair.patch), is_turned, {}, {}});
    Patch& patch = patches_[places_.back().patch];
    patch.structure_pair = term.spring;
    for (const NodeId node : term.a) (is_turned ? patch.second : patch.first).add(node);
    for (const NodeId node : term.b) (is_turned ? patch.first : patch.second).add(node);
  }
  for (Patch& patch : patches_) {
    patch.first.sort();
    patch.second.sort();
  }
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const PairTerm& term = terms_[terms_.acting()[i]];
    Places& places = places_[i];
    const Patch& patch = patches_[places.patch];
    const auto& side_a = places.is_turned ? patch.second : patch.first;
    const auto& side_b = places.is_turned ? patch.first : patch.second;
    for (std::size_t k = 0; k < term.a.count; ++k) places.a[k] = side_a.place_of(term.a.ids[k]);
    for (std::size_t k = 0; k < term.b.count; ++k) places.b[k] = side_b.place_of(term.b.ids[k]);
  }
}

// What patches of one step leave to those of the next.

void StructureContacts::find_successors() {
  successors_.clear();
  if (!terms_.acting_changed()) {
    for (std::uint32_t i = 0; i < patches_.size(); ++i) successors_.push_back({i, i, false});
    return;
  }
  for (const PairOfCells& pair : pairs_) {
    if (pair.old_patch < 0 || pair.patch < 0) continue;
    successors_.push_back({static_cast<std::uint32_t>(pair.old_patch),
                           static_cast<std::uint32_t>(pair.patch),
                           pair.was_turned != pair.is_turned});
  }
  std::sort(successors_.begin(), successors_.end());
  successors_.erase(std::unique(successors_.begin(), successors_.end(),
                                [](const Successor& p, const Successor& q) {
                                  return p.old_patch == q.old_patch && p.patch == q.patch;
                                }),
                    successors_.end());
}

/// Hands the histories of the last step's patches to this step's. A spring that comes to count for
/// more contacts keeps its force, one that counts for less keeps its stretch: neither gains energy.
/// What a patch stored that nothing follows is dissipated.
EnergyLoss StructureContacts::transfer(const Motion& motion, double dt) {
  EnergyLoss loss;
  for (const Predecessor& old : previous_) loss.dissipated += old.energy;
  for (const Successor& successor : successors_) {
    if (&successor == successors_.data() || (&successor - 1)->old_patch != successor.old_patch) {
      loss.dissipated -= previous_[successor.old_patch].energy;
      loss.tracking += previous_[successor.old_patch].energy;
    }
  }
  for (auto begin = successors_.begin(); begin != successors_.end();) {
    const auto end = std::find_if(begin, successors_.end(), [&](const Successor& successor) {
      return successor.old_patch != begin->old_patch;
    });
    const Predecessor& old = previous_[begin->old_patch];
    hand_on_number(old, {begin, end});
    double total = 0.0;
    for (auto successor = begin; successor != end; ++successor)
      total += patches_[successor->patch].normal_force;
    for (auto successor = begin; successor != end && total > 0.0; ++successor) {
      Patch& patch = patches_[successor->patch];
      if (!(patch.normal_force > 0.0) || !(patch.point_part > 0.0)) continue;
      const double sign = successor->is_turned ? -1.0 : 1.0;
      const Vec3 normal = sign / patch.normal_force * patch.elastic_force;
      const Vec3 spin =
          0.5 * (patch.first.angular_velocity(motion) + patch.second.angular_velocity(motion));
      const auto carried = carried_history<AnyLaw>(old.memory, normal, dt * spin.dot(normal));
      const double share = patch.normal_force / total * old.count / patch.point_count();
      AnyLaw::accumulate_history(patch.memory.history, carried, sign * std::min(1.0, share));
    }
    begin = end;
  }
  for (const Patch& patch : patches_) loss.tracking -= history_energy(patch);
  return loss;
}

/// To the successor that pushes most; of patches that merge, the number of the one that pushed
/// most goes on.
void StructureContacts::hand_on_number(const Predecessor& old,
                                       std::span<const Successor> successors) {
  const Successor& largest = *std::max_element(
      successors.begin(), successors.end(), [&](const Successor& p, const Successor& q) {
        return patches_[p.patch].normal_force < patches_[q.patch].normal_force;
      });
  Patch& patch = patches_[largest.patch];
  if (!(old.normal_force > patch.id_from)) return;
  patch.id = old.id;
  patch.id_from = old.normal_force;
}

// Friction of facets that lie on each other, and of bars (surface_surface/spread_contact.hpp).

/// How hard every pair of cells with a bar in it presses: its part of what all terms do that it
/// has, of each as much as every other pair has that has it. That is the rule of inclusion and
/// exclusion again: the joints of a chain take from the bars beside them what these have together.
void StructureContacts::share_pushes() {
  bar_push_.assign(pairs_.size(), 0.0);
  pressing_.assign(patches_.size(), {});
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const PairTerm& term = terms_[terms_.acting()[i]];
    const auto holders = terms_.holders(term);
    const double part = 1.0 / static_cast<double>(holders.size());
    std::size_t bars = 0;
    for (const structure::Holder& holder : holders) {
      const PairTerm& cells = terms_.of_cells(holder.pair);
      if (cells.a.count == 3 && cells.b.count == 3) continue;
      bar_push_[holder.pair] += part * term.push;
      ++bars;
    }
    const double of_bars = bars == holders.size() ? 1.0 : part * static_cast<double>(bars);
    Pressing& pressing = pressing_[places_[i].patch];
    pressing.all += term.push;
    const structure::NormalSpring& spring = springs_[term.spring];
    pressing.deepest = std::max(pressing.deepest, spring.force(spring.range() - term.overlap));
    pressing.bars += of_bars * term.push;
    pressing.energy += of_bars * term.forces.energy;
    pressing.wraps = pressing.wraps || terms_.wraps(terms_.acting()[i]);
  }
  for (std::size_t pair = 0; pair < pairs_.size(); ++pair) {
    if (bar_push_[pair] > 0.0)
      pressing_[static_cast<std::size_t>(pairs_[pair].patch)].positive += bar_push_[pair];
  }
}

/// Finds what presses by its extent or has a bar in it.
void StructureContacts::find_spreads(Positions x) {
  share_pushes();
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    const Pressing& of = pressing_[i];
    if (of.bars > 0.0 && of.energy > 0.0 && of.positive > 0.0)
      patches_[i].bar_part = std::clamp(of.bars / of.all, 0.0, 1.0);
    patches_[i].point_part -= patches_[i].bar_part;
  }
  previous_spreads_.swap(spreads_);
  spreads_.clear();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const std::uint32_t acting = terms_.acting()[i];
    const PairTerm& term = terms_[acting];
    if (!term.is_of_cells) continue;
    Spread spread;
    spread.pair = terms_.holders(term).front().pair;
    spread.patch = places_[i].patch;
    spread.is_turned = places_[i].is_turned;
    spread.structure_pair = term.spring;
    Patch& patch = patches_[spread.patch];
    if (const structure::PairForces* const extent = terms_.spread(acting)) {
      if (!spread.locate(term, *extent, structure_pairs_[term.spring], x)) continue;
      if (patch.pushes()) patch.point_part -= spread.normal_force / patch.normal_force;
    } else if (!locate_bar(term, spread, x)) {
      continue;
    }
    spreads_.push_back(spread);
  }
  for (Patch& patch : patches_) patch.point_part = std::clamp(patch.point_part, 0.0, 1.0);
}

/// What pairs push less than nothing is taken from the others of their patch. Pairs of a patch that
/// is one contact have its normal, so that their springs add up to one.
/// @returns whether it presses
bool StructureContacts::locate_bar(const PairTerm& term, Spread& spread, Positions x) const {
  const Pressing& of = pressing_[spread.patch];
  const Patch& patch = patches_[spread.patch];
  const double push = bar_push_[spread.pair];
  if (!(push > 0.0) || !(patch.bar_part > 0.0)) return false;
  spread.is_wrapped = of.wraps;
  const double own = of.spread();
  Vec3 towards = (spread.is_turned ? -1.0 : 1.0) * (1.0 - own) * patch.elastic_force;
  if (patch.pushes()) towards /= patch.normal_force;
  return spread.locate_bar(
      term, {push * std::min(1.0, of.bars / of.positive), 2.0 * of.energy / of.bars, towards, own},
      structure_pairs_[term.spring], x);
}

/// Hands the histories of the last step over: to the same pairs, and, of bars, what these count for
/// less to those beside them that come to count for more, so that a contact that moves over a joint
/// keeps its force. What nothing takes over is dissipated.
EnergyLoss StructureContacts::carry_spreads(const Motion& motion, double dt) {
  EnergyLoss loss;
  spread_at_.assign(pairs_.size(), -1);
  for (std::size_t i = 0; i < spreads_.size(); ++i)
    spread_at_[spreads_[i].pair] = static_cast<std::int32_t>(i);
  find_transfers();
  const auto follow = [&](std::uint32_t old, Spread& spread, double contacts) {
    Spread& from = previous_spreads_[old];
    spread.take_over(from, contacts, motion, dt);
    loss.tracking += from.energy;
    from.energy = 0.0;
  };
  for (Spread& spread : spreads_) {
    const std::int32_t before = pairs_[spread.pair].spread;
    if (before < 0) continue;
    const auto old = static_cast<std::uint32_t>(before);
    follow(old, spread, std::min(previous_spreads_[old].count, spread.count));
  }
  for (const Transfer& of : transfers_) follow(of.from, spreads_[of.to], of.contacts);
  for (const Spread& old : previous_spreads_) loss.dissipated += old.energy;
  for (Spread& spread : spreads_) {
    spread.memory.normal = spread.normal();
    spread.find_energy(structure_pairs_[spread.structure_pair], patches_[spread.patch].free_part);
    loss.tracking -= spread.energy;
  }
  for (std::size_t i = 0; i < pairs_.size(); ++i) pairs_[i].spread = spread_at_[i];
  return loss;
}

/// From pairs that count for less than in the last step to those that share a term with them and
/// count for more: what is given is no more than either has less or more.
void StructureContacts::find_transfers() {
  transfers_.clear();
  const auto before = [&](std::uint32_t pair) {
    const std::int32_t at = pairs_[pair].spread;
    const bool is_bar = at >= 0 && previous_spreads_[static_cast<std::size_t>(at)].is_of_bar;
    return is_bar ? previous_spreads_[static_cast<std::size_t>(at)].count : 0.0;
  };
  const auto now = [&](std::uint32_t pair) {
    const std::int32_t at = spread_at_[pair];
    const bool is_bar = at >= 0 && spreads_[static_cast<std::size_t>(at)].is_of_bar;
    return is_bar ? spreads_[static_cast<std::size_t>(at)].count : 0.0;
  };
  for (const std::uint32_t acting : terms_.acting()) {
    const auto holders = terms_.holders(terms_[acting]);
    if (holders.size() < 2) continue;
    for (const structure::Holder& from : holders) {
      const double less = before(from.pair) - now(from.pair);
      if (!(less > 0.0)) continue;
      for (const structure::Holder& to : holders) {
        const double more = now(to.pair) - before(to.pair);
        if (more > 0.0)
          transfers_.push_back({static_cast<std::uint32_t>(pairs_[from.pair].spread),
                                static_cast<std::uint32_t>(spread_at_[to.pair]), less, more});
      }
    }
  }
  find_transfers_of_gone(now, before);
  std::sort(transfers_.begin(), transfers_.end());
  transfers_.erase(std::unique(transfers_.begin(), transfers_.end()), transfers_.end());
  asked_.assign(spreads_.size(), 0.0);
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

/// From pairs that press no more, and so have no term with others either: to those beside them in
/// the patches that follow theirs.
template <class Now, class Before>
void StructureContacts::find_transfers_of_gone(Now now, Before before) {
  goes_on_.assign(previous_spreads_.size(), 0);
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    if (pairs_[i].spread >= 0 && spread_at_[i] >= 0)
      goes_on_[static_cast<std::size_t>(pairs_[i].spread)] = 1;
  by_patch_.clear();
  for (std::uint32_t from = 0; from < previous_spreads_.size(); ++from) {
    const Spread& old = previous_spreads_[from];
    if (goes_on_[from] != 0 || !old.is_of_bar) continue;
    if (by_patch_.empty()) {
      for (std::uint32_t i = 0; i < spreads_.size(); ++i)
        if (spreads_[i].is_of_bar) by_patch_.push_back({spreads_[i].patch, i});
      std::sort(by_patch_.begin(), by_patch_.end());
    }
    auto successor = std::lower_bound(
        successors_.begin(), successors_.end(), old.patch,
        [](const Successor& of, std::uint32_t patch) { return of.old_patch < patch; });
    for (; successor != successors_.end() && successor->old_patch == old.patch; ++successor) {
      auto at = std::lower_bound(by_patch_.begin(), by_patch_.end(),
                                 std::pair{successor->patch, std::uint32_t{0}});
      for (; at != by_patch_.end() && at->first == successor->patch; ++at) {
        const Spread& to = spreads_[at->second];
        const double more = now(to.pair) - before(to.pair);
        if (more > 0.0 && to.is_beside(old))
          transfers_.push_back({from, at->second, old.count, more});
      }
    }
  }
}

/// @returns the energy (J) dissipated
double StructureContacts::advance_spreads(const Motion& motion, double dt,
                                          geometry::ThreadPool& pool) {
  pool.for_each_range(spreads_.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      Spread& spread = spreads_[i];
      spread.apply_law(structure_pairs_[spread.structure_pair], patches_[spread.patch].free_part,
                       motion, dt);
    }
  });
  double dissipated = 0.0;
  for (const Spread& spread : spreads_) dissipated += spread.dissipated;
  return dissipated;
}

/// By patch, what its spread contacts do to its second side about the point of its row.
std::vector<StructureContacts::SpreadSum> StructureContacts::sum_spreads() const {
  std::vector<SpreadSum> sums(patches_.size());
  for (const Spread& spread : spreads_) {
    const StructurePair& structure_pair = structure_pairs_[spread.structure_pair];
    const Patch& patch = patches_[spread.patch];
    const double sign = spread.is_turned ? -1.0 : 1.0;
    const Vec3 force = sign * spread.other_force;
    const Vec3 about = patch.second.point() + patch.lever_of_second(structure_pair);
    const Vec3 point = spread.b.point + spread.lever_b(structure_pair);
    SpreadSum& sum = sums[spread.patch];
    sum.force += force;
    sum.moment += sign * spread.moment + (point - about).cross(force);
    const Vec3 along =
        spread.other_force - spread.other_force.dot(spread.memory.normal) * spread.memory.normal;
    sum.sticks =
        sum.sticks || !is_at_limit<AnyLaw>(spread.parameters(structure_pair, patch.free_part),
                                           spread.memory.history, spread.normal_force, along);
  }
  return sums;
}

// Bonds between structures (surface_surface/structure_bond.hpp): where they are formed and broken.
//
// The bonds of a patch together count for as many contacts as it did at most so far. Each pair of
// cells has one, with a share by how hard it presses, so sheets peel off little by little. They
// carry their part of the tangential force; the patch has the rest. Where a bond has broken the
// patch forms no others: what slides or comes back is held by friction alone until it has parted.

/// Finds where all bonds are, and forms new ones. @returns the energy (J) lost
double StructureContacts::prepare_bonds(const Motion& motion, geometry::ThreadPool& pool) {
  if (bonds_.empty() && !glues_) return 0.0;
  for (const Successor& successor : successors_)
    patches_[successor.patch].is_torn |= previous_[successor.old_patch].is_torn;
  for (Bond& bond : bonds_) bond.patch = patch_of(bond);
  pool.for_each_range(bonds_.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i)
      bonds_[i].locate(structure_pairs_[bonds_[i].structure_pair], motion.position);
  });
  const double lost = form_bonds(motion.position);
  for (Gluing& of : gluing_) of.pressing = 0.0;
  for (const Bond& bond : bonds_) {
    if (bond.patch >= 0) gluing_[static_cast<std::size_t>(bond.patch)].pressing += bond.pressing;
  }
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    const double share = gluing_[i].pressing / patches_[i].normal_force;
    if (gluing_[i].pressing > 0.0) patches_[i].free_part = std::max(0.0, 1.0 - share);
  }
  return lost;
}

/// That of its cells, or one that follows the patch of the last step; -1: there is none.
std::int32_t StructureContacts::patch_of(const Bond& bond) const {
  if (bond.pair >= 0) {
    const PairOfCells& pair = pairs_[static_cast<std::size_t>(bond.pair)];
    if (pair.patch >= 0) return pair.patch;
  }
  if (bond.patch < 0) return -1;
  const auto old = static_cast<std::uint32_t>(bond.patch);
  const auto successor = std::lower_bound(
      successors_.begin(), successors_.end(), old,
      [](const Successor& of, std::uint32_t patch) { return of.old_patch < patch; });
  const bool is_followed = successor != successors_.end() && successor->old_patch == old;
  return is_followed ? static_cast<std::int32_t>(successor->patch) : -1;
}

/// Glues what patches count for beyond their bonds. @returns the energy (J) lost
double StructureContacts::form_bonds(Positions x) {
  constexpr double kLeastGrowth = 1e-6;  // part of a patch that is worth the time
  gluing_.assign(patches_.size(), {});
  for (const Bond& bond : bonds_) {
    if (bond.patch >= 0) gluing_[static_cast<std::size_t>(bond.patch)].bonds += bond.count;
  }
  if (!glues_) return 0.0;
  list_pressed_pairs();
  for (Pressed& pressed : pressed_) {
    Gluing& gluing = gluing_[pressed.patch];
    const std::int32_t bond = pairs_[pressed.pair].bond;
    const double has = bond < 0 ? 0.0 : bonds_[static_cast<std::size_t>(bond)].count;
    pressed.wants = std::max(0.0, gluing.count_of(pressed.near, pressed.wide) - has);
    gluing.wants += pressed.wants;
  }
  double lost = 0.0;
  for (const Pressed& pressed : pressed_) {
    const Gluing& gluing = gluing_[pressed.patch];
    const double missing = gluing.near + gluing.wide - gluing.bonds;
    if (pressed.wants > 0.0 && missing > kLeastGrowth * (gluing.near + gluing.wide))
      lost += glue_pair(pressed, missing * pressed.wants / gluing.wants, x);
  }
  return lost;
}

/// Pairs of cells in patches that may have bonds, and how many contacts they count for: as many as
/// give their force along the patch's normal at its mean overlap.
void StructureContacts::list_pressed_pairs() {
  pressed_.clear();
  near_push_.assign(pairs_.size(), 0.0);
  for (const std::uint32_t acting : terms_.acting()) add_near_push(terms_[acting]);
  for (const std::uint32_t acting : terms_.acting()) {
    const PairTerm& term = terms_[acting];
    if (!term.is_of_cells || !AnyLaw::cements(structure_pairs_[term.spring].parameters)) continue;
    const structure::Holder& holder = terms_.holders(term).front();
    const auto patch = static_cast<std::uint32_t>(pairs_[holder.pair].patch);
    if (patches_[patch].is_torn || !patches_[patch].pushes()) continue;
    const double push = std::abs(structure::force_on_a(term).dot(patches_[patch].normal()));
    const double deepest =
        springs_[term.spring].force(springs_[term.spring].range() - term.overlap);
    const double one =
        AnyLaw::elastic_normal_force(structure_pairs_[term.spring].parameters,
                                     push > 0.0 ? -2.0 * term.forces.energy / push : 0.0);
    if (!(one > 0.0) || !(deepest > 0.0)) continue;
    const double near = near_push_[holder.pair] / deepest;
    const double wide = std::max(0.0, push - term.point_share * term.weight * deepest) / one;
    pressed_.push_back({holder.pair, patch, acting, holder.is_turned, near, wide, 0.0});
    gluing_[patch].near += near;
    gluing_[patch].positive += std::max(0.0, near);
    gluing_[patch].wide += wide;
  }
}

/// Gives what a term does at its nearest points to the pairs of cells that have these: what is
/// taken off for a side goes to the cell that is nearest there, and leaves nothing of it. Of a pass
/// between two cells each has an equal part.
void StructureContacts::add_near_push(const PairTerm& term) {
  const structure::NormalSpring& spring = springs_[term.spring];
  const double push = term.point_share * term.weight * spring.force(spring.range() - term.overlap);
  const auto holders = terms_.holders(term);
  const auto has_them = [&](const structure::Holder& holder) {
    return terms_.of_cells(holder.pair).overlap == term.overlap;
  };
  const auto having = std::count_if(holders.begin(), holders.end(), has_them);
  const double sharing = static_cast<double>(having > 0 ? having : std::ssize(holders));
  for (const structure::Holder& holder : holders) {
    if (having == 0 || has_them(holder)) near_push_[holder.pair] += push / sharing;
  }
}

/// @returns the energy (J) lost
double StructureContacts::glue_pair(const Pressed& pressed, double count, Positions x) {
  PairOfCells& pair = pairs_[pressed.pair];
  const PairTerm& term = terms_[pressed.term];
  const StructurePair& bodies = structure_pairs_[term.spring];
  const auto at = structure::pressed_points(*surface_, term, springs_[term.spring].range(), x);
  if (pair.bond >= 0) return bonds_[static_cast<std::size_t>(pair.bond)].grow(bodies, at, count, x);
  std::optional<Bond> bond = structure::new_bond(bodies, at, count, x);
  if (!bond) return 0.0;
  bond->cells = pair.cells;
  bond->is_turned = pressed.is_turned;
  bond->structure_pair = term.spring;
  bond->pair = static_cast<std::int32_t>(pressed.pair);
  bond->patch = static_cast<std::int32_t>(pressed.patch);
  pair.bond = static_cast<std::int32_t>(bonds_.size());
  bonds_.push_back(*bond);
  return 0.0;
}

/// One step of the law for all bonds, after that for the patches.
/// @returns the energy (J) dissipated
double StructureContacts::advance_bonds(const Motion& motion, double dt,
                                        geometry::ThreadPool& pool) {
  pool.for_each_range(bonds_.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i)
      bonds_[i].apply_law(structure_pairs_[bonds_[i].structure_pair], motion, dt);
  });
  double dissipated = 0.0;
  for (Bond& bond : bonds_) {
    dissipated += bond.dissipated;
    if (bond.is_broken) dissipated += hand_to_patch(bond);
  }
  return dissipated;
}

/// What a broken bond still holds goes to the facets or the patch of its cells, if they touch.
/// @returns the energy (J) lost
double StructureContacts::hand_to_patch(Bond& bond) {
  double lost = bond.history_energy(structure_pairs_[bond.structure_pair]);
  if (bond.patch >= 0) {
    Patch& patch = patches_[static_cast<std::size_t>(bond.patch)];
    patch.is_torn = true;
    const auto pair = static_cast<std::size_t>(bond.pair);
    if (bond.pair >= 0 && pairs_[pair].spread >= 0) {
      lost += hand_to_spread(bond, spreads_[static_cast<std::size_t>(pairs_[pair].spread)]);
    } else if (bond.pair >= 0 && pairs_[pair].patch >= 0 && patch.pushes()) {
      const double sign = bond.is_turned != pairs_[pair].is_turned ? -1.0 : 1.0;
      lost += history_energy(patch);
      AnyLaw::accumulate_history(
          patch.memory.history,
          carried_history<AnyLaw>(bond.memory, sign * patch.memory.normal, 0.0), sign);
      lost -= history_energy(patch);
    }
  }
  bond.memory.history = {};
  return lost;
}

/// The bond's points a and b are on the facets a and b. @returns the energy (J) lost
double StructureContacts::hand_to_spread(const Bond& bond, Spread& spread) {
  const double before = spread.energy;
  const auto carried = carried_history<AnyLaw>(bond.memory, spread.memory.normal, 0.0);
  AnyLaw::accumulate_history(spread.memory.history, carried,
                             std::min(1.0, bond.count / spread.count));
  const auto parameters =
      spread.parameters(structure_pairs_[spread.structure_pair], patches_[spread.patch].free_part);
  spread.energy = AnyLaw::history_energy(parameters, spread.memory.history);
  return before - spread.energy;
}

/// Takes out those that broke in the last step.
void StructureContacts::drop_broken_bonds() {
  if (std::erase_if(bonds_, [](const Bond& bond) { return bond.is_broken; }) > 0) match_bonds();
}

/// Which pair of cells in the list each bond belongs to.
void StructureContacts::match_bonds() {
  for (PairOfCells& pair : pairs_) pair.bond = -1;
  for (std::size_t i = 0; i < bonds_.size(); ++i) {
    Bond& bond = bonds_[i];
    const auto pair = std::lower_bound(
        pairs_.begin(), pairs_.end(), bond.cells,
        [](const PairOfCells& of, const geometry::CellPair& cells) { return of.cells < cells; });
    const bool is_listed = pair != pairs_.end() && pair->cells == bond.cells;
    bond.pair = is_listed ? static_cast<std::int32_t>(pair - pairs_.begin()) : -1;
    if (is_listed) pair->bond = static_cast<std::int32_t>(i);
  }
}

/// Bonds on cells that have broken away are gone. @returns the energy (J) lost with them
double StructureContacts::keep_bonds(const geometry::SurfaceChange& change) {
  double lost = 0.0;
  std::erase_if(bonds_, [&](Bond& bond) {
    const auto a = change.now(bond.cells.a);
    const auto b = change.now(bond.cells.b);
    const bool is_left = a && b;
    if (is_left) {
      bond.cells = {*a, *b};
      bond.a.feature = *change.now(bond.a.feature);
      bond.b.feature = *change.now(bond.b.feature);
    } else {
      lost += bond.history_energy(structure_pairs_[bond.structure_pair]);
    }
    return !is_left;
  });
  match_bonds();
  return lost;
}

// What becomes of the contacts of structures that lose some of their elements.

double StructureContacts::follow(const geometry::SurfaceChange& change,
                                 std::span<const geometry::CellPair> pairs,
                                 const ContactMaterials& materials, const Motion& at,
                                 geometry::ThreadPool& pool) {
  double lost = 0.0;
  const bool had_pairs = !pairs_.empty();
  if (had_pairs) {
    std::vector<geometry::CellPair> listed;
    for (const PairOfCells& pair : pairs_) listed.push_back(pair.cells);
    lost += normal_energy(change.before(), listed, at, pool);
    renumber(change);
  }
  if (!bonds_.empty()) lost += keep_bonds(change);
  surface_ = &change.after();
  terms_ = structure::PairTerms(*surface_);
  // Where pairs were listed patches may be left of them, which the terms of now know nothing of.
  if (!had_pairs && pairs.empty()) return lost;
  lost += rebuild(pairs, materials);
  return lost - normal_energy(*surface_, pairs, at, pool);
}

/// J, of the elastic normal forces and of the attraction where the nodes are at a moment.
double StructureContacts::normal_energy(const geometry::Surface& surface,
                                        std::span<const geometry::CellPair> pairs, const Motion& at,
                                        geometry::ThreadPool& pool) const {
  structure::PairTerms terms(surface);
  terms.rebuild(pairs);
  terms.evaluate(springs_, at, pool);
  double energy = 0.0;
  for (const std::uint32_t acting : terms.acting()) {
    energy += terms[acting].forces.energy;
    if (const structure::PairForces* of = terms.attraction(acting)) energy += of->energy;
  }
  return energy;
}

/// Pairs of cells keep their patches. Those of a torn facet go to its sides that hold the nearest
/// points: there the contact goes on.
void StructureContacts::renumber(const geometry::SurfaceChange& change) {
  std::vector<PairOfCells> left;
  for (std::uint32_t i = 0; i < pairs_.size(); ++i) {
    const PairOfCells& pair = pairs_[i];
    const auto a = change.now(pair.cells.a);
    const auto b = change.now(pair.cells.b);
    if (a && b) {
      left.push_back({{*a, *b}, pair.patch, pair.is_turned});
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
}

/// @param witness features  corners of the features of both cells that hold the nearest points
void StructureContacts::hand_to_sides(const PairOfCells& pair,
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
                      pair.is_turned != swaps});
    }
  }
}

// What all contacts of structures come to.

void StructureContacts::add_up_patches(Positions x) {
  largest_overlap_ratio_ = 0.0;
  crossings_ = 0;
  for (Patch& patch : patches_) patch.reset();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const PairTerm& term = terms_[terms_.acting()[i]];
    const Places& places = places_[i];
    const StructurePair& structure_pair = structure_pairs_[term.spring];
    const double radius = std::min(structure_pair.radius_first, structure_pair.radius_second);
    largest_overlap_ratio_ = std::max(largest_overlap_ratio_, term.overlap / radius);
    crossings_ += term.is_of_cells && term.meets ? 1 : 0;
    Patch& patch = patches_[places.patch];
    if (term.overlap > patch.deepest_overlap) {
      patch.deepest_overlap = term.overlap;
      patch.deepest = {places.is_turned ? term.b : term.a, places.is_turned ? term.a : term.b};
    }
    patch.energy += term.forces.energy;
    auto& side_a = places.is_turned ? patch.second : patch.first;
    auto& side_b = places.is_turned ? patch.first : patch.second;
    for (std::size_t k = 0; k < term.a.count; ++k)
      side_a.add_force(places.a[k], term.forces.on_a[k]);
    for (std::size_t k = 0; k < term.b.count; ++k)
      side_b.add_force(places.b[k], term.forces.on_b[k]);
    if (const structure::PairForces* const ends = terms_.at_ends(terms_.acting()[i])) {
      for (std::size_t k = 0; k < term.a.count; ++k) side_a.add_force(places.a[k], ends->on_a[k]);
      for (std::size_t k = 0; k < term.b.count; ++k) side_b.add_force(places.b[k], ends->on_b[k]);
    }
    const auto attract = [&](const structure::PairForces* by) {
      if (by == nullptr) return;
      patch.attraction_energy += by->energy;
      for (std::size_t k = 0; k < term.a.count; ++k)
        side_a.add_attraction(places.a[k], by->on_a[k]);
      for (std::size_t k = 0; k < term.b.count; ++k)
        side_b.add_attraction(places.b[k], by->on_b[k]);
    };
    attract(terms_.attraction(terms_.acting()[i]));
    attract(terms_.attraction_at_ends(terms_.acting()[i]));
  }
  for (Patch& patch : patches_) patch.find_totals(structure_pair_of(patch), x);
}

void StructureContacts::add_forces(NodeForces& forces) const {
  for (const Patch& patch : patches_) patch.add_forces(structure_pair_of(patch), forces);
  for (const Spread& spread : spreads_)
    spread.add_forces(structure_pairs_[spread.structure_pair], forces);
  for (const Bond& bond : bonds_) bond.add_forces(structure_pairs_[bond.structure_pair], forces);
}

double StructureContacts::elastic_energy() const {
  double energy = 0.0;
  for (const Patch& patch : patches_)
    energy += patch.energy + patch.attraction_energy + history_energy(patch);
  for (const Spread& spread : spreads_) energy += spread.energy;
  for (const Bond& bond : bonds_)
    energy += bond.history_energy(structure_pairs_[bond.structure_pair]);
  return energy;
}

void StructureContacts::for_each_stiffness(
    geometry::FunctionRef<void(NodeId, double, double, double)> visit) const {
  for (const Patch& patch : patches_) {
    if (!(patch.normal_force > 0.0)) continue;
    const StructurePair& structure_pair = structure_pair_of(patch);
    const auto parameters = patch.whole_parameters(structure_pair);
    const auto on = [&](double radius) {
      return [&, radius](NodeId node, double share) {
        const double part = (1.0 - patch.bar_part) * std::abs(share);
        visit(node, part * AnyLaw::normal_stiffness(parameters, patch.gap),
              part * AnyLaw::tangential_stiffness(parameters, patch.gap), radius);
      };
    };
    if (patch.bar_part == 1.0) continue;
    patch.first.for_each_share(on(structure_pair.radius_first));
    patch.second.for_each_share(on(structure_pair.radius_second));
  }
  for (const Spread& spread : spreads_) {
    if (!spread.is_of_bar) continue;  // the patch tells that of facets
    const StructurePair& structure_pair = structure_pairs_[spread.structure_pair];
    // Joints in a wrap move one by one, against the whole spring of a bar.
    const double contacts = spread.is_wrapped ? std::max(1.0, spread.count) : spread.count;
    const auto parameters = AnyLaw::scaled(structure_pair.parameters, contacts);
    const auto on = [&](const typename Spread::Side& side, double radius) {
      for (std::size_t i = 0; i < 3; ++i)
        visit(side.nodes[i], side.shares[i] * AnyLaw::normal_stiffness(parameters, spread.gap),
              side.shares[i] * AnyLaw::tangential_stiffness(parameters, spread.gap), radius);
    };
    on(spread.a, structure_pair.radius_first);
    on(spread.b, structure_pair.radius_second);
  }
  for (const Bond& bond : bonds_) {
    if (bond.gap < 0.0 || bond.is_broken) continue;  // the patch tells that of what touches
    const StructurePair& structure_pair = structure_pairs_[bond.structure_pair];
    const auto parameters = bond.parameters(structure_pair);
    const auto on = [&](const geometry::CorePoint& core, double radius) {
      for (std::size_t i = 0; i < 3; ++i) {
        const double share = core.weights[static_cast<int>(i)];
        visit(core.nodes[i], share * AnyLaw::normal_stiffness(parameters, 0.0),
              share * AnyLaw::tangential_stiffness(parameters, 0.0), radius);
      }
    };
    on(bond.a, structure_pair.radius_first);
    on(bond.b, structure_pair.radius_second);
  }
}

// Contacts of structures as they are reported.

void StructureContacts::for_each_record(Positions x, VisitRecord visit) const {
  const std::vector<SpreadSum> spreads = sum_spreads();
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    if (patches_[i].pushes()) visit(row_of(patches_[i], spreads[i], x));
  }
  for (const Bond& bond : bonds_) {
    ContactRecord row = row_of(bond);
    row.point_a = position(bond.a, x);
    row.point_b = position(bond.b, x);
    row.point = row.point_b + bond.lever_b(structure_pairs_[bond.structure_pair]);
    visit(row);
  }
}

void StructureContacts::for_each_record_on(NodeId node, Positions x, VisitRecordOn visit) const {
  NodeForces forces(x.size());
  Vec3& force = forces.force[index_of(node)];
  Vec3& torque = forces.torque[index_of(node)];
  auto patch = patches_.begin();
  auto bond = bonds_.begin();
  for_each_record(x, [&](const ContactRecord& row) {
    force = torque = Vec3::Zero();
    while (patch != patches_.end() && !patch->pushes()) ++patch;
    if (patch != patches_.end()) {
      patch->add_forces(structure_pair_of(*patch), forces);
      const auto place = static_cast<std::uint32_t>(patch - patches_.begin());
      for (const Spread& spread : spreads_) {
        if (spread.patch == place)
          spread.add_forces(structure_pairs_[spread.structure_pair], forces);
      }
      ++patch;
    } else {
      bond->add_forces(structure_pairs_[bond->structure_pair], forces);
      ++bond;
    }
    visit(row, force, torque);
  });
}

/// All but its points.
ContactRecord StructureContacts::row_of(const Bond& bond) const {
  const auto body = [&](const geometry::CorePoint& core) {
    return ContactBody{BodyKind::structure,
                       static_cast<std::int32_t>(surface_->structure_of(core.nodes[0])),
                       core.feature};
  };
  ContactRecord row;
  row.id = bond.id;
  row.a = body(bond.a);
  row.b = body(bond.b);
  row.normal = bond.normal;
  row.gap = bond.gap;
  set_force(row, bond.other_force);
  row.moment = bond.moment;
  set_state<AnyLaw>(row, bond.parameters(structure_pairs_[bond.structure_pair]),
                    bond.memory.history, bond.pressing);
  return row;
}

ContactRecord StructureContacts::row_of(const Patch& patch, const SpreadSum& spread,
                                        Positions x) const {
  const StructurePair& structure_pair = structure_pair_of(patch);
  const auto body = [&](const geometry::FeatureNodes& nodes) {
    return ContactBody{BodyKind::structure,
                       static_cast<std::int32_t>(surface_->structure_of(nodes.ids[0])),
                       geometry::feature_of(*surface_, nodes)};
  };
  ContactRecord row;
  row.id = patch.id;
  row.a = body(patch.deepest[0]);
  row.b = body(patch.deepest[1]);
  row.point_a = patch.first.point();
  row.point_b = patch.second.point();
  row.point = row.point_b + patch.lever_of_second(structure_pair);
  row.normal = patch.memory.normal;
  row.gap = patch.gap;
  const double point_force = patch.point_part * patch.normal_force;
  set_force(row, patch.other_force);
  set_state<AnyLaw>(row, patch.parameters(structure_pair), patch.memory.history, point_force);
  row.is_slipping = row.is_slipping && !spread.sticks;
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
  archive("largest_overlap_ratio", largest_overlap_ratio_);
  archive("crossings", crossings_);
  std::vector<PairOfCells> touching;
  if (archive.is_reading()) {
    pairs_.clear();
    patches_.clear();
    spreads_.clear();
    bonds_.clear();
    list();
  } else {
    touching = touching_pairs();
  }
  terms_.exchange(archive.group("terms"));
  const auto fields = [&](geometry::RowFields& row, auto& thing) {
    thing.exchange(row, structure_pairs_);
  };
  archive.rows("patches", patches_, fields);
  archive.rows("spread", spreads_, fields);
  archive.rows("bonds", bonds_, fields);
  archive.rows("pairs", touching,
               [&](geometry::RowFields& row, PairOfCells& pair) { exchange_pair(row, pair); });
  if (!archive.is_reading()) return;
  std::size_t place = 0;
  for (const PairOfCells& kept : touching) {
    place = next_place(place, pairs_.size(),
                       [&](std::size_t i) { return pairs_[i].cells < kept.cells; });
    if (place == pairs_.size() || pairs_[place].cells != kept.cells) throw_unlisted_contact();
    pairs_[place] = kept;
  }
  place_spreads();
  match_bonds();
}

/// Those that are in a patch or have friction of their own.
std::vector<StructureContacts::PairOfCells> StructureContacts::touching_pairs() const {
  std::vector<PairOfCells> touching;
  for (const PairOfCells& pair : pairs_)
    if (pair.patch >= 0 || pair.spread >= 0) touching.push_back(pair);
  return touching;
}

void StructureContacts::exchange_pair(geometry::RowFields& row, PairOfCells& pair) const {
  row("cell_a", pair.cells.a);
  row("cell_b", pair.cells.b);
  row("patch", pair.patch);
  row("is_turned", pair.is_turned);
  row("spread", pair.spread);
  if (pair.patch >= std::ssize(patches_) || pair.spread >= std::ssize(spreads_))
    throw_unlisted_contact();
}

}  // namespace plekton::contact
