// SPDX-License-Identifier: GPL-3.0-or-later
// What a stage does at its start, by the program as it is called: what it fixes, moves and brings, what
// of that is work from outside, and what cannot be.
#include "apps/run/checkpoints.hpp"
#include "dynamics/checkpoint/checkpoint_file.hpp"
#include "tests/apps/command_line/program_fixture.hpp"
#include "tests/support/temporary_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace plekton::apps::stage_starts_test {
namespace {

using testing::HasSubstr;

constexpr const char* kStone = R"(
[materials.stone]
young_modulus = "10 MPa"
friction_angle = "30 deg"
density = "2650 kg/m3"
[output]
interval = "10 ms"
)";
constexpr const char* kFloor = R"(
[[planes]]
name = "floor"
point = [0, 0, 0]
material = "stone"
)";

class StageStarts : public testing::Test {
 protected:
  Outcome run(const std::string& text) {
    test::write_bytes(folder_ / "case.toml", text);
    return outcome_of({"run", (folder_ / "case.toml").string(), "--quiet", "--out", out()});
  }
  std::string out() const { return (folder_ / "out").string(); }
  nlohmann::json report() const {
    return nlohmann::json::parse(test::bytes_of(folder_ / "out/run.json"));
  }
  /// z (m) of a row of positions at the end.
  double height_of(const std::string& array, std::size_t row) const {
    const geometry::StateTree state = dynamics::read_checkpoint(checkpoints_of(out()).back());
    return std::get<std::vector<double>>(state.arrays.at(array).numbers).at(3 * row + 2);
  }
  /// J, in the last row.
  double energy(const std::string& name) const {
    std::istringstream lines(test::bytes_of(folder_ / "out/energy.csv"));
    std::string head, line, last;
    std::getline(lines, head);
    while (std::getline(lines, line)) last = line;
    std::istringstream names(head), cells(last);
    for (std::string column, cell;
         std::getline(names, column, ','), std::getline(cells, cell, ',');)
      if (column == name + " (J)") return std::stod(cell);
    ADD_FAILURE() << name << " is no column of " << head;
    return 0.0;
  }

  test::TemporaryFolder folder_;
};

TEST_F(StageStarts, FixAndFreeInTheFirstStageToo) {
  const Outcome outcome = run(std::string(kStone) + R"(
[[grains]]
name = "kept"
material = "stone"
radius = "5 mm"
centres = [[0, 0, "50 mm"]]
[[grains]]
name = "loose"
material = "stone"
radius = "5 mm"
centres = [["50 mm", 0, "50 mm"]]
[[rigid_bodies]]
name = "freed"
spheres = [{ centre = ["100 mm", 0, "50 mm"], radius = "5 mm" }]
density = "1000 kg/m3"
material = "stone"
hold = "xyz"
hold_rotation = "xyz"
[[stages]]
name = "a"
fix = [{ grains = "kept" }]
free = [{ rigid_body = "freed" }]
end = { duration = "20 ms" }
)");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  // Spheres of rigid bodies come first, with the node that the body follows after them.
  const double way = 0.5 * 9.81 * 0.02 * 0.02;
  std::vector<double> heights;
  for (const std::size_t node : {0U, 1U, 2U, 3U})
    heights.push_back(height_of("nodes/position", node));
  const auto fallen = testing::DoubleNear(0.05 - way, 1e-4);
  EXPECT_THAT(heights, testing::UnorderedElementsAre(0.05, fallen, fallen, fallen));
}

