// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/state_hashes.hpp"

#include "dynamics/state_hash.hpp"
#include "geometry/base/bit_hash.hpp"

namespace plekton::apps {

void StateHashes::take(const dynamics::Simulation& simulation) {
  if (!all_.empty() && all_.back().step == simulation.steps()) return;
  all_.push_back({simulation.steps(), simulation.time(), dynamics::state_hash(simulation)});
}

std::uint64_t StateHashes::chain() const noexcept {
  geometry::BitHash chain;
  for (const StateHash& state : all_) chain.add(state.hash);
  return chain.value();
}

}  // namespace plekton::apps
