// SPDX-License-Identifier: GPL-3.0-or-later
// What a stage lets go or brings in while it is strained, beside bodies for which the step was chosen.
#include "tests/apps/command_line/program_fixture.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <ostream>
#include <string>

namespace plekton::apps::let_go_test {
namespace {

constexpr const char* kHead = R"([simulation]
gravity = [0, 0, 0]
[materials.m]
young_modulus = "10 MPa"
friction_angle = "20 deg"
density = 2500
[[planes]]
point = [0, 0, -1]
material = "m"
[output]
interval = "1 s"
history_interval = "1 ms"
)";
/// Slow and large: the step that is chosen for it is far too long for what comes.
constexpr const char* kBig = R"([[grains]]
name = "big"
material = "m"
radius = "20 cm"
centres = [[0, 0, 5]]
velocity = ["10 mm/s", 0, 0]
)";
constexpr const char* kSheet = R"(
name = "b"
shape = { kind = "sheet", width = "1 m", length = "1 m", cells = [4, 4] }
mode = "continuum"
thickness = "1 mm"
material = "m"
density = 1000
young_modulus = "100 MPa"
prestrain = "1 %"
)";
constexpr const char* kBar = R"([[membranes]]
name = "b"
shape = { kind = "chain", points = [[0, 0, 0], [1, 0, 0]], divisions = 2 }
mode = "truss"
thickness = "20 mm"
material = "m"
density = 1000
young_modulus = "1 GPa"
prestrain = "1 %"
hold = "rim"
)";
constexpr const char* kClump = R"([[rigid_bodies]]
name = "clump"
material = "m"
density = 2500
spheres = [{ centre = [0, 0, -0.991], radius = "1 cm" }, { centre = [0.015, 0, -0.985], radius = "1 cm" }]
hold = "xyz"
hold_rotation = "xyz"
)";
constexpr const char* kPair = R"([[grains]]
name = "small"
material = "m"
radius = "1 cm"
centres = [[0, 0, 0], [0, 0, 0.0195]]
)";
constexpr const char* kFirst = R"([[stages]]
name = "first"
end = { duration = "50 ms" }
)";
constexpr const char* kThen = R"([[stages]]
name = "then"
end = { duration = "20 ms" }
)";

struct Case {
  const char* name;
  std::string scenario;
  double
      closure;  ///< of all that is stored: the automatic step is good for a few percent of a blow

  friend void PrintTo(const Case& item, std::ostream* out) { *out << item.name; }
};

std::string text(std::initializer_list<std::string> parts) {
  std::string all = kHead;
  for (const std::string& part : parts) all += part;
  return all;
}

const std::vector<Case> kCases{
    {"ABarThatIsLetGo",
     text({kBar, kFirst, kThen, "free = [{ membrane = \"b\", nodes = \"x_max\" }]\n"}), 2e-3},
    {"ASheetThatIsLetGo",
     text({kBig, "[[membranes]]", kSheet, "hold = \"all\"\n", kFirst, kThen,
           "free = [{ membrane = \"b\", nodes = \"all\" }]\n"}),
     5e-3},
    {"ASheetThatComes", text({kBig, kFirst, kThen, "[[stages.membranes]]", kSheet}), 5e-3},
    {"GrainsThatAreLetGo",
     text({kBig, kPair, kFirst, "fix = [{ grains = \"small\" }]\n", kThen,
           "free = [{ grains = \"small\" }]\n"}),
     3e-2},
    {"ARigidBodyThatIsLetGo",
     text({kBig, kClump, kFirst, kThen, "free = [{ rigid_body = \"clump\" }]\n"}), 3e-2}};

class LetGo : public testing::TestWithParam<Case> {};

TEST_P(LetGo, MakesNoEnergy) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "case.toml", GetParam().scenario);

  const Outcome outcome = outcome_of(
      {"run", (folder / "case.toml").string(), "--quiet", "--out", (folder / "out").string()});

  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto report = nlohmann::json::parse(test::bytes_of(folder / "out/run.json"));
  EXPECT_LT(report["energy_closure"].get<double>(), GetParam().closure);
}

std::string name_of(const testing::TestParamInfo<Case>& item) {
  return item.param.name;
}

INSTANTIATE_TEST_SUITE_P(Of, LetGo, testing::ValuesIn(kCases), name_of);

/// Its nodes are not turned by anything: contacts would spin them, and friction be gone.
TEST(LetGo, LeavesNodesOfATrussThatWereNeverHeldAsTheyAre) {
  const test::TemporaryFolder folder;
  const std::string scene = std::string(kHead) + R"([[membranes]]
name = "b"
shape = { kind = "sheet", width = "0.4 m", length = "0.4 m", cells = [4, 4] }
mode = "truss"
thickness = "10 mm"
material = "m"
density = 1000
young_modulus = "100 MPa"
hold = "rim"
[[grains]]
name = "g"
material = "m"
radius = "40 mm"
centres = [[0.02, 0.01, 0.0445]]
velocity = ["0.5 m/s", "0.3 m/s", 0]
)" + kFirst + kThen;
  const std::string free =
      "free = [{ membrane = \"b\", nodes = { min = [-0.19, -0.19, -1], max = [0.19, 0.19, 1] } "
      "}]\n";
  std::vector<std::string> energies;
  for (const std::string& end : {std::string(), free}) {
    test::write_bytes(folder / "case.toml", scene + end);
    const Outcome outcome =
        outcome_of({"run", (folder / "case.toml").string(), "--quiet", "--overwrite", "--set",
                    "simulation.time_step=0.2 ms", "--out", (folder / "out").string()});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    energies.push_back(test::bytes_of(folder / "out/energy.csv"));
  }

  EXPECT_EQ(energies[1], energies[0]);
}

}  // namespace
}  // namespace plekton::apps::let_go_test
