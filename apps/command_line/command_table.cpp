// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/command_table.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace plekton::apps {
namespace {

/// What stands for the value of an option: what it says itself, as in "[PORT]", or else its name in
/// capitals.
std::string value_of(const CLI::Option& option, const std::string& name) {
  const std::string type = option.get_type_name();
  constexpr std::array<std::string_view, 5> kGeneric{"TEXT", "INT", "UINT", "FLOAT", "BOOLEAN"};
  const bool is_told = !type.empty() && std::ranges::none_of(kGeneric, [&](std::string_view word) {
    return type.starts_with(word);
  });
  if (is_told) return type.starts_with('[') ? type.substr(1, type.size() - 2) : type;
  std::string text = name.substr(std::min(name.find_first_not_of('-'), name.size()));
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
    return c == '-' ? '_' : static_cast<char>(std::toupper(c));
  });
  return text;
}

CommandOption option_of(const CLI::Option& option) {
  const bool is_argument = option.get_positional();
  const std::string name =
      is_argument ? option.get_name(true, false) : "--" + option.get_lnames().front();
  return {name,
          option.get_description(),
          option.get_items_expected_max(),
          option.get_items_expected_min() > 0,
          value_of(option, name),
          is_argument,
          option.get_required()};
}

}  // namespace

std::vector<CommandEntry> command_table(const CLI::App& app) {
  std::vector<CommandEntry> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_group().empty()) continue;
    CommandEntry entry{command->get_name(), command->get_description(), {}};
    for (const CLI::Option* option : command->get_options([](const CLI::Option*) { return true; }))
      entry.options.push_back(option_of(*option));
    std::stable_partition(entry.options.begin(), entry.options.end(),
                          [](const CommandOption& option) { return option.is_argument; });
    commands.push_back(std::move(entry));
  }
  return commands;
}

std::string usage_of(const CommandOption& option) {
  if (option.is_argument) return option.value;
  if (option.values == 0) return option.name;
  const std::string value = option.needs_value ? option.value : fmt::format("[{}]", option.value);
  return fmt::format("{} {}", option.name, value);
}

std::string usage_of(const CommandEntry& command) {
  std::string text = "plekton " + command.name;
  for (const CommandOption& option : command.options) {
    if (option.name == "--help") continue;
    const std::string usage = usage_of(option);
    text += option.is_required ? " " + usage : fmt::format(" [{}]", usage);
  }
  return text;
}

}  // namespace plekton::apps
