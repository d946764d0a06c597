// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <ostream>
#include <string>

namespace plekton::apps {

/// What `plekton export-ondem` was asked for.
struct ExportOndemArguments {
  std::filesystem::path run;  ///< folder of a run
  std::string at;             ///< a time; empty: that of the last checkpoint
  std::filesystem::path out;  ///< empty: ondem.vtkhdf in the folder
};

/// Writes what a checkpoint of a run holds as a file of the ON-DEM network.
/// @param problems  told of later checkpoints that are damaged
/// @throws InputError, dynamics::OutputError
void export_ondem(const ExportOndemArguments& arguments, std::ostream& out, std::ostream& problems);

}  // namespace plekton::apps
