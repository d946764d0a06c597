// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/config_tree.hpp"
#include "apps/scenario/stage_settings.hpp"

#include <vector>

/// A scenario with stages is a scenario for each of them: what stands outside of the stages, changed
/// by what each stage says in its turn. All that reads, builds and runs scenarios sees one at a
/// time.
namespace plekton::apps {

/// The scenario of one stage.
struct StageTable {
  Table table;  ///< with a list `stages` of one table, which has what only the stage itself knows
  StageOrigins origins;
};

bool has_stages(const Table& scenario);

/// One for each table [[stages]]. Keys of tables replace those from before; planes, loads and
/// reactions are added, or found by their names and changed; pairs of contacts likewise, by their
/// materials; grains are added. What `remove` names of planes and loads is gone.
std::vector<StageTable> stage_tables(const Table& scenario, Problems& problems);

}  // namespace plekton::apps
