// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/usage_error.hpp"

#include "apps/command_line/command_table.hpp"
#include "apps/scenario/closest_word.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace plekton::apps {
namespace {

bool is_option(std::string_view word) {
  return word.size() > 1 && word.front() == '-';
}

std::string unknown_command(const CLI::App& app, const std::string& word) {
  const std::vector<CommandEntry> commands = command_table(app);
  std::vector<std::string_view> names;
  for (const CommandEntry& command : commands) names.push_back(command.name);
  if (word.empty()) return "expected a command: " + listed(names);
  if (word.ends_with(".toml"))
    return fmt::format("unknown command \"{}\"; did you mean \"plekton run {}\"?", word, word);
  const std::string closest = closest_word(word, names);
  return fmt::format("unknown command \"{}\"; {}", word,
                     closest.empty() ? "the commands are " + listed(names)
                                     : fmt::format("did you mean \"{}\"?", closest));
}

/// As they are written, "--out".
std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options([](const CLI::Option*) { return true; }))
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string unknown_option(const CLI::App& command, const std::string& word) {
  const std::vector<std::string> names = options_of(command);
  const std::vector<std::string_view> known(names.begin(), names.end());
  const std::string written = word.substr(0, word.find('='));
  std::string closest = closest_word(written, known);
  // Of --output as of --over: one that it begins with, or begins.
  for (const std::string_view name : known)
    if (closest.empty() && (written.starts_with(name) || name.starts_with(written))) closest = name;
  return fmt::format("unknown option \"{}\"{}", written,
                     closest.empty() ? "" : fmt::format("; did you mean \"{}\"?", closest));
}

std::string one_too_many(const CLI::App& command, const std::string& word) {
  const std::vector<std::string> names = options_of(command);
  const bool has_out = std::find(names.begin(), names.end(), "--out") != names.end();
  return fmt::format("\"{}\" is one argument too many{}", word,
                     has_out ? "; what is written goes to --out" : "");
}

}  // namespace

std::string usage_error(const CLI::App& app, const CLI::ParseError& error,
                        const std::string& first) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  if (parsed.empty()) {
    if (!is_option(first)) return unknown_command(app, first);
    return unknown_option(app, first) + " (see plekton --help)";
  }
  const CLI::App& command = *parsed.front();
  std::string text = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    const std::vector<std::string> left = command.remaining();
    // An option that is not known leaves its value behind, which then is one argument too many.
    const auto option = std::find_if(left.begin(), left.end(), is_option);
    if (option != left.end())
      text = unknown_option(command, *option);
    else if (!left.empty())
      text = one_too_many(command, left.front());
  }
  return fmt::format("{}: {} (see plekton {} --help)", command.get_name(), text,
                     command.get_name());
}

}  // namespace plekton::apps
