// SPDX-License-Identifier: GPL-3.0-or-later
// What stages do to loads of before, to what these move, and to the step.
#include "apps/run/checkpoints.hpp"
#include "apps/viewer/run_folder.hpp"
#include "tests/apps/command_line/stages_fixture.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace plekton::apps::stages_loads_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class StagesWithLoads : public Stages {
 protected:
  /// All values of a column of a history; none if there is no such column, or two.
  std::vector<double> column(const std::string& out, const std::string& file,
                             const std::string& name) const {
    std::vector<std::vector<double>> found;
    for (const RecordedHistory& history : read_histories(in(out)))
      for (const RecordedHistory::Column& one : history.columns)
        if (history.file == file && one.name == name) found.push_back(one.values);
    return found.size() == 1 ? found[0] : std::vector<double>{};
  }
};

/// A plate that a servo presses onto the floor, with a force that comes slowly.
constexpr const char* kPress = R"([simulation]
gravity = [0, 0, 0]
time_step = "0.1 ms"
[materials.rock]
density = "2650 kg/m3"
young_modulus = "10 MPa"
friction_angle = "30 deg"
[[planes]]
name = "floor"
point = [0, 0, 0]
material = "rock"
[[rigid_bodies]]
name = "plate"
shape = { kind = "box", size = [0.1, 0.1, 0.02] }
translate = [0, 0, 0.0021]
thickness = "4 mm"
material = "rock"
density = "2000 kg/m3"
hold = "xy"
hold_rotation = "xyz"
[output]
reactions_interval = "25 ms"
[[output.reactions]]
name = "floor"
kind = "plane"
plane = "floor"
[[stages]]
name = "wait"
end = { duration = "0.2 s" }
[[stages]]
name = "press"
end = { duration = "0.1 s" }
[[stages.loads]]
name = "press"
kind = "servo"
rigid_body = "plate"
direction = "-z"
force = "10 N"
speed = "0.2 m/s"
factor = [["0 s", 0], ["0.2 s", 1]]
)";

// That of a servo of a rigid body counted from the start of the run: all of its force at once.
TEST_F(StagesWithLoads, CountFactorsOfServosFromTheStageThatNamesThem) {
  const Outcome outcome = run(write("press.toml", kPress), "press");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;

  const std::vector<double> force = column("press", "reactions.csv", "floor.force_z");

  ASSERT_FALSE(force.empty());
  // 5 N after 0.1 s of 0.2 s, and as much less as the servo is late: a few of its steps.
  EXPECT_NEAR(force.back(), -5.0, 0.1);
}

/// A grain below a lid that comes down with 1 m/s.
constexpr const char* kLid = R"([simulation]
[materials.sand]
density = "1500 kg/m3"
young_modulus = "5 MPa"
friction_angle = "30 deg"
[[grains]]
name = "sand"
material = "sand"
radius = "5 mm"
centres = [[0, 0, "5 mm"]]
[[planes]]
name = "floor"
point = [0, 0, 0]
material = "sand"
[[planes]]
name = "lid"
point = [0, 0, "60 mm"]
normal = [0, 0, -1]
material = "sand"
[[loads]]
name = "down"
kind = "motion"
plane = "lid"
velocity = [0, 0, "-1 m/s"]
[output]
history_interval = "1 ms"
[[stages]]
name = "a"
end = { duration = "5 ms" }
[[stages]]
name = "b"
end = { duration = "3 ms" }
)";

// It was thrown back to where its load would have moved it, 15 mm in a step.
TEST_F(StagesWithLoads, MoveAPlaneOnFromWhereTheyPlaceIt) {
  const std::string moved = "[[stages.planes]]\nname = \"lid\"\npoint = [0, 0, \"40 mm\"]\n";
  const Outcome outcome = run(write("lid.toml", kLid + moved), "lid");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;

  const std::vector<double> times = column("lid", "planes.csv", "time");
  const std::vector<double> heights = column("lid", "planes.csv", "lid.point_z");

  ASSERT_FALSE(times.empty());
  ASSERT_EQ(heights.size(), times.size());
  // 40 mm less 1 m/s over the second stage, whose start is the end of a step at 5 ms.
  const double step = column("lid", "energy.csv", "time_step").back();  // s
  EXPECT_NEAR(heights.back(), 0.040 - (times.back() - 0.005), step);
}

// It leapt to where the other motion would have brought it.
TEST_F(StagesWithLoads, GoOnFromAnotherRunOnlyWithItsMotions) {
  const std::string file = write("lid.toml", kLid);
  ASSERT_EQ(run(file, "first", {"--until", "a"}).exit_code, 0);

  const auto go_on = [&](const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"--from", "a", in("first")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(file, out, arguments);
  };
  EXPECT_EQ(go_on("same", {}).exit_code, 0);
  const Outcome faster = go_on("faster", {"--set", "loads.down.velocity=[0, 0, -2]"});
  EXPECT_EQ(faster.exit_code, 1);
  EXPECT_THAT(faster.err, HasSubstr("stages.a: loads.down moves otherwise than in the run"));
  EXPECT_FALSE(fs::exists(folder_ / "faster"));
}

