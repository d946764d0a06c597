// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <ostream>
#include <string>

namespace plekton::apps {

/// What `plekton import-yade` was asked for.
struct ImportYadeArguments {
  std::filesystem::path script;
  std::string iteration = "0";  ///< to run to, or end: where the script ends
  std::filesystem::path out;    ///< folder; empty: out/<script>-yade
  bool overwrite = false;
};

/// Runs a script of YADE to an iteration and writes what is there as a scenario, with a report of
/// what has no counterpart; prints the report. The scenario is tried: where YADE's time step is no
/// step here, it gets one that is chosen, and what else is wrong with it is reported.
/// @throws InputError, dynamics::OutputError
void import_yade(const ImportYadeArguments& arguments, std::ostream& out);

}  // namespace plekton::apps
