// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <iosfwd>
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

void list_examples(std::ostream& out);

/// Copies an example and says how to run it.
/// @param target  folder; its name in the current folder if empty
/// @throws InputError for an unknown name, and a folder with files of that name in it
void copy_example(const std::string& name, std::filesystem::path target, std::ostream& out);

}  // namespace plekton::apps