// Where another structure comes in a later stage, what was stored between those of the first was
// told as energy that tracking had made.
TEST_F(StageStarts, TellNothingMadeByTrackingWhereStructuresTouchFromTheStart) {
  const auto chain = [](const char* name, const char* points) {
    return fmt::format(R"(name = "{}"
shape = {{ kind = "chain", points = {}, divisions = 3 }}
thickness = "10 mm"
material = "stone"
young_modulus = "10 MPa"
density = "1000 kg/m3"
)",
                       name, points);
  };
  const Outcome outcome =
      run(std::string(kStone) + "[simulation]\ngravity = [0, 0, 0]\n" + "[[membranes]]\n" +
          chain("lower", "[[-0.1, 0, 0], [0.1, 0, 0]]") + "[[membranes]]\n" +
          chain("upper", "[[0, -0.1, 0.009], [0, 0.1, 0.009]]") +
          "[[stages]]\nname = \"one\"\nend = { duration = \"0.2 ms\" }\n"
          "[[stages]]\nname = \"two\"\nend = { duration = \"0.2 ms\" }\n"
          "[[stages.membranes]]\n" +
          chain("later", "[[0, 0, 1], [0.2, 0, 1]]"));

  ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;
  const double stored = 0.5 * 10e6 * 0.005 * 1e-3 * 1e-3;  // J, E r of a contact 1 mm deep
  EXPECT_LE(std::abs(energy("tracking")), 1e-3 * stored);
  EXPECT_LE(report()["energy_closure"], 0.01);
}

TEST_F(StageStarts, TakeOutNoGrainsBeforeTheFirst) {
  const Outcome outcome = run(std::string(kStone) + R"(
[[grains]]
name = "all"
material = "stone"
radius = "5 mm"
centres = [[0, 0, "50 mm"]]
[[stages]]
name = "a"
remove = [{ grains = "all", above = "10 mm" }]
end = { duration = "20 ms" }
)");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err,
              HasSubstr("stages.a.remove: no grains have been there before the first"));
}

/// By the words that say where it stood at first.
TEST_F(StageStarts, MoveAPlaneBackToWhereItOnceWas) {
  const Outcome outcome = run(std::string(kStone) + R"(
[simulation]
gravity = [0, 0, 0]
[[planes]]
name = "lid"
point = [0, 0, "100 mm"]
normal = [0, 0, -1]
material = "stone"
[[grains]]
name = "far"
material = "stone"
radius = "5 mm"
centres = [[0, 0, "50 mm"]]
[[stages]]
name = "down"
end = { duration = "5 ms" }
[[stages.loads]]
name = "go"
kind = "motion"
plane = "lid"
velocity = [0, 0, -1]
[[stages]]
name = "stay"
end = { duration = "5 ms" }
remove = [{ load = "go" }]
[[stages]]
name = "back"
end = { duration = "5 ms" }
[[stages.planes]]
name = "lid"
point = [0, 0, "100 mm"]
)");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(height_of("planes/point", 0), 0.1);
}

/// A container goes on as wide as it is where a stage says its point, and where it is where one says
/// its radius.
TEST_F(StageStarts, MoveAContainerInWhatTheySayOfIt) {
  const Outcome outcome = run(std::string(kStone) + R"(
[simulation]
gravity = [0, 0, 0]
[[planes]]
name = "cell"
kind = "cylinder"
point = [0, 0, 0]
radius = "50 mm"
material = "stone"
[[grains]]
name = "one"
material = "stone"
radius = "5 mm"
centres = [[0, 0, "50 mm"]]
[[stages]]
name = "close"
end = { duration = "5 ms" }
[[stages.loads]]
name = "close"
kind = "servo"
plane = "cell"
force = "1 N"
speed = 1
[[stages]]
name = "up"
end = { duration = "5 ms" }
remove = [{ load = "close" }]
[[stages.planes]]
name = "cell"
point = [0, 0, "30 mm"]
[[stages.loads]]
name = "go"
kind = "motion"
plane = "cell"
velocity = [0, 0, 1]
[[stages]]
name = "open"
end = { duration = "5 ms" }
remove = [{ load = "go" }]
[[stages.planes]]
name = "cell"
radius = "60 mm"
)");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto radius_after = [&](std::size_t stages) {
    const geometry::StateTree state = dynamics::read_checkpoint(checkpoints_of(out()).at(stages));
    return std::get<std::vector<double>>(state.arrays.at("planes/radius").numbers).at(0);
  };
  const std::size_t last = checkpoints_of(out()).size() - 1;
  EXPECT_NEAR(radius_after(last - 2), 0.045, 1e-3);
  EXPECT_EQ(radius_after(last - 1), radius_after(last - 2));
  EXPECT_EQ(radius_after(last), 0.06);
  EXPECT_NEAR(height_of("planes/point", 0), 0.035, 1e-3);
}

