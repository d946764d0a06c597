// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/set_paths.hpp"

#include "apps/scenario/overrides.hpp"
#include "apps/scenario/toml_file.hpp"

#include <gmock/gmock.h>

#include <string_view>

namespace plekton::apps::set_paths_test {
namespace {

using testing::Contains;
using testing::Not;

constexpr std::string_view kScenario = R"([simulation]
duration = 1
[materials.stone]
[[membranes]]
name = "sheet"
shape = { kind = "tube", radius = 1 }
[[loads]]
name = "a name of words"
kind = "gravity"
[[loads]]
name = "top"
kind = "force"
)";

TEST(SetPaths, AreThoseOfTheTablesThatAreThere) {
  const std::vector<std::string> paths = set_paths(parse_toml(kScenario, "case.toml"));

  EXPECT_THAT(paths, Contains("simulation.duration"));
  EXPECT_THAT(paths, Contains("materials.stone.density"));
  EXPECT_THAT(paths, Contains("membranes.sheet.thickness"));
  EXPECT_THAT(paths, Not(Contains(testing::StartsWith("grains"))));
}

TEST(SetPaths, GoByTheKindsOfTables) {
  const std::vector<std::string> paths = set_paths(parse_toml(kScenario, "case.toml"));

  EXPECT_THAT(paths, Contains("membranes.sheet.shape.length"));
  EXPECT_THAT(paths, Not(Contains("membranes.sheet.shape.pattern")));
  EXPECT_THAT(paths, Contains("loads.top.total_force"));
  EXPECT_THAT(paths, Not(Contains("loads.0.total_force")));
}

TEST(SetPaths, CallTablesByNumberWhereTheNameIsNoPlainWord) {
  EXPECT_THAT(set_paths(parse_toml(kScenario, "case.toml")), Contains("loads.0.factor"));
}

TEST(SetPaths, AreTakenByTheOverrides) {
  const Table scenario = parse_toml(kScenario, "case.toml");

  for (const std::string& path : set_paths(scenario)) {
    Table changed = scenario;
    const std::vector<std::string> options{path + "=1"};
    EXPECT_NO_THROW(apply_overrides(changed, options)) << path;
  }
}

}  // namespace
}  // namespace plekton::apps::set_paths_test
