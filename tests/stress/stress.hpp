// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/stress/examination.hpp"
#include "tests/stress/scene_text.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <string>

namespace plekton::stress {

struct StressOptions {
  std::uint64_t seed = 1;
  std::uint64_t first = 0;                   ///< number of the first scene of the seed
  std::uint64_t scenes = 0;                  ///< how many; 0: until the time is over
  std::chrono::duration<double> time{60.0};  ///< if no number is given
  std::int64_t steps = 1500;                 ///< of each scene, about, at most
  std::chrono::seconds shrinking{120};       ///< the longest for one failure
  std::filesystem::path out = "stress-failures";
  std::function<void(dynamics::Simulation&, Part)> disturb;  ///< see ExaminationOptions
};

/// What has been seen.
struct Tally {
  std::uint64_t scenes = 0;
  std::uint64_t refused = 0;
  std::uint64_t free = 0;  ///< of known momentum
  std::uint64_t failed = 0;
  std::int64_t steps = 0;
  std::uint64_t contacts = 0;  ///< the most at a time, over all scenes
  std::uint64_t broken = 0;
  std::uint64_t poor_closure = 0;  ///< scenes whose energy is off by more than 1 %
  std::array<std::uint64_t, kFaultNames.size()> faults{};
  std::map<std::string, std::uint64_t> words;  ///< scenes that have a kind, mode or law
};

/// Examines random scenes. Each that fails is written as a scenario file, whole and shrunk.
/// @param log  told of each failure
Tally stress(const StressOptions& options, std::ostream& log);

/// Examines one scenario file; a failure is shrunk and written likewise.
Tally stress_file(const std::filesystem::path& file, const StressOptions& options,
                  std::ostream& log);

std::string table_of(const Tally& tally);

}  // namespace plekton::stress
