// SPDX-License-Identifier: GPL-3.0-or-later
// The list of keys against what the reader takes and what apps/scenario.md says.
#include "apps/scenario/key_list.hpp"

#include "apps/scenario/key_meanings.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace plekton::apps::key_list_test {
namespace {

using Words = std::set<std::string>;

const std::string& documentation() {
  static const std::string text =
      test::bytes_of(std::filesystem::path(PLEKTON_SOURCE_DIR) / "apps/scenario.md");
  return text;
}

/// The part of the documentation below a heading, as in "[[loads]]".
std::string section_of(const std::string& table) {
  const std::size_t begin = documentation().find("\n## " + table + "\n");
  if (begin == std::string::npos) return "";
  return documentation().substr(begin, documentation().find("\n## ", begin + 1) - begin);
}

/// The names of keys in code marks: `key`, `key = ...`.
Words names_in(const std::string& text) {
  Words names;
  const std::regex mark("`([a-z_]+)( = [^`]*)?`");
  for (std::sregex_iterator at(text.begin(), text.end(), mark), end; at != end; ++at)
    names.insert((*at)[1]);
  return names;
}

/// The cells of a row of a table; none in other lines.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  if (!line.starts_with("| ")) return cells;
  std::istringstream row(line.substr(1));
  for (std::string cell; std::getline(row, cell, '|');) cells.push_back(cell);
  return cells;
}

/// "sieves[].sieve" and "gas.exponent" to "sieves" and "gas".
std::string first_part(const std::string& path) {
  return path.substr(0, path.find_first_of(".["));
}

Words listed_in(const std::string& table, const std::string& kind = "") {
  Words names;
  for (const KeyGroup& group : scenario_keys()) {
    if (group.table != table || (!kind.empty() && group.kind != kind)) continue;
    for (const ListedKey& key : group.keys) names.insert(first_part(key.path));
  }
  return names;
}

TEST(KeyList, HasEveryTableOfTheDocumentation) {
  Words tables;
  for (const KeyGroup& group : scenario_keys()) tables.insert(group.table);

  EXPECT_EQ(tables,
            Words({"[simulation]", "[materials.NAME]", "[[contacts]]", "[[membranes]]",
                   "[[membranes]] shape", "[[rigid_bodies]]", "[[rigid_bodies]] shape",
                   "[[grains]]", "[[planes]]", "[[loads]]", "[output]", "[[output.reactions]]",
                   "[stop]", "[[stages]]", "[[ties]]", "[[ties]] to"}));
}

TEST(KeyList, HasNoKeyThatIsNotDocumented) {
  for (const KeyGroup& group : scenario_keys()) {
    const std::string table = group.table.substr(0, group.table.find(' ', 3));
    // Surfaces of rigid bodies are made and placed as membranes are.
    const std::string text =
        section_of(table) + (table == "[[rigid_bodies]]" ? section_of("[[membranes]]") : "");
    const Words names = names_in(text);
    for (const ListedKey& key : group.keys)
      EXPECT_TRUE(names.contains(first_part(key.path))) << group.table << ' ' << key.path;
    if (group.kind.empty()) continue;
    EXPECT_THAT(text, testing::HasSubstr("`\"" + group.kind + "\"`"));
  }
}

TEST(KeyList, HasEveryKeyOfTheTablesOfTheDocumentation) {
  for (const KeyGroup& group : scenario_keys()) {
    if (!group.kind.empty()) continue;
    Words listed = listed_in(group.table);
    // Of other laws than the first, and a table whose kinds are listed by themselves.
    if (group.table == "[[contacts]]")
      listed.insert(
          {"work_of_adhesion", "tensile_strength", "shear_strength", "rupture_distance", "bonds"});
    if (group.table == "[[membranes]]" || group.table == "[[rigid_bodies]]") listed.insert("shape");
    if (group.table == "[[ties]]") listed.insert("to");
    const std::string text = section_of(group.table);
    std::istringstream lines(text.substr(0, text.find("\n### ")));
    for (std::string line; std::getline(lines, line);) {
      const auto cells = cells_of(line);
      for (const std::string& name : cells.empty() ? Words{} : names_in(cells[0]))
        EXPECT_TRUE(listed.contains(name)) << group.table << ' ' << name;
    }
  }
}

TEST(KeyList, HasEveryKeyOfTheKindsOfTheDocumentation) {
  for (const auto& [table, heading] :
       {std::pair("[[loads]]", "[[loads]]"), std::pair("[[membranes]]", "[[membranes]] shape")}) {
    std::istringstream lines(section_of(table));
    int rows = 0;
    for (std::string line; std::getline(lines, line);) {
      const auto cells = cells_of(line);
      const std::regex kind(" `\"([a-z_]+)\"` ");
      std::smatch match;
      if (cells.size() < 2 || !std::regex_match(cells[0], match, kind)) continue;
      const Words listed = listed_in(heading, match[1]);
      if (listed.empty()) continue;  // the table of modes
      ++rows;
      for (const std::string& name : names_in(cells[1]))
        EXPECT_TRUE(listed.contains(name)) << match[1] << ' ' << name;
    }
    EXPECT_GE(rows, 7);
  }
}

