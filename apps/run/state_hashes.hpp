// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/simulation.hpp"

#include <cstdint>
#include <vector>

namespace plekton::geometry {
class StateArchive;
}

namespace plekton::apps {

/// The state at one step, as dynamics::state_hash has it.
struct StateHash {
  std::int64_t step = 0;
  double time = 0.0;  ///< s
  std::uint64_t hash = 0;
};

/// Hashes of the state at steps 0, N, 2 N, ... and at the end. By them runs on different machines,
/// with other builds or numbers of threads, are compared.
class StateHashes {
 public:
  /// @param interval  steps, at least 1
  explicit StateHashes(std::int64_t interval = 1) noexcept : interval_(interval) {}

  /// To be called before the first step and after each; takes the state if it is due.
  void look(const dynamics::Simulation& simulation) {
    if (simulation.steps() % interval_ == 0) take(simulation);
  }
  /// The state, unless it has been taken: at the end.
  void take(const dynamics::Simulation& simulation);

  /// Those so far. @throws geometry::StateMismatch
  void exchange(const geometry::StateArchive& archive);

  std::int64_t interval() const noexcept { return interval_; }
  const std::vector<StateHash>& all() const noexcept { return all_; }
  /// One number for all of them: their hashes, hashed in their order (geometry/base/bit_hash.hpp).
  std::uint64_t chain() const noexcept;

 private:
  std::int64_t interval_;
  std::vector<StateHash> all_;
};

}  // namespace plekton::apps
