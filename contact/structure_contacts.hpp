// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/bodies.hpp"
#include "contact/contact_row.hpp"
#include "contact/material_pairs.hpp"
#include "contact/structure/clearances.hpp"
#include "contact/structure/pair_term.hpp"
#include "contact/structure/structure_patch.hpp"
#include "contact/structure/touching_patches.hpp"
#include "geometry/cell_neighbours.hpp"
#include "geometry/parallel_sum.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <vector>

namespace plekton::contact {

/// Contacts of structures with each other, and of a structure with itself where it folds.
///
/// The elastic force is the gradient of one energy, a sum over pairs of features
/// (structure/nearest.hpp, structure/extended.hpp) with the weights of product_features.hpp: one
/// contact for every part of the contact region, and one more for every diameter of length or
/// square diameter of area on which bodies run side by side. Everything else - friction - is
/// decided once per patch, a part of the region that hangs together: its spring is as stiff as the
/// contacts it counts, it acts where the elastic force acts, and it follows the patch over the
/// mesh.
template <ContactLaw Law>
class StructureContacts {
 public:
  explicit StructureContacts(const geometry::Surface& surface) : surface_(&surface) {}

  /// Takes a new list of cells that may touch, sorted; pairs in both lists keep their patches.
  /// @param materials_of_structures  by StructureId
  /// @returns the energy (J) lost with patches that left the list
  double rebuild(std::span<const geometry::CellPair> pairs,
                 std::span<const MaterialId> materials_of_structures,
                 const MaterialPairs<Law>& materials);

  /// One step of all contacts: forces are found, not yet added.
  /// @returns the energy (J) dissipated
  double advance(const Motion& motion, double dt, geometry::ThreadPool& pool);

  void add_forces(NodeForces& forces) const;

  /// Largest overlap of the last step over the smaller radius.
  double largest_overlap_ratio() const noexcept { return largest_overlap_ratio_; }

  /// Pairs of facets and cylinders whose cores met in the last step: overlaps beyond both radii.
  std::size_t crossings() const noexcept {
    return static_cast<std::size_t>(std::count_if(
        acting_.begin(), acting_.end(),
        [this](std::uint32_t i) { return terms_[i].is_of_cells && terms_[i].meets; }));
  }

  /// Number of patches in contact.
  std::size_t touching() const noexcept { return patches_.size(); }

  /// Energy (J) stored in all contacts, at the positions of the last step.
  double elastic_energy() const;

  /// Calls visit(node, stiffness (N/m), radius (m), tangential over normal stiffness) for what
  /// every pair in contact adds to the stiffness around its nodes.
  template <class Visit>
  void for_each_stiffness(Visit&& visit) const;

  template <class Visit>
  void for_each_row(Visit&& visit) const;

 private:
  using PairTerm = structure::PairTerm;
  using Meeting = structure::Meeting<Law>;
  using Patch = structure::StructurePatch<Law>;

  struct PairOfCells {
    geometry::CellPair cells;
    std::int32_t patch = -1;  ///< -1: does not touch
    bool is_turned = false;   ///< its first cell is on the second side of its patch
    std::int32_t old_patch = -1;
    bool was_turned = false;
  };
  struct Holder {
    std::uint32_t pair;
    bool is_turned;  ///< feature a belongs to its second cell
  };
  /// A patch of the last step that lives on in one of this.
  struct Heir {
    std::uint32_t old_patch;
    std::uint32_t patch;
    bool is_turned;
    friend constexpr auto operator<=>(const Heir&, const Heir&) = default;
  };

  void make_terms(std::span<const MaterialId> materials_of_structures,
                  const MaterialPairs<Law>& materials);
  void evaluate_terms(const Motion& motion, geometry::ThreadPool& pool);
  void find_patches();
  void add_up_patches(Positions x);
  double inherit(const Motion& motion, double dt);
  const Meeting& meeting_of(const Patch& patch) const { return meetings_[patch.meeting]; }
  double history_energy(const Patch& patch) const {
    return patch.history_energy(meeting_of(patch));
  }
  /// Whether feature a of a term is on the second side of its patch.
  bool is_turned(const PairTerm& term) const {
    const Holder& holder = holders_[term.first_holder];
    return holder.is_turned != pairs_[holder.pair].is_turned;
  }
  Patch& patch_of(const PairTerm& term) {
    return patches_[static_cast<std::size_t>(pairs_[holders_[term.first_holder].pair].patch)];
  }

