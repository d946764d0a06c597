// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/rotation.hpp"
#include "contact/sphere_surface/patch.hpp"
#include "contact/sphere_surface/patch_contacts.hpp"
#include "contact/sphere_surface/patch_force.hpp"
#include "contact/sphere_surface/patch_successors.hpp"
#include "contact/sphere_surface/sphere_surface_pair.hpp"
#include "contact/tracking/energy_loss.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::contact {

/// The patches of a pair in this step.
struct PatchesOfPair {
  const SphereSurfacePair& pair;
  std::span<const Patch> patches;
  PatchFinder& finder;  ///< that found them
};

/// What a contact has from those of the last step.
struct Transferred {
  AnyLaw::History history{};
  std::int64_t id = 0;
  double from = -1.0;  ///< N, elastic force of the contact that the id is from
};

/// Hands the histories of the last step's contacts to this step's patches, pair by pair. A contact
/// that splits shares its history in proportion to the elastic forces; under tension the nearest
/// part has all of it. Its number goes to the patch with the largest force; of contacts that merge
/// the one with the largest hands its number on. What a contact stored that nothing follows is
/// dissipated. One per thread.
class HistoryTransfer {
 public:
  explicit HistoryTransfer(const geometry::Surface& surface)
      : surface_(&surface), successors_(surface) {}

  void begin_step() noexcept { pass_throughs_ = 0; }

  /// Where a sphere's centre lies on the surface itself, the contact of the last step says on which
  /// side it is.
  /// @param now  whose terms are given their normals
  void keep_sides(const PatchesOfPair& now, const ContactsOfPair& last, Positions x);

  /// To any number of patches: of_patch() has what each of them is given.
  /// @param states  by patch
  /// @param dt      s
  EnergyLoss to_patches(const PatchesOfPair& now, const ContactsOfPair& last,
                        std::span<const PatchState> states, const Motion& motion, double dt);
  /// By place of the patch; valid until the next pair.
  const Transferred& of_patch(std::size_t patch) const noexcept { return transferred_[patch]; }

  /// The same for one patch of one term that follows at most one contact, to the last bit.
  /// @param dt  s
  /// @param to  what the patch is given; new
  EnergyLoss to_single_feature(const PatchesOfPair& now, const ContactsOfPair& last,
                               const PatchState& state, const Motion& motion, double dt,
                               Transferred& to);

  /// How many contacts have gone on with the opposite normal in this step while the centre of the
  /// sphere was by the core, no further than half a radius and the way of this step: a sphere passes
  /// through. (A small part of the contact with what wraps a sphere may turn over too, where its
  /// pieces merge.)
  std::int64_t pass_throughs() const noexcept { return pass_throughs_; }

 private:
  static bool has_passed(const SphereSurfacePair& pair, const Vec3& last_normal,
                         const PatchState& state, double dt) noexcept {
    return is_turned_over(last_normal, state.normal) &&
           state.gap + pair.range < 0.5 * pair.radius + dt * state.relative_velocity.norm();
  }
  std::span<const std::uint32_t> successors_of(std::span<const Feature> minima,
                                               const PatchesOfPair& now, Positions x) {
    return successors_.find(minima, x[index_of(now.pair.node)], x, now.patches, now.finder);
  }
  /// J, of a contact that nothing follows.
  double loss_of(const SphereSurfacePair& pair, const PatchContact& old,
                 std::span<const Feature> minima, const Motion& motion, double dt) const;
  void hand_on_number(const PatchContact& old, std::span<const std::uint32_t> successors,
                      std::span<const PatchState> states);
  void hand_on_history(const PatchContact& old, std::span<const std::uint32_t> successors,
                       std::span<const PatchState> states, double dt);

  const geometry::Surface* surface_;
  PatchSuccessors successors_;
  std::vector<Transferred> transferred_;  ///< by patch
  std::int64_t pass_throughs_ = 0;        ///< in this step
};

inline EnergyLoss HistoryTransfer::to_single_feature(const PatchesOfPair& now,
                                                     const ContactsOfPair& last,
                                                     const PatchState& state, const Motion& motion,
                                                     double dt, Transferred& to) {
  const Feature feature = now.finder.terms(now.patches[0])[0].core.feature;
  EnergyLoss loss;
  for (const PatchContact& old : last.contacts) {
    const auto minima = last.minima_of(old);
    const bool stays = minima.size() == 1 && minima[0] == feature;
    if (!stays && successors_of(minima, now, motion.position).empty()) {
      loss.dissipated = loss_of(now.pair, old, minima, motion, dt);
      continue;
    }
    pass_throughs_ += has_passed(now.pair, old.memory.normal, state, dt);
    AnyLaw::accumulate_history(
        to.history, carried_history<AnyLaw>(old.memory, state.normal, dt * state.twist_rate), 1.0);
    to.id = old.id;
    // Where it stays it is turned with its normal: what differs is rounding, and not counted side
    // by side either.
    if (!stays)
      loss.tracking = AnyLaw::history_energy(now.pair.parameters, old.memory.history) -
                      AnyLaw::history_energy(now.pair.parameters, to.history);
  }
  return loss;
}

}  // namespace plekton::contact
