// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/command.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace plekton::apps {

/// Something that is shipped to be looked at and changed.
struct Example {
  std::string name;
  std::string what;             ///< what its file says of itself
  std::filesystem::path place;  ///< a folder with a scenario, or a program
  std::filesystem::path main;   ///< the scenario, or the program again

  bool is_program() const { return place == main; }
};

/// Where the examples are: share/plekton/examples beside the program that runs, or apps/examples in
/// the tree that it was built in. @throws InputError where neither is
std::filesystem::path examples_folder();

/// All that are in a folder, by name: those with a scenario, then programs.
std::vector<Example> find_examples(const std::filesystem::path& folder);

/// `plekton examples` lists the examples that are shipped, or copies one.
ProgramCommand add_examples(CLI::App& app);

}  // namespace plekton::apps