  const geometry::Surface* surface_;
  std::vector<PairOfCells> pairs_;
  std::vector<Meeting> meetings_;
  std::vector<PairTerm> terms_;
  bool terms_are_new_ = false;
  structure::Clearances clearances_;    ///< of the terms
  std::vector<std::uint32_t> due_;      ///< terms that may be in range, ascending
  std::vector<double> due_clearances_;  ///< m, of these
  std::vector<std::uint32_t> acting_;   ///< terms in range, ascending
  std::vector<Holder> holders_;
  structure::TouchingPatches connected_;
  std::vector<Patch> patches_;
  std::vector<Patch> previous_;
  std::vector<Heir> heirs_;
  std::vector<std::uint32_t> places_;  ///< by NodeId, see PatchSide::finish
  double largest_overlap_ratio_ = 0.0;
};

template <ContactLaw Law>
double StructureContacts<Law>::rebuild(std::span<const geometry::CellPair> pairs,
                                       std::span<const MaterialId> materials_of_structures,
                                       const MaterialPairs<Law>& materials) {
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
  make_terms(materials_of_structures, materials);
  double lost = 0.0;
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    if (!lives[i]) lost += history_energy(patches_[i]);
  }
  return lost;
}

template <ContactLaw Law>
void StructureContacts<Law>::make_terms(std::span<const MaterialId> materials_of_structures,
                                        const MaterialPairs<Law>& materials) {
  std::vector<geometry::CellPair> cells;
  for (const PairOfCells& pair : pairs_) cells.push_back(pair.cells);
  const geometry::ProductFeatures features = geometry::product_features(*surface_, cells);
  if (meetings_.empty()) {
    // Every pair of structures that may ever meet, so that patches keep their meeting.
    for (std::size_t i = 0; i < surface_->structure_count(); ++i) {
      for (std::size_t k = i; k < surface_->structure_count(); ++k) {
        const double radius_i = surface_->radius(geometry::id_at<geometry::StructureId>(i));
        const double radius_k = surface_->radius(geometry::id_at<geometry::StructureId>(k));
        meetings_.push_back({materials.combine(materials_of_structures[i], radius_i,
                                               materials_of_structures[k], radius_k),
                             radius_i, radius_k});
      }
    }
  }
  terms_.clear();
  terms_are_new_ = true;
  acting_.clear();
  holders_.clear();
  for (const std::uint32_t pair : features.holders) holders_.push_back({pair, false});
  for (const geometry::FeaturePair& pair : features.pairs) {
    PairTerm term = structure::pair_term(*surface_, pair);
    const auto first = index_of(surface_->structure_of(term.a.ids[0]));
    const auto second = index_of(surface_->structure_of(term.b.ids[0]));
    const std::size_t count = surface_->structure_count();
    // Row first of the upper triangle of pairs of structures.
    term.spring = static_cast<std::uint32_t>(first * count - first * (first + 1) / 2 + second);
    terms_.push_back(term);
    for (std::uint32_t h = 0; h < term.holder_count; ++h) {
      Holder& holder = holders_[term.first_holder + h];
      const auto nodes = surface_->nodes_of(pairs_[holder.pair].cells.a);
      holder.is_turned = std::find(nodes.begin(), nodes.end(), term.a.ids[0]) == nodes.end();
    }
  }
}

template <ContactLaw Law>
double StructureContacts<Law>::advance(const Motion& motion, double dt,
                                       geometry::ThreadPool& pool) {
  if (terms_.empty() && patches_.empty()) return 0.0;
  evaluate_terms(motion, pool);
  find_patches();
  add_up_patches(motion.position);
  double dissipated = inherit(motion, dt);
  for (Patch& patch : patches_) dissipated += patch.apply_law(meeting_of(patch), motion, dt);
  return dissipated;
}

