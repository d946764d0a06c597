// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/run_stages.hpp"

#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace plekton::apps {

/// Where the stages of a command begin and end.
struct StagesAsked {
  std::vector<std::string> from;                ///< name of a stage and folder of its run; or empty
  const geometry::StateTree* resume = nullptr;  ///< a state to go on from
  std::string until;                            ///< name of the last stage; empty: all
  bool same_folder = true;                      ///< where the state to go on from is
  bool by_clock = false;  ///< that state is of a checkpoint that does not stay
  std::optional<double> written_from = std::nullopt;  ///< s, when output begins in another folder
  std::function<void(const dynamics::Simulation&)> begins = {};  ///< hears of each stage
};

/// Runs stages and says on a stream, if one is given, which.
/// @throws InputError also for stages that there are not
RunReport run_stages_asked(const Scenario& scenario, const StagesAsked& asked,
                           const RunSettings& settings, const HearSetUp& hear, std::ostream* aloud);

/// What `plekton check` says of stages.
struct StagesSeen {
  struct Stage {
    std::string name;
    std::string limits;  ///< when it ends, in words
    std::size_t grains = 0;
    std::size_t planes = 0;
    std::size_t loads = 0;
  };
  std::vector<Stage> stages;  ///< in the order in which they come
  std::vector<std::string> warnings;
};

/// A line each.
std::string text_of(const std::vector<StagesSeen::Stage>& stages);

/// Looks at each stage as far as it can be known before it is run: what it says, that its scene can
/// be built, that its grains have room beside membranes and planes, that something moves, and
/// that a time step it gives is below the limit of its bodies where they are made.
/// @throws InputError
StagesSeen look_at_stages(const Scenario& scenario, const HearSetUp& hear);

}  // namespace plekton::apps
