// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/generate_command.hpp"

#include "apps/command_line/bash_completion.hpp"
#include "apps/command_line/command_table.hpp"
#include "apps/command_line/examples_command.hpp"
#include "apps/command_line/exit_code.hpp"
#include "apps/command_line/manual_page.hpp"
#include "apps/command_line/reference_pages.hpp"
#include "apps/scenario/set_paths.hpp"
#include "apps/scenario/toml_file.hpp"

#include <CLI/CLI.hpp>

#include <array>
#include <filesystem>
#include <iostream>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plekton::apps {
namespace {

using Commands = std::span<const CommandEntry>;

/// What the build, the pages of the documentation and the completion of shells ask for.
struct GenerateArguments {
  std::string what;
  std::filesystem::path scenario;  ///< for set-paths
  std::string date;                ///< of the manual page
};

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

/// The words for `what`.
std::vector<std::string> generated_kinds() {
  std::vector<std::string> words;
  for (const auto& [word, writer] : kKinds) words.emplace_back(word);
  return words;
}

/// Writes what was asked for. @throws InputError
void generate(const GenerateArguments& arguments, Commands commands, std::ostream& out) {
  for (const auto& [word, writer] : kKinds)
    if (word == arguments.what) out << writer(arguments, commands);
}

}  // namespace

ProgramCommand add_generate(CLI::App& app) {
  const auto arguments = std::make_shared<GenerateArguments>();
  CLI::App* generated = app.add_subcommand("generate", "Write parts of the documentation");
  generated->group("");
  generated->add_option("what", arguments->what, "What to write")
      ->required()
      ->check(CLI::IsMember(generated_kinds()));
  generated->add_option("scenario", arguments->scenario, "Whose paths, for set-paths");
  generated->add_option("--date", arguments->date, "Of the manual page, as in 2026-11-23");
  return {generated, [arguments, &app] {
            generate(*arguments, command_table(app), std::cout);
            flush_output();
            return kDone;
          }};
}

}  // namespace plekton::apps