/// Grains of which the highest are drawn aside.
constexpr const char* kHighest = R"([simulation]
gravity = [0, 0, 0]
time_step = "10 us"
[materials.sand]
density = "1500 kg/m3"
young_modulus = "5 MPa"
friction_angle = "30 deg"
[[grains]]
name = "sand"
material = "sand"
radius = "4 mm"
centres = [[0, 0, "10 mm"], [0, 0, "20 mm"], [0, 0, "30 mm"], ["20 mm", 0, "30 mm"]]
[[loads]]
name = "pull"
kind = "motion"
grains = "sand"
nodes = "z_max"
velocity = ["1 m/s", 0, 0]
[output]
history_interval = "1 ms"
[[stages]]
name = "a"
end = { duration = "2 ms" }
[[stages]]
name = "b"
end = { duration = "2 ms" }
)";

// The next ones became the side, and were thrown to where the load would have moved them.
TEST_F(StagesWithLoads, DoNotTakeOtherGrainsForASideThatIsGone) {
  const std::string all = "remove = [{ grains = \"sand\", above = \"25 mm\" }]\n";
  const std::string one =
      "remove = [{ grains = \"sand\", box = { min = [0.01, -1, 0.025], max = [1, 1, 1] } }]\n";
  const std::string both =
      "remove = [{ grains = \"sand\", above = \"25 mm\" }, { load = \"pull\" }]\n";

  const Outcome gone = run(write("gone.toml", kHighest + all), "gone");
  EXPECT_EQ(gone.exit_code, 1);
  EXPECT_THAT(gone.err, HasSubstr("stages.b: takes out all of the grains of \"sand\" that "
                                  "loads.pull names by their side; take it out too"));
  EXPECT_EQ(run(write("some.toml", kHighest + one), "some").exit_code, 0);
  EXPECT_EQ(run(write("both.toml", kHighest + both), "both").exit_code, 0);
}

// One column for it with a volume and one without.
TEST_F(StagesWithLoads, HaveOneColumnOfAPressureThatGetsAGas) {
  const Outcome outcome = run(write("cell.toml", R"([simulation]
[materials.rubber]
young_modulus = "5 MPa"
friction_angle = "30 deg"
[[membranes]]
name = "ball"
shape = { kind = "sphere", radius = "5 cm", subdivisions = 1 }
mode = "continuum"
young_modulus = "2 MPa"
thickness = "2 mm"
areal_mass = "2 kg/m2"
material = "rubber"
[[loads]]
name = "cell"
kind = "pressure"
membrane = "ball"
pressure = "1 kPa"
[output]
history_interval = "1 ms"
[[stages]]
name = "a"
end = { duration = "3 ms" }
[[stages]]
name = "b"
end = { duration = "3 ms" }
[[stages.loads]]
name = "cell"
gas = {}
)"),
                              "cell");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;

  const std::vector<double> pressures = column("cell", "pressures.csv", "cell.pressure");
  const std::vector<double> volumes = column("cell", "pressures.csv", "cell.volume");

  ASSERT_FALSE(pressures.empty());
  ASSERT_EQ(pressures.size(), volumes.size());
  EXPECT_TRUE(std::ranges::all_of(pressures, [](double p) { return p > 0.0; }));
  EXPECT_TRUE(std::isnan(volumes.front()));
  EXPECT_GT(volumes.back(), 0.0);
}

/// Two grains that fall onto a floor, and what stages are asked for.
std::string falling(const std::string& simulation, const std::string& stages) {
  return "[simulation]\n" + simulation + R"([materials.sand]
density = "2650 kg/m3"
young_modulus = "10 MPa"
friction_angle = "30 deg"
[[grains]]
name = "sand"
material = "sand"
radius = "5 mm"
centres = [[0, 0, "6 mm"], ["11 mm", 0, "6 mm"]]
[[planes]]
name = "floor"
point = [0, 0, 0]
material = "sand"
)" + stages;
}

std::string stage(const std::string& name, const std::string& duration) {
  return "[[stages]]\nname = \"" + name + "\"\nend = { duration = \"" + duration + "\" }\n";
}

// The step was that of the short stage from then on, however the scene changed.
TEST_F(StagesWithLoads, ThatAreShorterThanAStepDoNotShortenThoseOfLaterStages) {
  const std::string usual = write("usual.toml", falling("", stage("a", "5 ms")));
  const std::string brief =
      write("brief.toml", falling("", stage("a", "1 us") + stage("b", "5 ms")));
  ASSERT_EQ(run(usual, "usual").exit_code, 0);
  ASSERT_EQ(run(brief, "brief").exit_code, 0);

  EXPECT_NEAR(report("brief")["timing"]["steps"].get<double>(),
              report("usual")["timing"]["steps"].get<double>(), 1.0);
}

// A stage without a step replaced the checkpoint at the end of the one before.
TEST_F(StagesWithLoads, EndAtACheckpointOfTheirOwnHoweverShortTheyAre) {
  const std::string file = write(
      "zero.toml", falling("", stage("a", "2 ms") + stage("b", "10 ns") + stage("c", "1 ms")));
  ASSERT_EQ(run(file, "zero").exit_code, 0);

  EXPECT_EQ(checkpoints_of(in("zero")).size(), 3U);
  EXPECT_EQ(run(file, "again", {"--from", "a", in("zero")}).exit_code, 0);
}

TEST_F(StagesWithLoads, ThatAreShorterThanTheStepThatIsGivenAreRefusedByCheck) {
  const std::string file = write(
      "long.toml", falling("time_step = \"50 us\"\n", stage("a", "1 ms") + stage("b", "20 us")));

  const Outcome outcome = Program({"check", file}).wait();

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("stages.b: simulation.time_step of 5e-05 s is longer than the "
                                     "stage, which ends after 2e-05 s at the latest"));
}

}  // namespace
}  // namespace plekton::apps::stages_loads_test