/// A grain that comes 0.1 mm deep in the floor flies off with what that has stored: with k = E r of a
/// sphere on a plane, 1/2 E r d² = 2.5e-4 J.
TEST_F(StageStarts, CountWhatComesTouchingAsWorkFromOutside) {
  const Outcome outcome = run(std::string(kStone) + kFloor + R"(
[simulation]
gravity = [0, 0, 0]
time_step = "0.2 us"
[[grains]]
name = "far"
material = "stone"
radius = "5 mm"
centres = [["50 mm", 0, "50 mm"]]
[[stages]]
name = "a"
end = { duration = "0.1 ms" }
[[stages]]
name = "b"
end = { duration = "1 ms" }
[[stages.grains]]
name = "pressed"
material = "stone"
radius = "5 mm"
centres = [[0, 0, "4.9 mm"]]
)");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NEAR(energy("kinetic"), 2.5e-4, 1e-3 * 2.5e-4);
  EXPECT_NEAR(energy("external_work"), energy("kinetic"), 1e-3 * energy("kinetic"));
  EXPECT_LT(report().at("energy_closure").get<double>(), 1e-3);
}

/// A grain at rest on a rigid box of facets becomes ten times as stiff.
TEST_F(StageStarts, CountAnotherStiffnessAsWorkFromOutside) {
  const Outcome outcome = run(std::string(kStone) + R"(
[simulation]
damping = 0.3
time_step = "2 us"
[[rigid_bodies]]
name = "table"
shape = { kind = "box", size = [0.1, 0.1, 0.01] }
translate = [-0.05, -0.05, -0.011]
material = "stone"
thickness = 0.002
hold = "xyz"
hold_rotation = "xyz"
[[grains]]
name = "grain"
material = "stone"
radius = "20 mm"
centres = [[0, 0, "19.999 mm"]]
[[stages]]
name = "a"
end = { duration = "60 ms" }
[[stages]]
name = "b"
end = { duration = "5 ms" }
materials.stone.young_modulus = "100 MPa"
)");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_GT(energy("external_work"), 0.0);
  EXPECT_LT(report().at("energy_closure").get<double>(), 2e-3);
}

/// A box that friction holds on a slope of 20 degrees slides where it is 5: what its springs have stored
/// goes into friction, once.
TEST_F(StageStarts, LoseOnceWhatLessFrictionLetsGo) {
  const Outcome outcome = run(std::string(kStone) + kFloor + R"(
[simulation]
gravity = [3.355, 0, -9.218]
time_step = "5 us"
[[rigid_bodies]]
name = "block"
shape = { kind = "box", size = [0.1, 0.1, 0.02] }
translate = [-0.05, -0.05, "0.999 mm"]
thickness = "2 mm"
density = "2650 kg/m3"
material = "stone"
[[contacts]]
between = "stone"
and = "stone"
law = "hertz_mindlin"
[[stages]]
name = "a"
simulation.damping = 0.3
end = { duration = "40 ms" }
[[stages]]
name = "b"
simulation.damping = 0
end = { duration = "0.1 ms" }
materials.stone.friction_angle = "5 deg"
)");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_GT(energy("friction"), 0.0);
  EXPECT_NEAR(energy("closure_error"), 0.0, 1e-2 * energy("friction"));
}

// A clump that comes in a stage was lost at once: it lay outside of where all began.
TEST_F(StageStarts, LoseNoClumpThatComesFarAbove) {
  const Outcome outcome = run(std::string(kStone) + kFloor + R"(
[simulation]
gravity = [0, 0, -9.81]
[[grains]]
name = "ball"
material = "stone"
radius = "1 cm"
centres = [[0, 0, "5 cm"]]
[[stages]]
name = "a"
end = { duration = "5 ms" }
[[stages]]
name = "b"
end = { duration = "5 ms" }
[[stages.rigid_bodies]]
name = "clump"
spheres = [{ centre = [0, 0, "60 cm"], radius = "1 cm" }]
material = "stone"
density = "2650 kg/m3"
)");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, Not(HasSubstr("lost")));
}

