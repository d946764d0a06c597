// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::stress {

/// What can be wrong with a scene.
enum class Fault : std::uint8_t {
  crash,             ///< a signal ended the process, or an exception of no known kind
  hang,              ///< it took far longer than any such scene
  not_finite,        ///< a position, velocity or rotation is no number
  check,             ///< `check` and `run` do not agree whether it can be run, or why not
  diverged,          ///< it became meaningless without a warning of `check`
  momentum,          ///< not what gravity alone leaves of a scene that nothing else acts on
  angular_momentum,  ///< likewise
  energy,            ///< the ledger does not close
  made_energy,       ///< more energy in the motion than there was, by a sum from outside
  threads,           ///< another state with another number of threads
  restart            ///< another state, or other files, after going on from a checkpoint
};

inline constexpr std::array<std::string_view, 11> kFaultNames = {
    "crash",  "hang",        "not_finite", "check",  "diverged", "momentum", "angular_momentum",
    "energy", "made_energy", "threads",    "restart"};

constexpr std::string_view name_of(Fault fault) noexcept {
  return kFaultNames[static_cast<std::size_t>(fault)];
}

struct Finding {
  Fault fault;
  std::string text;  ///< a line
};

/// What came of a scene.
struct Findings {
  std::vector<Finding> all;
  bool is_refused = false;      ///< by `check` and `run` alike
  bool knows_momentum = false;  ///< nothing but even gravity acted from outside
  std::int64_t steps = 0;       ///< of all its runs
  std::size_t contacts = 0;     ///< the most at a time
  std::size_t broken = 0;       ///< bonds and facets, at the end
  double closure = 0.0;         ///< of the energy, over what went through

  bool has(Fault fault) const noexcept {
    for (const Finding& finding : all)
      if (finding.fault == fault) return true;
    return false;
  }
};

}  // namespace plekton::stress
