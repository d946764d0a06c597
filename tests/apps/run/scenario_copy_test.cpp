// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/scenario_copy.hpp"

#include "apps/scenario/toml_file.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plekton::apps::scenario_copy_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

Scenario example(const std::filesystem::path& file) {
  Scenario scenario;
  scenario.file = file;
  scenario.text = "[simulation]\nduration = \"1 s\"";  // without an end of the last line
  scenario.overrides = {"simulation.duration=2 s", "grains.sand.name=\"a\nb\""};
  return scenario;
}

TEST(ScenarioCopy, HasTheTextAsItWasReadAndThenWhatWasReplacedInIt) {
  const std::string copy = copy_of(example("/somewhere/case.toml"));

  EXPECT_THAT(copy, StartsWith("[simulation]\nduration = \"1 s\"\n# This is a copy of "
                               "/somewhere/case.toml as it was run."));
  EXPECT_THAT(copy, HasSubstr(" relative to /somewhere.\n# --set simulation.duration=2 s\n"));
}

TEST(ScenarioCopy, StaysTomlWithLineBreaksInWhatWasReplaced) {
  const std::string copy = copy_of(example("/some\nwhere/case.toml"));

  const Table table = parse_toml(copy, "copy");

  ASSERT_EQ(table.entries.size(), 1U);
  EXPECT_EQ(std::get<Table>(table.entries[0].value.data).entries.size(), 1U);
}

TEST(ScenarioCopy, LeavesAScenarioThatIsThatFileAsItIs) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / kScenarioCopy;
  test::write_bytes(file, "mine");

  write_scenario_copy(folder.path(), example(file));

  EXPECT_EQ(test::bytes_of(file), "mine");
}

}  // namespace
}  // namespace plekton::apps::scenario_copy_test
