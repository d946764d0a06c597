// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/command_table.hpp"

#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace plekton::apps {

/// What the build, the pages of the documentation and the completion of shells ask for.
struct GenerateArguments {
  std::string what;
  std::filesystem::path scenario;  ///< for set-paths
  std::string date;                ///< of the manual page
};

/// The words for `what`.
std::vector<std::string> generated_kinds();

/// Writes what was asked for. @throws InputError
void generate(const GenerateArguments& arguments, std::span<const CommandEntry> commands,
              std::ostream& out);

}  // namespace plekton::apps
