// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/generate_command.hpp"

#include "apps/command_line/bash_completion.hpp"
#include "apps/command_line/examples_command.hpp"
#include "apps/command_line/manual_page.hpp"
#include "apps/command_line/reference_pages.hpp"
#include "apps/scenario/set_paths.hpp"
#include "apps/scenario/toml_file.hpp"

#include <array>
#include <string_view>
#include <utility>

namespace plekton::apps {
namespace {

using Commands = std::span<const CommandEntry>;

std::string paths_for(const std::filesystem::path& scenario) {
  const Table table =
      scenario.empty() ? Table{} : parse_toml(read_toml_text(scenario), scenario.string());
  std::string lines;
  for (const std::string& path : set_paths(table)) lines += path + '\n';
  return lines;
}

std::string example_names() {
  std::string lines;
  for (const Example& example : find_examples(examples_folder())) lines += example.name + '\n';
  return lines;
}

using Writer = std::string (*)(const GenerateArguments&, Commands);

constexpr std::array kKinds = std::to_array<std::pair<std::string_view, Writer>>({
    {"manual", [](const GenerateArguments& arguments,
                  Commands commands) { return manual_page(commands, arguments.date); }},
    {"bash-completion",
     [](const GenerateArguments&, Commands commands) { return bash_completion(commands); }},
    {"keys", [](const GenerateArguments&, Commands) { return keys_page(); }},
    {"laws", [](const GenerateArguments&, Commands) { return laws_page(); }},
    {"outputs", [](const GenerateArguments&, Commands) { return outputs_page(); }},
    {"commands",
     [](const GenerateArguments&, Commands commands) { return commands_page(commands); }},
    {"set-paths",
     [](const GenerateArguments& arguments, Commands) { return paths_for(arguments.scenario); }},
    {"example-names", [](const GenerateArguments&, Commands) { return example_names(); }},
});

}  // namespace

std::vector<std::string> generated_kinds() {
  std::vector<std::string> words;
  for (const auto& [word, writer] : kKinds) words.emplace_back(word);
  return words;
}

void generate(const GenerateArguments& arguments, std::span<const CommandEntry> commands,
              std::ostream& out) {
  for (const auto& [word, writer] : kKinds)
    if (word == arguments.what) out << writer(arguments, commands);
}

}  // namespace plekton::apps
