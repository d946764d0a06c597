// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/bash_completion.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>

namespace plekton::apps {
namespace {

/// What completes an argument: a function of the script below and what it is handed.
constexpr std::array kArguments = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"scenario", "_plekton_files toml"},
    {"mesh", "_plekton_files off obj stl ply msh vtp"},
    {"checkpoint", "_plekton_files h5"},
    {"script", "_plekton_files py"},
    {"run", "_plekton_files"},
    {"study", "_plekton_files toml"},
    {"file", "_plekton_files toml"},
    {"name", "_plekton_words \"$(plekton generate example-names 2> /dev/null)\""},
    {"names", "_plekton_words \"$(plekton validate --list 2> /dev/null | cut -d ' ' -f 1)\""},
});

constexpr std::string_view kFunctions =
    R"sh(# Completion of plekton for bash, written by the program from its own table of commands.

# Words that begin like the current one.
_plekton_words() {
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur")
}

# Folders, and files with one of the endings.
_plekton_files() {
  local ending
  compopt -o filenames 2> /dev/null
  mapfile -t COMPREPLY < <(compgen -d -- "$cur")
  for ending in "$@"; do
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -X "!*.$ending" -- "$cur")
  done
}

# Paths of the keys of the scenario on the line, each up to its value.
_plekton_set() {
  local word scenario=
  for word in "${COMP_WORDS[@]}"; do
    case $word in *.toml) scenario=$word ;; esac
  done
  compopt -o nospace 2> /dev/null
  mapfile -t COMPREPLY < <(compgen -S = -W "$(plekton generate set-paths ${scenario:+"$scenario"} 2> /dev/null)" -- "$cur")
}

)sh";

std::string_view completer_of(const CommandEntry& command) {
  for (const CommandOption& option : command.options) {
    if (!option.is_argument) continue;
    for (const auto& [name, completer] : kArguments)
      if (name == option.name) return completer;
  }
  return ":";
}

/// A line of a case statement: what follows an option with a value.
std::string value_case(const CommandEntry& command) {
  std::string free;
  std::string text;
  for (const CommandOption& option : command.options) {
    if (option.is_argument || !option.needs_value) continue;
    if (option.name == "--set")
      text += fmt::format("    '{} --set') _plekton_set; return ;;\n", command.name);
    else if (option.name == "--out" || option.name == "--resume")
      text += fmt::format("    '{} {}') _plekton_files; return ;;\n", command.name, option.name);
    else
      free += fmt::format("{}'{} {}'", free.empty() ? "" : " | ", command.name, option.name);
  }
  return free.empty() ? text : text + fmt::format("    {}) return ;;\n", free);
}

std::string option_case(const CommandEntry& command) {
  std::string options;
  for (const CommandOption& option : command.options) {
    if (!option.is_argument) options += (options.empty() ? "" : " ") + option.name;
  }
  return fmt::format(
      "    {})\n"
      "      case $cur in\n"
      "        -*) _plekton_words '{}' ;;\n"
      "        *) {} ;;\n"
      "      esac ;;\n",
      command.name, options, completer_of(command));
}

}  // namespace

std::string bash_completion(std::span<const CommandEntry> commands) {
  std::string names;
  std::string values;
  std::string options;
  for (const CommandEntry& command : commands) {
    names += command.name + ' ';
    values += value_case(command);
    options += option_case(command);
  }
  return fmt::format(
      "{}_plekton() {{\n"
      "  local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD-1]}}\n"
      "  COMPREPLY=()\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
      "    _plekton_words '{}--help --version'\n"
      "    return\n"
      "  fi\n"
      "  case \"${{COMP_WORDS[1]}} $prev\" in\n"
      "{}"
      "  esac\n"
      "  case ${{COMP_WORDS[1]}} in\n"
      "{}"
      "  esac\n"
      "}}\n"
      "complete -F _plekton plekton\n",
      kFunctions, names, values, options);
}

}  // namespace plekton::apps
