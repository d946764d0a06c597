// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/broken_at_start.hpp"

#include "apps/run/run.hpp"
#include "apps/scenario/scenario_reader.hpp"

#include <gmock/gmock.h>

namespace plekton::apps::broken_at_start_test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr std::string_view kScenario = R"([simulation]
duration = "10 ms"
[materials.m]
young_modulus = "1 GPa"
friction_angle = "20 deg"
[[membranes]]
name = "net"
shape = { kind = "chain", points = [[0, 0, 0], [1, 0, 0], [1, 1, 0]] }
mode = "lattice"
thickness = "20 mm"
material = "m"
density = 1000
young_modulus = "1 GPa"
strength = "10 MPa"
hold = { min = [-1, -1, -1], max = [0, 1, 1] }
[[membranes]]
name = "sheet"
shape = { kind = "sheet", width = 1, length = 1, cells = [2, 2] }
translate = [5, 0, 0]
mode = "continuum"
thickness = "5 mm"
material = "m"
density = 1000
young_modulus = "10 MPa"
hold = "rim"
)";

PreparedRun prepared(std::string_view scenario, const std::vector<std::string>& overrides) {
  return prepare_run(parse_scenario(scenario, "case.toml", overrides));
}
std::vector<std::string> warnings_of(const std::vector<std::string>& overrides) {
  return prepared(kScenario, overrides).built.warnings;
}

TEST(BrokenAtStart, IsWarnedOf) {
  EXPECT_THAT(warnings_of({"membranes.sheet.prestrain=1 %", "membranes.sheet.strength=50 kPa"}),
              Contains(AllOf(HasSubstr("facets of \"sheet\" break at the start: prestrain"),
                             HasSubstr("8 of the 8"))));
  EXPECT_THAT(warnings_of({"membranes.net.prestrain=2 %"}),
              Contains(HasSubstr("2 of the 2 bars of \"net\" break at the start")));
  EXPECT_THAT(warnings_of({"membranes.net.prestrain=0.5 %"}),
              Not(Contains(HasSubstr("break at the start"))));
}

/// Nothing is left that a step could be chosen for: that is not what is wrong.
TEST(BrokenAtStart, IsSaidInsteadOfThatNoStepCanBeChosen) {
  constexpr std::string_view kNet = kScenario.substr(0, kScenario.rfind("[[membranes]]"));
  try {
    prepared(kNet, {"membranes.net.prestrain=2 %"});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("2 of the 2 bars of \"net\" break at the start"));
  }
}

}  // namespace
}  // namespace plekton::apps::broken_at_start_test
