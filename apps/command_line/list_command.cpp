// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/list_command.hpp"

#include "apps/command_line/exit_code.hpp"
#include "apps/command_line/list_outputs.hpp"
#include "apps/scenario/key_list.hpp"
#include "contact/law_list.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>

namespace plekton::apps {
namespace {

using contact::LawParameter;

std::string_view unit_of(LawParameter::Kind kind) {
  switch (kind) {
    case LawParameter::Kind::pressure:
      return "Pa";
    case LawParameter::Kind::length:
      return "m";
    case LawParameter::Kind::stiffness:
      return "N/m";
    case LawParameter::Kind::energy_per_area:
      return "J/m2";
    case LawParameter::Kind::number:
      break;
  }
  return "-";
}

std::string default_of(const LawParameter& parameter) {
  const bool is_in_range = parameter.standard > parameter.low ||
                           (parameter.with_low && parameter.standard == parameter.low);
  return is_in_range && std::isfinite(parameter.standard) ? fmt::format("{:g}", parameter.standard)
                                                          : "none";
}

void list_parameters(std::span<const LawParameter> parameters, std::ostream& out) {
  for (const LawParameter& parameter : parameters) {
    out << fmt::format("    {:<20} {:<5} {:<5} {}\n", parameter.name, unit_of(parameter.kind),
                       default_of(parameter), parameter.what);
  }
}

void list_words(std::span<const contact::LawChoice> choices, std::ostream& out) {
  for (const contact::LawChoice& choice : choices) {
    out << fmt::format("    {:<20} {:<5} {:<5} {}\n", choice.name, "name", choice.words.front(),
                       choice.what);
  }
}

void list_keys(const KeyGroup& group, std::ostream& out) {
  out << group.table;
  if (!group.kind.empty()) out << fmt::format(" kind = \"{}\"", group.kind);
  out << '\n';
  std::size_t width = 20;
  for (const ListedKey& key : group.keys) width = std::max(width, key.standard.size());
  for (const ListedKey& key : group.keys)
    out << fmt::format("    {:<20} {:<{}} {}; {}\n", key.path, key.standard, width, kind_text(key),
                       key.what);
}

/// Prints what a scenario can name, with parameters, units and defaults.
void list_choices(std::ostream& out) {
  out << "Contact laws, for `law` in [[contacts]]; parameters with unit, default and meaning\n";
  for (const contact::LawEntry& law : contact::contact_laws()) {
    out << fmt::format("  {:<22} {}\n", law.name, law.what);
    list_parameters(law.parameters, out);
    list_words(law.choices, out);
  }
  out << "  with every law\n";
  list_parameters(contact::common_law_parameters(), out);
  out << "\nKeys of a scenario with default (SI), what they take, and their meaning; \"-\" may be "
         "left out, N is the number of a table; more in apps/scenario.md\n";
  for (const KeyGroup& group : scenario_keys()) list_keys(group, out);
  out << '\n';
  list_outputs(out);
}

}  // namespace

ProgramCommand add_list(CLI::App& app) {
  CLI::App* list =
      app.add_subcommand("list", "Say what a scenario can name, with parameters and defaults");
  return {list, [] {
            list_choices(std::cout);
            flush_output();
            return kDone;
          }};
}

}  // namespace plekton::apps
