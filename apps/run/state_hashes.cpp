// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/state_hashes.hpp"

#include "dynamics/state_hash.hpp"
#include "geometry/base/bit_hash.hpp"
#include "geometry/base/state_archive.hpp"

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

void StateHashes::exchange(const geometry::StateArchive& archive) {
  archive.rows("states", all_, [](geometry::RowFields& row, StateHash& state) {
    row("step", state.step);
    row("time", state.time);
    row("hash", state.hash);
  });
}

}  // namespace plekton::apps
