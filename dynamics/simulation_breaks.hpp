// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/simulation.hpp"
#include "dynamics/structure/broken_elements.hpp"

#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// What a simulation does when bonds break; simulation_definitions.hpp includes this.
namespace plekton::dynamics {

template <contact::ContactLaw Law>
void Simulation<Law>::break_bond(std::size_t bond) {
  if (bond >= bonds_.size()) {
    throw std::out_of_range("bond " + std::to_string(bond) + ": there is no such bond, only " +
                            std::to_string(bonds_.size()) + " bonds");
  }
  asked_to_break_.push_back(bond);
}

/// Before the forces of a step: takes out what hangs on the bonds that break in it, because they
/// yielded or were asked to. Linear in the scene where elements are gone; that step may allocate.
template <contact::ContactLaw Law>
void Simulation<Law>::follow_breaks() {
  const std::span<const std::size_t> yielded = yielding_bonds_.broken();
  if (asked_to_break_.empty() && yielded.empty()) return;
  break_asked();
  loads_.follow(bonds_);
  if (surface_.cell_count() > 0) {
    asked_to_break_.insert(asked_to_break_.end(), yielded.begin(), yielded.end());
    if (take_out_broken(scene_, asked_to_break_, bonds_)) follow_surface();
  }
  asked_to_break_.clear();
}

/// Half of the work of a bond's last step is still done by its force of before, the other half is
/// not: the mean of its energies before and after is lost.
template <contact::ContactLaw Law>
void Simulation<Law>::break_asked() {
  for (const std::size_t bond : asked_to_break_) {
    if (bonds_.is_broken(bond)) continue;
    const double after = bonds_.energy_of(bond, scene_.state);
    broken_energy_ += 0.5 * (bonds_.break_bond(bond) + after);
  }
}

/// The scene's elements have become fewer. Elastic energies of contacts before and after are
/// compared half a drift ago, for the same reason as those of bonds.
template <contact::ContactLaw Law>
void Simulation<Law>::follow_surface() {
  geometry::Surface before = surface_.left_with(scene_.elements.cylinders, scene_.elements.facets);
  std::swap(before, surface_);
  const geometry::SurfaceChange change(before, surface_);
  std::vector<Vec3> at = scene_.state.position;
  for (std::size_t i = 0; i < at.size(); ++i) at[i] -= 0.5 * last_drift_ * scene_.state.velocity[i];
  contacts_.follow(change, motion(), at, pool_);
  loads_.follow(change);
}

}  // namespace plekton::dynamics
