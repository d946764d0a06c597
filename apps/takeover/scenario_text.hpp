// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/takeover/yade_scene.hpp"

#include <string>
#include <vector>

namespace plekton::apps::yade {

/// A scene as a scenario.
struct Takeover {
  std::string scenario;             ///< TOML
  std::vector<std::string> counts;  ///< a line for what there is of each kind, with its mass
  std::vector<std::string>
      notes;  ///< a line for all that has no counterpart or is another thing here
};

/// How a scenario is to be written.
struct TakeoverOptions {
  std::string script;            ///< what the scenario says it is of
  bool has_chosen_step = false;  ///< time_step = "auto" instead of YADE's
  double steps = 1000.0;         ///< of YADE, that its duration is
};

Takeover take_over(const Scene& scene, const TakeoverOptions& options);

}  // namespace plekton::apps::yade
