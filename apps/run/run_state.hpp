// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/run_report.hpp"
#include "apps/run/written_files.hpp"
#include "apps/scenario/scenario.hpp"
#include "geometry/base/state_archive.hpp"

#include <string>
#include <vector>

/// What a checkpoint has of a run beside the state of its simulation, in a group of its own. No
/// times of clocks and no threads: the same run makes the same bytes.
namespace plekton::apps {

inline constexpr const char* kRunGroup = "run";
inline constexpr const char* kStageGroup = "stage";  ///< in that group, of scenarios with stages

void exchange_files(const geometry::StateArchive& archive, WrittenFiles& files);

/// Texts as one, each closed by a character that none has.
void exchange_texts(const geometry::StateArchive& archive, const char* name,
                    std::vector<std::string>& texts);

/// What a report has collected so far.
void exchange_so_far(const geometry::StateArchive& archive, RunReport& report);

/// The scenario that is run, as text.
struct ScenarioText {
  std::string text;
  std::string file;  ///< absolute, so that meshes are found from anywhere
  std::vector<std::string> overrides;

  void exchange(const geometry::StateArchive& archive);
};
ScenarioText text_of(const Scenario& scenario);

}  // namespace plekton::apps
