// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace plekton::apps {

/// Part of a run that is computed again.
struct VerifyArguments {
  std::filesystem::path folder;        ///< of the run
  std::vector<std::string> interval;   ///< begin and end, as in "0.1 s"; empty: up to the end
  std::vector<std::string> overrides;  ///< of the threads
};

/// Computes a run again from one of its checkpoints to a later one, and compares both states.
/// Nothing in its folder is changed.
/// @param out       told what was compared, and whether every bit is the same
/// @param problems  told of later checkpoints that are damaged
/// @returns whether it is
/// @throws InputError if there are no two checkpoints for that interval
bool verify_run(const VerifyArguments& arguments, std::ostream& out, std::ostream& problems);

}  // namespace plekton::apps
