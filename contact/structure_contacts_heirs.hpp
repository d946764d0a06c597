// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/structure_contacts.hpp"

/// What patches of one step leave to those of the next.
namespace plekton::contact {

template <ContactLaw Law>
void StructureContacts<Law>::find_heirs() {
  heirs_.clear();
  if (!terms_.acting_changed()) {
    for (std::uint32_t i = 0; i < patches_.size(); ++i) heirs_.push_back({i, i, false});
    return;
  }
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
}

/// Hands the histories of the last step's patches to this step's. A spring that comes to count for
/// more contacts keeps its force, one that counts for less keeps its stretch: neither gains energy.
/// What a patch stored that nothing follows is dissipated.
template <ContactLaw Law>
EnergyLoss StructureContacts<Law>::inherit(const Motion& motion, double dt) {
  EnergyLoss loss;
  for (const Legacy& old : previous_) loss.dissipated += old.energy;
  for (const Heir& heir : heirs_) {
    if (&heir == heirs_.data() || (&heir - 1)->old_patch != heir.old_patch) {
      loss.dissipated -= previous_[heir.old_patch].energy;
      loss.tracking += previous_[heir.old_patch].energy;
    }
  }
  for (auto begin = heirs_.begin(); begin != heirs_.end();) {
    const auto end = std::find_if(
        begin, heirs_.end(), [&](const Heir& heir) { return heir.old_patch != begin->old_patch; });
    const Legacy& old = previous_[begin->old_patch];
    hand_on_number(old, {begin, end});
    double total = 0.0;
    for (auto heir = begin; heir != end; ++heir) total += patches_[heir->patch].normal_force;
    for (auto heir = begin; heir != end && total > 0.0; ++heir) {
      Patch& patch = patches_[heir->patch];
      if (!(patch.normal_force > 0.0) || !(patch.point_part > 0.0)) continue;
      const double sign = heir->is_turned ? -1.0 : 1.0;
      const Vec3 normal = sign / patch.normal_force * patch.elastic_force;
      const Vec3 spin =
          0.5 * (patch.first.angular_velocity(motion) + patch.second.angular_velocity(motion));
      const auto carried = carried_history<Law>(old.memory, normal, dt * spin.dot(normal));
      const double share = patch.normal_force / total * old.count / patch.point_count();
      Law::add_share(patch.memory.history, carried, sign * std::min(1.0, share));
    }
    begin = end;
  }
  for (const Patch& patch : patches_) loss.tracking -= history_energy(patch);
  return loss;
}

/// To the heir that pushes most; of patches that merge, the number of the one that pushed most goes
/// on.
template <ContactLaw Law>
void StructureContacts<Law>::hand_on_number(const Legacy& old, std::span<const Heir> heirs) {
  const Heir& largest =
      *std::max_element(heirs.begin(), heirs.end(), [&](const Heir& p, const Heir& q) {
        return patches_[p.patch].normal_force < patches_[q.patch].normal_force;
      });
  Patch& patch = patches_[largest.patch];
  if (!(old.normal_force > patch.id_from)) return;
  patch.id = old.id;
  patch.id_from = old.normal_force;
}

}  // namespace plekton::contact
