// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace plekton::apps {

/// What `plekton validate` was asked for.
struct ValidateArguments {
  std::vector<std::string> names;  ///< of cases; none: all
  bool list = false;               ///< only say which there are
  bool full = false;
  std::filesystem::path out = "out/validation";
};

/// Runs cases, prints what each comes to, and writes validation.html. A name that is no case, or a
/// folder that cannot be written, is said at the end; the rest goes on.
/// @returns whether all is well
bool validate(const ValidateArguments& arguments, std::ostream& out, std::ostream& problems);

}  // namespace plekton::apps
