// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/toml_text.hpp"

#include "apps/scenario/scenario_reader.hpp"
#include "apps/scenario/toml_file.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

namespace plekton::apps::toml_text_test {
namespace {

using testing::HasSubstr;

/// Whether values are the same, bit by bit, wherever they come from.
bool same(const Value& a, const Value& b);

bool same(const Table& a, const Table& b) {
  return std::equal(
      a.entries.begin(), a.entries.end(), b.entries.begin(), b.entries.end(),
      [](const Entry& x, const Entry& y) { return x.key == y.key && same(x.value, y.value); });
}

bool same(const Value& a, const Value& b) {
  if (a.data.index() != b.data.index()) return false;
  if (const auto* table = std::get_if<Table>(&a.data)) return same(*table, std::get<Table>(b.data));
  if (const auto* array = std::get_if<Array>(&a.data))
    return std::equal(array->begin(), array->end(), std::get<Array>(b.data).begin(),
                      std::get<Array>(b.data).end(),
                      [](const Value& x, const Value& y) { return same(x, y); });
  if (const auto* number = std::get_if<double>(&a.data)) {
    const double other = std::get<double>(b.data);
    return (*number == other && std::signbit(*number) == std::signbit(other)) ||
           (std::isnan(*number) && std::isnan(other));
  }
  if (const auto* text = std::get_if<std::string>(&a.data))
    return *text == std::get<std::string>(b.data);
  if (const auto* whole = std::get_if<std::int64_t>(&a.data))
    return *whole == std::get<std::int64_t>(b.data);
  return std::get<bool>(a.data) == std::get<bool>(b.data);
}

Value value(decltype(Value::data) data) {
  Value made;
  made.data = std::move(data);
  return made;
}

Entry entry(const std::string& key, decltype(Value::data) data) {
  return {key, {}, value(std::move(data))};
}

Array list(std::initializer_list<decltype(Value::data)> entries) {
  Array array;
  for (const auto& data : entries) array.push_back(value(data));
  return array;
}

TEST(TomlText, ReadsBackAsTheSameTables) {
  Table table;
  table.entries = {
      entry("a", std::int64_t{1}),
      entry("b", list({1.5, -0.0, 1e300, std::string("x")})),
      entry("simulation",
            Table{{entry("duration", std::string("1 s")),
                   entry("deep", Table{{entry("list", list({Table{{entry("x", true)}},
                                                            Table{{entry("x", false)}}})),
                                        entry("empty", Table{})}})}}),
      entry("materials", Table{{entry("with a dot.", Table{})}}),
      entry("grains", list({Table{{entry("n", std::int64_t{-3})}}, Table{}})),
      entry("none", Array{})};

  const Table read = parse_toml(to_toml(table), "text");

  // A plain list stands before the tables.
  std::rotate(table.entries.begin() + 2, table.entries.end() - 1, table.entries.end());
  EXPECT_TRUE(same(read, table)) << to_toml(table);
}

TEST(TomlText, KeepsEveryBitOfANumberAndWhetherItIsWhole) {
  for (const double number :
       {0.1, 1.0 / 3.0, 5e-324, 1.7976931348623157e308, 2.0, -0.0, 1e22,
        std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
        std::numeric_limits<double>::quiet_NaN()}) {
    const Table table{{entry("x", number)}};
    EXPECT_TRUE(same(parse_toml(to_toml(table), "text"), table)) << to_toml(table);
  }
  for (const std::int64_t number : {std::numeric_limits<std::int64_t>::min(), std::int64_t{0},
                                    std::numeric_limits<std::int64_t>::max()}) {
    const Table table{{entry("x", number)}};
    EXPECT_TRUE(same(parse_toml(to_toml(table), "text"), table)) << to_toml(table);
  }
}

TEST(TomlText, KeepsEveryCharacterOfTextsAndKeys) {
  std::string text = "\"quoted\" \\ ü\n\ttab\r";
  for (char c = 1; c < 0x20; ++c) text += c;
  text += '\x7f';
  const Table table{{entry(text, text), entry("", std::string())}};

  EXPECT_TRUE(same(parse_toml(to_toml(table), "text"), table)) << to_toml(table);
}

TEST(TablesThatWereMade, AreReadAsAFileWouldBe) {
  const Table table{{entry("simulation", Table{{entry("dration", 1.0)}})}};
  try {
    scenario_from(table, "made");
    FAIL() << "read a scenario without a duration";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr(": simulation.dration: unknown key; did you mean \"duration\"?"));
    EXPECT_THAT(error.what(), HasSubstr(": simulation.duration: missing"));
  }
}

}  // namespace
}  // namespace plekton::apps::toml_text_test