TEST_F(StageStarts, GoOnFromAnotherRunWithTheLoadsOfTheirFile) {
  test::write_bytes(folder_ / "case.toml", std::string(kStone) + R"(
[simulation]
gravity = [0, 0, 0]
time_step = "10 us"
[[grains]]
name = "ball"
material = "stone"
radius = "5 mm"
centres = [[0, 0, 0]]
[[loads]]
name = "push"
kind = "force"
grains = "ball"
force = [0, 0, "1 mN"]
[[stages]]
name = "a"
end = { duration = "1 ms" }
[[stages]]
name = "b"
end = { duration = "1 ms" }
)");
  const std::string file = (folder_ / "case.toml").string();
  ASSERT_EQ(outcome_of({"run", file, "--quiet", "--until", "a", "--out", out() + "1"}).exit_code,
            0);
  const Outcome outcome = outcome_of({"run", file, "--quiet", "--from", "a", out() + "1", "--set",
                                      "loads.push.force=[0, 0, '3 mN']", "--out", out()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  // v = (1 + 3) mN ms / m, a step of the change apart.
  const double mass = 2650.0 * 4.0 / 3.0 * 3.14159265358979324 * 125e-9;
  EXPECT_NEAR(energy("kinetic"), 0.5 * 16e-12 / mass, 0.03 * 0.5 * 16e-12 / mass);
}

/// Bodies that are held, or moved by loads, have no mass.
TEST_F(StageStarts, EndByAStrainBetweenPlatens) {
  const std::string platen = R"(
shape = { kind = "box", size = [0.1, 0.1, 0.01] }
thickness = "2 mm"
material = "stone"
hold_rotation = "xyz"
)";
  const Outcome outcome = run(std::string(kStone) + "[simulation]\ntime_step = \"10 us\"\n" +
                              "[[rigid_bodies]]\nname = \"top\"\ntranslate = [0, 0, 0.1]" + platen +
                              "[[rigid_bodies]]\nname = \"bottom\"\nhold = \"xyz\"" + platen + R"(
[[grains]]
name = "ball"
material = "stone"
radius = "5 mm"
centres = [[1, 0, 0]]
[[loads]]
name = "down"
kind = "motion"
rigid_body = "top"
velocity = [0, 0, -1]
[[stages]]
name = "a"
end = { strain = { between = ["top", "bottom"], strain = 0.01 } }
max_duration = "1 s"
)");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NEAR(report().at("stages").at(0).at("end_s").get<double>(), 1e-3, 2e-4);
}

TEST_F(StageStarts, AreRefusedWhereWhatComesIsBehindAPlaneOrInAnother) {
  const std::string text = std::string(kStone) + kFloor + R"(
[[grains]]
name = "first"
material = "stone"
radius = "5 mm"
centres = [[0, 0, "5 mm"], ["-50 mm", 0, "5 mm"]]
[[stages]]
name = "a"
end = { duration = "1 ms" }
[[stages]]
name = "b"
end = { duration = "1 ms" }
)";
  const Outcome behind = run(text + R"([[stages.grains]]
name = "second"
material = "stone"
radius = "5 mm"
centres = [["50 mm", 0, "-6 mm"]]
)");
  EXPECT_EQ(behind.exit_code, 1);
  EXPECT_THAT(behind.err, HasSubstr("stages.b: at its start grains.second: 1 of its grains begins "
                                    "behind planes.floor"));
  std::filesystem::remove_all(out());
  const Outcome within = run(text + R"([[stages.rigid_bodies]]
name = "ball"
shape = { kind = "sphere", radius = "10 mm", subdivisions = 2 }
translate = [0, 0, "5 mm"]
thickness = "1 mm"
material = "stone"
density = "1000 kg/m3"
[[stages.planes]]
name = "floor"
point = [0, 0, "20 mm"]
)");
  EXPECT_EQ(within.exit_code, 1);
  EXPECT_THAT(within.err, HasSubstr("stages.b: at its start "));
  std::filesystem::remove_all(out());
  // The grain at the origin stays in front of a floor that turns about it, one 50 mm beside does not.
  const Outcome turned = run(text + R"([[stages.planes]]
name = "floor"
normal = [1, 0, 1]
)");
  EXPECT_EQ(turned.exit_code, 1);
  EXPECT_THAT(turned.err, HasSubstr("stages.b: at its start grains.first: 1 of its grains begins "
                                    "behind planes.floor"));
}