/// "[[membranes]] shape" to "membranes[].shape."
std::string prefix_of(const std::string& table) {
  const bool is_list = table.starts_with("[[");
  const std::size_t end = table.find(']');
  std::string prefix = table.substr(is_list ? 2 : 1, end - (is_list ? 2 : 1));
  if (is_list) prefix += "[]";
  if (const std::size_t part = table.find(' '); part != std::string::npos)
    prefix += '.' + table.substr(part + 1);
  return prefix + '.';
}

TEST(KeyList, HasAMeaningOfEveryKeyAndNoneOfKeysThatAreNotThere) {
  std::set<std::string> listed;
  for (const KeyGroup& group : scenario_keys()) {
    for (const ListedKey& key : group.keys) {
      EXPECT_FALSE(key.what.empty()) << group.table << ' ' << key.path;
      listed.insert(prefix_of(group.table) + key.path);
    }
  }

  for (const KeyMeaning& meaning : key_meanings())
    EXPECT_TRUE(listed.contains(std::string(meaning.path))) << meaning.path;
}

/// A default without code marks and quotes; the same word for all of a limit that is not there.
std::string bare(std::string text) {
  std::erase_if(text, [](char c) { return c == '`' || c == '"'; });
  text.erase(0, text.find_first_not_of(' '));
  text.erase(text.find_last_not_of(' ') + 1);
  return text == "never" || text == "-" ? "none" : text;
}

TEST(KeyList, HasTheDefaultsOfTheDocumentationWhereTheseArePlainValues) {
  const std::regex plain(
      R"(required|none|true|false|auto|edge|[a-z]+ N|-?[0-9.]+|\[[-0-9., ]+\]|duration / \d+)");
  int compared = 0;
  for (const KeyGroup& group : scenario_keys()) {
    const std::string text = section_of(group.table);
    std::istringstream lines(text.substr(0, text.find("\n### ")));
    for (std::string line; std::getline(lines, line);) {
      const auto cells = cells_of(line);
      if (!group.kind.empty() || cells.size() != 4 || !std::regex_match(bare(cells[2]), plain))
        continue;
      const Words names = names_in(cells[0]);
      for (const ListedKey& key : group.keys) {
        if (!names.contains(key.path)) continue;
        ++compared;
        EXPECT_EQ(bare(key.standard), bare(cells[2])) << group.table << ' ' << key.path;
      }
    }
  }
  EXPECT_GT(compared, 40);
}

TEST(KeyList, HasUnitsRangesAndDefaults) {
  const auto key = [](const std::string& table, const std::string& kind, const std::string& path) {
    for (const KeyGroup& group : scenario_keys()) {
      if (group.table != table || group.kind != kind) continue;
      for (const ListedKey& listed : group.keys)
        if (listed.path == path) return listed.standard + "; " + kind_text(listed);
    }
    return std::string("not there");
  };

  EXPECT_EQ(key("[simulation]", "", "duration"), "required; time (s) above 0");
  for (const std::string table : {"[[membranes]]", "[[rigid_bodies]]"}) {
    EXPECT_EQ(key(table, "", "fill_holes"), "false; true or false");
    EXPECT_EQ(key(table, "", "wrap"), "false; true or false");
  }
  EXPECT_EQ(key("[[loads]]", "pressure", "gas.exponent"), "1; number without unit above 0");
  EXPECT_EQ(key("[[loads]]", "motion", "angular_velocity"), "-; 3 x angular velocity (rad/s)");
  EXPECT_EQ(key("[[loads]]", "motion", "grains"), "-; text");
  EXPECT_EQ(key("[[membranes]] shape", "box", "size"), "required; 3 x length (m) above 0");
  EXPECT_EQ(key("[[membranes]] shape", "box", "cells"), "[1, 1, 1]; 3 x whole number from 1");
  EXPECT_EQ(key("[[membranes]] shape", "tube", "cells"), "required; 2 x whole number from 3 and 1");
  EXPECT_EQ(key("[[membranes]]", "", "rotate.angle"),
            "required in rotate; angle (rad) from -360 deg to 360 deg");
  EXPECT_EQ(key("[[loads]]", "motion", "turn.point"), "required in turn; 3 x length (m)");
  EXPECT_EQ(key("[[loads]]", "gravity", "factor"),
            "required; pairs of time (s) and number without unit");
}

}  // namespace
}  // namespace plekton::apps::key_list_test
