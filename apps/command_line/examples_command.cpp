// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/examples_command.hpp"

#include "apps/command_line/exit_code.hpp"
#include "apps/programs/shell_word.hpp"
#include "apps/scenario/closest_word.hpp"
#include "apps/scenario/problems.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

/// The sentences that a file begins with, without the licence and up to a command, on one line.
std::string description_in(const fs::path& file) {
  std::ifstream lines(file);
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of("#/ ");
    const bool is_comment = line.starts_with('#') || line.starts_with("//");
    if (!is_comment || line.starts_with("#include") || line.find("Run: ") != std::string::npos ||
        line.find("plekton run") != std::string::npos)
      break;
    if (begin == std::string::npos || line.find("SPDX") != std::string::npos) continue;
    text += (text.empty() ? "" : " ") + line.substr(begin);
  }
  return text.substr(0, text.rfind('.') + 1);
}

/// The scenario of a folder: that of its name, or the only one. Empty if there is none.
fs::path scenario_in(const fs::path& folder) {
  const fs::path own = folder / (folder.filename().string() + ".toml");
  if (fs::exists(own)) return own;
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".toml") found.push_back(entry.path());
  return found.empty() ? fs::path() : *std::min_element(found.begin(), found.end());
}

/// Goes from the program that runs up to the root. @returns empty if there is none
fs::path folder_of_tree(fs::path from) {
  for (; from.has_relative_path(); from = from.parent_path())
    if (fs::exists(from / "apps/examples/catch/catch.toml")) return from / "apps/examples";
  return {};
}

/// In the order of their names; last what its check has in common with those of others.
std::vector<fs::path> files_of(const Example& example) {
  if (example.is_program()) return {example.main};
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(example.place))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  const fs::path common = example.place.parent_path() / "results.py";
  if (fs::exists(example.place / "check.py") && fs::exists(common)) files.push_back(common);
  return files;
}

void copy_one(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::copy_file(from, to, error);
  if (error)
    throw InputError(fmt::format("{}: cannot be written: {}", to.string(), error.message()));
}

/// Of a folder that holds nothing of the same name.
void require_room(const std::vector<fs::path>& files, const fs::path& target) {
  for (const fs::path& file : files) {
    if (fs::exists(target / file.filename()))
      throw InputError(fmt::format("{}: is there already; take another folder with --out",
                                   (target / file.filename()).string()));
  }
}

const Example& example_named(const std::string& name, const std::vector<Example>& examples) {
  const auto found = std::find_if(examples.begin(), examples.end(),
                                  [&](const Example& example) { return example.name == name; });
  if (found != examples.end()) return *found;
  std::vector<std::string_view> names;
  for (const Example& example : examples) names.push_back(example.name);
  const std::string hint = did_you_mean(name, names);
  throw InputError(fmt::format("there is no example \"{}\"{}", name,
                               hint.empty() ? "; there are " + listed(names) : hint));
}

void list_examples(std::ostream& out) {
  out << "Examples; plekton examples NAME copies one\n";
  for (const Example& example : find_examples(examples_folder())) {
    out << fmt::format("  {:<18} {}{}\n", example.name, example.is_program() ? "(C++) " : "",
                       example.what);
  }
}

/// Copies an example and says how to run it.
/// @param target  folder; its name in the current folder if empty
/// @throws InputError for an unknown name, and a folder with files of that name in it
void copy_example(const std::string& name, fs::path target, std::ostream& out) {
  const std::vector<Example> examples = find_examples(examples_folder());
  const Example& example = example_named(name, examples);
  if (target.empty()) target = example.is_program() ? fs::path(".") : fs::path(name);
  const std::vector<fs::path> files = files_of(example);
  require_room(files, target);
  std::error_code error;
  fs::create_directories(target, error);
  if (error)
    throw InputError(fmt::format("{}: cannot be made: {}", target.string(), error.message()));
  for (const fs::path& file : files) copy_one(file, target / file.filename());

  const fs::path main = (target / example.main.filename()).lexically_normal();
  out << fmt::format("copied {} file{} to {}\n", files.size(), files.size() == 1 ? "" : "s",
                     target.string());
  if (example.is_program())
    out << fmt::format(
        "build it: find_package(plekton CONFIG REQUIRED COMPONENTS dynamics), "
        "add_executable({} {}), target_link_libraries({} plekton::dynamics)\n",
        name, main.string(), name);
  else
    out << fmt::format("run it:  plekton run {}\nlook at: plekton view {}\n",
                       shell_word(main.string()),
                       shell_word((fs::path("out") / main.stem()).string()));
}

/// What `plekton examples` was asked for.
struct ExamplesArguments {
  std::string name;  ///< of the example to copy; empty: all are listed
  fs::path out;      ///< empty: that of its name, of a program the current one
};

void list_or_copy(const ExamplesArguments& arguments, std::ostream& out) {
  if (arguments.name.empty() && !arguments.out.empty())
    throw InputError(fmt::format(
        "--out: got \"{}\" without the name of an example, of which the copy would be; name one, "
        "or list them without --out",
        arguments.out.string()));
  if (arguments.name.empty())
    list_examples(out);
  else
    copy_example(arguments.name, arguments.out, out);
}

}  // namespace

fs::path examples_folder() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path installed = program.parent_path().parent_path() / "share/plekton/examples";
  if (fs::is_directory(installed, ignored)) return installed;
  const fs::path in_tree = folder_of_tree(program.parent_path());
  if (!in_tree.empty()) return in_tree;
  throw InputError(
      fmt::format("{}: is missing, the folder of the examples; install Plekton with them "
                  "(cmake --install)",
                  installed.string()));
}

std::vector<Example> find_examples(const fs::path& folder) {
  std::vector<Example> examples;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const fs::path& place = entry.path();
    fs::path main = place;
    if (entry.is_directory())
      main = scenario_in(place);
    else if (place.extension() != ".cpp")
      main.clear();
    if (!main.empty())
      examples.push_back({place.stem().string(), description_in(main), place, main});
  }
  std::sort(examples.begin(), examples.end(), [](const Example& a, const Example& b) {
    return std::pair(a.is_program(), a.name) < std::pair(b.is_program(), b.name);
  });
  return examples;
}

ProgramCommand add_examples(CLI::App& app) {
  const auto arguments = std::make_shared<ExamplesArguments>();
  CLI::App* examples =
      app.add_subcommand("examples", "List the examples that are shipped, or copy one");
  examples->add_option("name", arguments->name,
                       "Of the example to copy; all are listed without it");
  examples->add_option("--out", arguments->out,
                       "Folder for the copy; that of its name, of a C++ program the current one");
  return {examples, [arguments] {
            list_or_copy(*arguments, std::cout);
            flush_output();
            return kDone;
          }};
}

}  // namespace plekton::apps
