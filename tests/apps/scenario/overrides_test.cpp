// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/overrides.hpp"

#include "apps/scenario/toml_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plekton::apps::overrides_test {
namespace {

using testing::HasSubstr;

constexpr std::string_view kFile = R"(
[simulation]
duration = "2 s"
[[grains]]
name = "sand"
count = 10
[[grains]]
name = "gravel"
count = 20
)";

Table with(const std::vector<std::string>& options) {
  Table table = parse_toml(kFile, "file.toml");
  apply_overrides(table, options);
  return table;
}

std::string error_of(const std::vector<std::string>& options) {
  try {
    with(options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

const Value& duration_of(const Table& table) {
  return std::get<Table>(table.find("simulation")->value.data).find("duration")->value;
}

std::int64_t count_of(const Table& table, std::size_t number) {
  const Value& grains = std::get<Array>(table.find("grains")->value.data).at(number);
  return std::get<std::int64_t>(std::get<Table>(grains.data).find("count")->value.data);
}

// As of a program in Python: it is no text in UTF-16.
TEST(Overrides, TakeATextWithAByteOfZeroAsItIs) {
  const std::string text("simulation.duration=2\0s", 23);

  EXPECT_EQ(std::get<std::string>(duration_of(with({text})).data), std::string("2\0s", 3));
}

TEST(Overrides, ReplaceAValueAndBecomeItsPlace) {
  const Table table = with({"simulation.duration=3 s"});

  EXPECT_EQ(std::get<std::string>(duration_of(table).data), "3 s");
  EXPECT_EQ(to_string(duration_of(table).place), "--set simulation.duration=3 s");
}

TEST(Overrides, TakeTomlValuesToo) {
  EXPECT_EQ(std::get<std::string>(duration_of(with({"simulation.duration=\"3 s\""})).data), "3 s");
  EXPECT_EQ(std::get<double>(duration_of(with({"simulation.duration=0.5"})).data), 0.5);
  EXPECT_EQ(std::get<Array>(duration_of(with({"simulation.duration=[0, 1, 2]"})).data).size(), 3U);
}

TEST(Overrides, FindEntriesOfAListByNameAndByNumber) {
  EXPECT_EQ(count_of(with({"grains.gravel.count=7"}), 1), 7);
  EXPECT_EQ(count_of(with({"grains.0.count=8"}), 0), 8);
}

TEST(Overrides, OfTheSameKeyCountInTheirOrder) {
  EXPECT_EQ(count_of(with({"grains.0.count=8", "grains.0.count=9"}), 0), 9);
}

TEST(Overrides, MakeMissingTables) {
  const Table table = with({"output.interval=1 ms"});

  EXPECT_NE(std::get<Table>(table.find("output")->value.data).find("interval"), nullptr);
}

TEST(Overrides, WithoutPathOrValueAreRefusedByTheirText) {
  for (const char* option : {"simulation.duration", "=3", "simulation.duration="}) {
    EXPECT_THAT(error_of({option}),
                HasSubstr(std::string("--set ") + option + ": expected path=value"))
        << option;
  }
  EXPECT_THAT(error_of({"simulation..duration=3"}), HasSubstr("the path has an empty part"));
}

TEST(Overrides, ThatLeadNowhereAreRefusedAllAtOnce) {
  const std::string error =
      error_of({"grains.2.count=1", "grains.clay.count=1", "simulation.duration.x=1"});

  EXPECT_THAT(error, HasSubstr("--set grains.2.count=1: the list has 2 entries"));
  EXPECT_THAT(error, HasSubstr("--set grains.clay.count=1: the list has 2 entries"));
  EXPECT_THAT(error, HasSubstr("--set simulation.duration.x=1: there is no \"x\" in \"2 s\""));
}

TEST(Overrides, WithAnEndlessPathAreRefused) {
  std::string option = "a";
  for (int i = 0; i < 50'000; ++i) option += ".a";

  EXPECT_THAT(error_of({option + "=1"}), HasSubstr("the path has 50001 parts"));
}

TEST(Overrides, WithALineBreakAreATextAndAddNoTable) {
  const Table table = with({"simulation.duration=1\n[output]"});

  EXPECT_EQ(table.find("output"), nullptr);
  EXPECT_EQ(std::get<std::string>(duration_of(table).data), "1\n[output]");
}

}  // namespace
}  // namespace plekton::apps::overrides_test