TEST_F(StageStarts, NameTheStageThatHasAProblemAndTheDurationOnce) {
  const std::string text = std::string(kStone) + R"(
[[rigid_bodies]]
name = "lid"
shape = { kind = "box", size = [0.1, 0.1, 0.01] }
thickness = 0.002
density = "1000 kg/m3"
material = "stone"
[[loads]]
name = "push"
kind = "force"
rigid_body = "lid"
force = [0, 0, "1 N"]
[[stages]]
name = "a"
end = { duration = "1 ms" }
[[stages]]
name = "b"
)";
  const Outcome gone =
      run(text + "remove = [{ rigid_body = \"lid\" }]\nend = { duration = \"1 ms\" }\n");
  EXPECT_EQ(gone.exit_code, 1);
  EXPECT_THAT(gone.err, HasSubstr("stages.b: loads.push.rigid_body: \"lid\" is not there in this"));
  const Outcome none = run(text + "end = { duration = 0 }\n");
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_THAT(none.err, HasSubstr("stages.b.end.duration"));
  EXPECT_THAT(none.err, testing::Not(HasSubstr("simulation.duration")));
}

TEST_F(StageStarts, AreRefusedWithAStrainBetweenBodiesAtOnePlace) {
  const Outcome outcome = run(std::string(kStone) + R"(
[[rigid_bodies]]
name = "inner"
shape = { kind = "sphere", radius = "10 mm", subdivisions = 1 }
thickness = "1 mm"
density = "1000 kg/m3"
material = "stone"
[[rigid_bodies]]
name = "outer"
shape = { kind = "sphere", radius = "20 mm", subdivisions = 1 }
thickness = "1 mm"
density = "1000 kg/m3"
material = "stone"
[[stages]]
name = "a"
end = { strain = { between = ["inner", "outer"], strain = 0.01 } }
max_duration = "1 ms"
)");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("there is no length to compare with"));
}

/// A scene and an interval within which it is computed again.
struct Again {
  const char* scene;
  const char* from;
  const char* to;
};
std::ostream& operator<<(std::ostream& out, const Again& again) {
  return out << again.scene;
}

class ComputedAgain : public testing::TestWithParam<Again> {};

/// What chose the step was made from bodies where they were when a stage began.
TEST_P(ComputedAgain, HasTheSameBits) {
  const test::TemporaryFolder folder;
  const std::string scene = std::string("tests/apps/run/scenes/") + GetParam().scene + ".toml";
  const std::string out = (folder / "out").string();
  ASSERT_EQ(outcome_of({"run", scene, "--quiet", "--out", out}).exit_code, 0);
  const Outcome verified =
      outcome_of({"verify", out, "--interval", GetParam().from, GetParam().to});
  EXPECT_EQ(verified.exit_code, 0) << verified.out << verified.err;
}

INSTANTIATE_TEST_SUITE_P(Scenes, ComputedAgain,
                         testing::Values(Again{"stretched_stages", "41.1 ms", "65 ms"},
                                         Again{"turned_clump_stages", "100 ms", "150 ms"},
                                         Again{"sand_in_box", "0.2 s", "0.39 s"}),
                         [](const auto& again) { return std::string(again.param.scene); });

}  // namespace
}  // namespace plekton::apps::stage_starts_test