/// Terms cost very different times, and the costly ones come first: threads take turns.
template <ContactLaw Law>
void StructureContacts<Law>::evaluate_terms(const Motion& motion, geometry::ThreadPool& pool) {
  if (terms_are_new_) {
    clearances_.reset(terms_.size(), motion.position);
  } else {
    clearances_.move(motion.way, motion.position);
  }
  terms_are_new_ = false;
  due_.clear();
  clearances_.for_each_due([&](std::size_t i) { due_.push_back(static_cast<std::uint32_t>(i)); });
  due_clearances_.resize(due_.size());
  const auto stride = static_cast<std::size_t>(pool.thread_count());
  pool.for_each_range(stride, [&](std::size_t begin, std::size_t, int) {
    for (std::size_t i = begin; i < due_.size(); i += stride) {
      PairTerm& term = terms_[due_[i]];
      const Meeting& meeting = meetings_[term.spring];
      const auto spring = structure::NormalSpring::of<Law>(
          meeting.parameters, meeting.radius_first + meeting.radius_second);
      due_clearances_[i] = structure::evaluate(term, spring, motion.position);
    }
  });
  acting_.clear();
  for (std::size_t i = 0; i < due_.size(); ++i) {
    clearances_.set(due_[i], due_clearances_[i]);
    if (terms_[due_[i]].in_range) acting_.push_back(due_[i]);
  }
}

template <ContactLaw Law>
void StructureContacts<Law>::find_patches() {
  for (PairOfCells& pair : pairs_) {
    pair.old_patch = pair.patch;
    pair.was_turned = pair.is_turned;
    pair.patch = -1;
  }
  connected_.reset(pairs_.size());
  constexpr std::int32_t kTouches = 0;
  for (const std::uint32_t acting : acting_) {
    const PairTerm& term = terms_[acting];
    const Holder& first = holders_[term.first_holder];
    for (std::uint32_t h = 0; h < term.holder_count; ++h) {
      const Holder& holder = holders_[term.first_holder + h];
      connected_.unite(first.pair, holder.pair, first.is_turned != holder.is_turned);
      pairs_[holder.pair].patch = kTouches;
    }
  }
  patches_.swap(previous_);
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
  for (Patch& patch : patches_) patch.clear();
}

template <ContactLaw Law>
void StructureContacts<Law>::add_up_patches(Positions x) {
  largest_overlap_ratio_ = 0.0;
  for (const std::uint32_t acting : acting_) {
    const PairTerm& term = terms_[acting];
    const Meeting& meeting = meetings_[term.spring];
    const double radius = std::min(meeting.radius_first, meeting.radius_second);
    largest_overlap_ratio_ = std::max(largest_overlap_ratio_, term.overlap / radius);
    Patch& patch = patch_of(term);
    patch.meeting = term.spring;
    patch.energy += term.forces.energy;
    const auto& on_second = is_turned(term) ? term.forces.on_a : term.forces.on_b;
    for (const Vec3& force : on_second) patch.elastic_force += force;
  }
  for (Patch& patch : patches_) patch.find_mean(meeting_of(patch));
  for (const std::uint32_t acting : acting_) {
    const PairTerm& term = terms_[acting];
    Patch& patch = patch_of(term);
    if (!(patch.normal_force > 0.0)) continue;
    const Vec3 per_force = patch.elastic_force / (patch.normal_force * patch.normal_force);
    auto& side_a = is_turned(term) ? patch.second : patch.first;
    auto& side_b = is_turned(term) ? patch.first : patch.second;
    const double sign = is_turned(term) ? -1.0 : 1.0;
    for (std::size_t i = 0; i < term.a.count; ++i) {
      side_a.add(term.a.ids[i], -sign * per_force.dot(term.forces.on_a[i]));
    }
    for (std::size_t i = 0; i < term.b.count; ++i) {
      side_b.add(term.b.ids[i], sign * per_force.dot(term.forces.on_b[i]));
    }
  }
  places_.resize(x.size(), structure::PatchSide::kNowhere);
  for (Patch& patch : patches_) {
    if (!(patch.normal_force > 0.0)) continue;
    patch.first.finish(x, places_);
    patch.second.finish(x, places_);
  }
}

