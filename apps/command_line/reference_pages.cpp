// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/reference_pages.hpp"

#include "apps/command_line/list_outputs.hpp"
#include "apps/scenario/key_list.hpp"
#include "contact/law_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace plekton::apps {
namespace {

/// A text in a cell of a table: nothing in it ends the cell or marks anything up.
std::string cell(std::string_view text) {
  std::string result;
  for (const char c : text) {
    constexpr std::string_view kMarks = "|*_<>[]\\";
    if (kMarks.find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result.empty() ? "-" : result;
}

std::string code(std::string_view text) {
  return fmt::format("`{}`", text);
}

constexpr std::string_view kKeyHead =
    "| key | type | unit | default | range | meaning |\n|---|---|---|---|---|---|\n";

std::string key_row(const ListedKey& key) {
  std::string name;
  std::string range;
  for (const ValueType& type : key.types) {
    name += (name.empty() ? "" : ", or ") + name_of(type);
    const std::string text = range_of(type);
    if (!text.empty()) range += (range.empty() ? "" : "; ") + text;
  }
  return fmt::format("| {} | {} | {} | {} | {} | {} |\n", code(key.path), cell(name),
                     cell(unit_of(key.types.front())), cell(key.standard), cell(range),
                     cell(key.what));
}

/// "[[membranes]] shape" and "tube" to "[[membranes]] shape, kind = "tube"".
std::string heading_of(const KeyGroup& group) {
  return group.kind.empty() ? group.table
                            : fmt::format("{}, kind = \"{}\"", group.table, group.kind);
}

/// The parameters of a law that have one of these names, as the reader takes them with that law.
template <class Parameters>
std::string rows_of(const contact::LawEntry& law, const Parameters& parameters) {
  constexpr std::string_view kTable = "contacts[].";
  const std::vector<ListedKey> keys = listed_keys({{"contacts[].law", std::string(law.name)}});
  std::string rows;
  for (const auto& parameter : parameters) {
    const auto found = std::find_if(keys.begin(), keys.end(), [&](const ListedKey& key) {
      return key.path == std::string(kTable) + std::string(parameter.name);
    });
    if (found == keys.end()) continue;
    ListedKey key = *found;
    key.path.erase(0, kTable.size());
    rows += key_row(key);
  }
  return rows;
}

}  // namespace

std::string keys_page() {
  std::string page =
      "# Keys of a scenario\n\nWritten by the program from the table by which it reads. A default "
      "of "
      "\"-\" may be left out, N is the number of a table, units are those of plain numbers. What "
      "keys do, and which go together, is in [Scenario files](scenario.md).\n";
  for (const KeyGroup& group : scenario_keys()) {
    page += fmt::format("\n## {}\n\n{}", code(heading_of(group)), kKeyHead);
    for (const ListedKey& key : group.keys) page += key_row(key);
  }
  return page;
}

std::string laws_page() {
  std::string page =
      "# Contact laws\n\nFor `law` in `[[contacts]]`, written by the program from its list of "
      "laws. "
      "Formulas are in [Theory](../theory/laws.md).\n";
  for (const contact::LawEntry& law : contact::contact_laws()) {
    page += fmt::format("\n## {}\n\n{}.\n", code(law.name), cell(law.what));
    const std::string rows = rows_of(law, law.parameters) + rows_of(law, law.choices);
    if (!rows.empty()) page += fmt::format("\n{}{}", kKeyHead, rows);
  }
  page += fmt::format("\n## With every law\n\n{}{}", kKeyHead,
                      rows_of(contact::contact_laws().front(), contact::common_law_parameters()));
  return page;
}

std::string outputs_page() {
  std::string page =
      "# Columns and arrays of results\n\nWritten by the program from the tables by which it "
      "writes "
      "files. All values are in SI units.\n";
  for (const OutputTable& table : output_tables()) {
    page += fmt::format("\n## {}\n\n| name | unit | meaning |\n|---|---|---|\n", table.title);
    for (const dynamics::OutputField& field : table.fields)
      page +=
          fmt::format("| {} | {} | {} |\n", code(field.name), cell(field.unit), cell(field.what));
  }
  return page;
}

std::string commands_page(std::span<const CommandEntry> commands) {
  std::string page =
      "# Commands\n\nWritten by the program from its own table of commands; `plekton COMMAND "
      "--help` says the same, and `man plekton`.\n";
  for (const CommandEntry& command : commands) {
    page += fmt::format("\n## plekton {}\n\n{}.\n\n```text\n{}\n```\n", command.name,
                        cell(command.what), usage_of(command));
    std::string rows;
    for (const CommandOption& option : command.options) {
      if (option.name != "--help")
        rows += fmt::format("| {} | {} |\n", code(usage_of(option)), cell(option.what));
    }
    if (!rows.empty()) page += "\n| option | meaning |\n|---|---|\n" + rows;
  }
  return page;
}

}  // namespace plekton::apps
