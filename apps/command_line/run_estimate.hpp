// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/run.hpp"

#include <cstdint>
#include <string>

namespace plekton::apps {

/// What a run takes, from a few steps that are timed.
struct RunEstimate {
  std::string stage;  ///< the one that it is of; empty without stages
  struct Bounds {
    double low = 0.0;
    double high = 0.0;
  };
  /// As steps are chosen now; and as if all contacts that may come were there, where the step is
  /// chosen as it goes.
  Bounds steps;
  std::int64_t timed_steps = 0;
  double step_time = 0.0;  ///< s of wall time, mean of these
  /// s: with low steps of that cost; and with high steps of kLaterCost times it.
  Bounds wall_time;
  double frames = 0.0;
  /// Of frames, energy.csv and reactions.csv: frames as they can be packed now, with the contacts
  /// of now; and not packed at all, with `most_contacts`.
  Bounds bytes;
  double most_contacts = 0.0;  ///< at a time
  int threads = 1;
  bool may_stop_early = false;  ///< there is a [stop]
  std::string failure;          ///< if the simulation diverges within these steps: its message
};

/// Steps of later, when bodies have met, over those of the start: what falls and comes to rest was
/// seen to take up to 1.7 times as long (apps/examples/catch).
inline constexpr double kLaterCost = 2.0;

/// Makes steps for about half a second, but never more than the run has, nor more than a thousand;
/// a single step may take longer. Nothing is written.
RunEstimate estimate_run(const Scenario& scenario, PreparedRun& prepared);

/// For people, in lines: the figures, how they were found, and what they leave out.
std::string text_of(const RunEstimate& estimate);

}  // namespace plekton::apps