/// Hands the histories of the last step's patches to this step's. A spring that comes to count for
/// more contacts keeps its force, one that counts for less keeps its stretch: neither gains energy.
/// @returns the energy (J) that is lost on the way
template <ContactLaw Law>
double StructureContacts<Law>::inherit(const Motion& motion, double dt) {
  heirs_.clear();
  for (const PairOfCells& pair : pairs_) {
    if (pair.old_patch < 0 || pair.patch < 0) continue;
    heirs_.push_back({static_cast<std::uint32_t>(pair.old_patch),
                      static_cast<std::uint32_t>(pair.patch), pair.was_turned != pair.is_turned});
  }
  std::sort(heirs_.begin(), heirs_.end());
  heirs_.erase(std::unique(heirs_.begin(), heirs_.end(),
                           [](const Heir& p, const Heir& q) {
                             return p.old_patch == q.old_patch && p.patch == q.patch;
                           }),
               heirs_.end());
  double lost = 0.0;
  for (const Heir& heir : heirs_) {
    if (&heir == heirs_.data() || (&heir - 1)->old_patch != heir.old_patch) {
      lost += history_energy(previous_[heir.old_patch]);
    }
  }
  for (auto begin = heirs_.begin(); begin != heirs_.end();) {
    const auto end = std::find_if(
        begin, heirs_.end(), [&](const Heir& heir) { return heir.old_patch != begin->old_patch; });
    const Patch& old = previous_[begin->old_patch];
    double total = 0.0;
    for (auto heir = begin; heir != end; ++heir) total += patches_[heir->patch].normal_force;
    for (auto heir = begin; heir != end && total > 0.0; ++heir) {
      Patch& patch = patches_[heir->patch];
      if (!(patch.normal_force > 0.0)) continue;
      const double sign = heir->is_turned ? -1.0 : 1.0;
      const Vec3 normal = sign / patch.normal_force * patch.elastic_force;
      const Vec3 spin =
          0.5 * (patch.first.angular_velocity(motion) + patch.second.angular_velocity(motion));
      const auto carried = carried_history<Law>(old.memory, normal, dt * spin.dot(normal));
      const double share = patch.normal_force / total * old.count / patch.count;
      Law::add_share(patch.memory.history, carried, sign * std::min(1.0, share));
    }
    begin = end;
  }
  for (const Patch& patch : patches_) lost -= history_energy(patch);
  return lost;
}

template <ContactLaw Law>
void StructureContacts<Law>::add_forces(NodeForces& forces) const {
  for (const std::uint32_t acting : acting_) {
    const PairTerm& term = terms_[acting];
    for (std::size_t i = 0; i < term.a.count; ++i) {
      forces.force[index_of(term.a.ids[i])] += term.forces.on_a[i];
    }
    for (std::size_t i = 0; i < term.b.count; ++i) {
      forces.force[index_of(term.b.ids[i])] += term.forces.on_b[i];
    }
  }
  for (const Patch& patch : patches_) patch.add_other_force(meeting_of(patch), forces);
}

template <ContactLaw Law>
double StructureContacts<Law>::elastic_energy() const {
  double energy = 0.0;
  for (const Patch& patch : patches_) energy += patch.energy + history_energy(patch);
  return energy;
}

template <ContactLaw Law>
template <class Visit>
void StructureContacts<Law>::for_each_stiffness(Visit&& visit) const {
  for (const Patch& patch : patches_) {
    if (!(patch.normal_force > 0.0)) continue;
    const Meeting& meeting = meeting_of(patch);
    const auto parameters = patch.parameters(meeting);
    const auto on = [&](double radius) {
      return [&visit, &parameters, radius](NodeId node, double share) {
        visit(node, std::abs(share) * Law::normal_stiffness(parameters, 0.0),
              std::abs(share) * Law::tangential_stiffness(parameters, 0.0), radius);
      };
    };
    patch.first.for_each_share(on(meeting.radius_first));
    patch.second.for_each_share(on(meeting.radius_second));
  }
}

template <ContactLaw Law>
template <class Visit>
void StructureContacts<Law>::for_each_row(Visit&& visit) const {
  for (const Patch& patch : patches_) {
    if (!(patch.normal_force > 0.0)) continue;
    visit(contact_row(patch.first.point(), patch.second.point(), patch.memory.normal, patch.gap,
                      patch.elastic_force + patch.other_force));
  }
}

}  // namespace plekton::contact
