// SPDX-License-Identifier: GPL-3.0-or-later
// What ends a run before its duration is over, and what is said of servos.
#include "apps/run/checkpoints.hpp"
#include "apps/run/stage_watch.hpp"
#include "tests/apps/command_line/program_fixture.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace plekton::apps::stop_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// A ball on a floor, under a lid 1 mm above it that comes down.
constexpr const char* kBall = R"([simulation]
duration = "0.1 s"
time_step = "5 us"
damping = 0.3
gravity = [0, 0, 0]
[materials.steel]
density = "2000 kg/m3"
young_modulus = "1 MPa"
friction_angle = 0
[[grains]]
name = "ball"
material = "steel"
radius = "10 mm"
centres = [[0, 0, "10 mm"]]
[[planes]]
name = "floor"
point = [0, 0, 0]
material = "steel"
[[planes]]
name = "lid"
point = [0, 0, "21 mm"]
normal = [0, 0, -1]
material = "steel"
[[output.reactions]]
kind = "plane"
plane = "floor"
)";
constexpr const char* kMoved = R"([[loads]]
name = "down"
kind = "motion"
plane = "lid"
velocity = [0, 0, "-0.1 m/s"]
)";
constexpr const char* kPressed = R"([[loads]]
name = "press"
kind = "servo"
plane = "lid"
force = "3 N"
speed = "0.1 m/s"
)";

/// A blade that turns about z against two balls, each before a wall.
constexpr const char* kBlade = R"([simulation]
duration = "0.2 s"
time_step = "2 us"
gravity = [0, 0, 0]
[materials.steel]
density = "2000 kg/m3"
young_modulus = "10 MPa"
friction_angle = "26 deg"
[[grains]]
name = "balls"
material = "steel"
radius = "10 mm"
centres = [["40 mm", "12.1 mm", 0], ["-40 mm", "-12.1 mm", 0]]
[[planes]]
name = "back"
point = [0, "22.2 mm", 0]
normal = [0, -1, 0]
material = "steel"
[[planes]]
name = "front"
point = [0, "-22.2 mm", 0]
normal = [0, 1, 0]
material = "steel"
[[rigid_bodies]]
name = "blade"
shape = { kind = "polygon", points = [["-60 mm", 0, "-30 mm"], ["60 mm", 0, "-30 mm"], ["60 mm", 0, "30 mm"], ["-60 mm", 0, "30 mm"]] }
thickness = "4 mm"
material = "steel"
mass = "0.5 kg"
hold = "xyz"
hold_rotation = "xy"
[[loads]]
name = "turn"
kind = "servo"
rigid_body = "blade"
torque = "0.4 N m"
about = "z"
angular_speed = "1 rad/s"
[stop]
servo = { load = "turn", tolerance = "0.1 %" }
)";

class Stop : public testing::Test {
 protected:
  Outcome run(const std::string& text, const std::string& out,
              const std::vector<std::string>& more = {}) const {
    test::write_bytes(folder_ / "case.toml", text);
    std::vector<std::string> arguments = {"run", (folder_ / "case.toml").string(), "--quiet",
                                          "--out", (folder_ / out).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Program(arguments).wait();
  }
  json report(const std::string& out) const {
    return json::parse(test::bytes_of(folder_ / (out + "/run.json")));
  }
  /// s, when a run has ended that had to end well.
  double end_of(const std::string& out) const { return report(out)["timing"]["simulated_time_s"]; }
  json ended(const std::string& text) const {
    const Outcome outcome = run(text, "run", {"--overwrite"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return report("run");
  }

  test::TemporaryFolder folder_;
};

constexpr double kLooks = 16 * 5e-6;  // s, between two

TEST_F(Stop, EndsByADisplacementOrAStrain) {
  const json moved = ended(std::string(kBall) + kMoved +
                           "[stop]\ndisplacement = { plane = \"lid\", distance = \"0.5 mm\" }\n");
  EXPECT_EQ(moved["stopped_by"], "displacement");
  EXPECT_EQ(moved["status"], "finished");
  EXPECT_NEAR(end_of("run"), 5e-3, kLooks + 5e-6);

  const json strained =
      ended(std::string(kBall) + kMoved +
            "[stop]\nstrain = { between = [\"floor\", \"lid\"], strain = 0.05 }\n");
  EXPECT_EQ(strained["stopped_by"], "strain");
  EXPECT_NEAR(end_of("run"), 0.05 * 21e-3 / 0.1, kLooks + 5e-6);
}

// It never ended: the point of a container stays where its wall closes.
TEST_F(Stop, EndsWhereAContainerHasBecomeNarrower) {
  const std::string cell = std::string(kBall) + R"([[planes]]
name = "cell"
kind = "cylinder"
point = [0, 0, 0]
radius = "30 mm"
material = "steel"
[[loads]]
name = "close"
kind = "servo"
plane = "cell"
pressure = "1 kPa"
between = ["floor", "lid"]
speed = "0.1 m/s"
)";
  const std::string end = "displacement = { plane = \"cell\", distance = \"0.5 mm\" }\n";

  EXPECT_EQ(ended(cell + "[stop]\n" + end)["stopped_by"], "displacement");
  EXPECT_NEAR(end_of("run"), 5e-3, kLooks + 5e-6);
  std::string staged = cell;
  staged.replace(staged.find("duration = \"0.1 s\"\n"), 19, "");
  for (const char* const name : {"first", "second"})
    staged +=
        "[[stages]]\nname = \"" + std::string(name) + "\"\nmax_duration = \"20 ms\"\nend." + end;
  ended(staged);
  EXPECT_NEAR(end_of("run"), 2 * 5e-3, 2 * (kLooks + 5e-6));
}

// k_n of a ball between planes is E R: 1e4 N/m, so that 2 N come 0.4 mm after the lid has touched.
TEST_F(Stop, EndsByAForceAtTenLooksInARow) {
  const json pressed =
      ended(std::string(kBall) + kMoved +
            "[stop]\nforce = { reaction = \"floor\", component = \"z\", below = \"-2 N\" }\n");
  EXPECT_EQ(pressed["stopped_by"], "force");
  EXPECT_NEAR(end_of("run"), 0.014 + 9 * kLooks, 1e-3);
}

TEST_F(Stop, EndsByAServoOrByTheUnbalancedForce) {
  const json pressed = ended(std::string(kBall) + kPressed +
                             "[stop]\nservo = { load = \"press\", tolerance = 0.001 }\n");
  EXPECT_EQ(pressed["stopped_by"], "servo");
  EXPECT_LT(end_of("run"), 0.1);
  EXPECT_THAT(pressed["warnings"].dump(), Not(HasSubstr("never came to bear")));

  const json still = ended(std::string(kBall) + kPressed + "[stop]\nunbalanced_force = 1e-3\n");
  EXPECT_EQ(still["stopped_by"], "unbalanced_force");
  EXPECT_EQ(still["status"], "at_rest");
  EXPECT_LT(end_of("run"), 0.1);
}

TEST_F(Stop, EndsARunThatGoesOnFromACheckpointWhereItWouldHaveEnded) {
  const std::string text =
      std::string(kBall) + kMoved +
      "[stop]\ndisplacement = { plane = \"lid\", distance = \"0.5 mm\" }\n"
      "force = { reaction = \"floor\", component = \"z\", below = \"-1 N\" }\n";
  ended(text);
  const std::string output = "[output]\ncheckpoint_interval = \"2 ms\"\n";
  std::string with_checkpoints = text;
  with_checkpoints.insert(with_checkpoints.find("[[output.reactions]]"), output);
  ASSERT_EQ(run(with_checkpoints, "long").exit_code, 0);
  fs::remove(folder_ / "long/run.json");
  fs::remove(checkpoints_of(folder_ / "long").back());

  const Outcome resumed =
      Program({"run", "--resume", (folder_ / "long").string(), "--quiet"}).wait();

  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(report("long")["stopped_by"], "displacement");
  EXPECT_EQ(end_of("long"), end_of("run"));
}

// The checkpoint was written before the look of its step, which a run that went on from it had not.
TEST_F(Stop, CountsTheLookOfTheStepThatACheckpointIsOf) {
  std::string text =
      std::string(kBall) + kMoved +
      "[stop]\nforce = { reaction = \"floor\", component = \"z\", below = \"-2 N\" }\n";
  // At every look: each 16 steps of 5 us.
  text.insert(text.find("[[output.reactions]]"),
              "[output]\ncheckpoint_interval = \"79.9999 us\"\n");
  ASSERT_EQ(run(text, "run").exit_code, 0);
  const double end = end_of("run");
  // Of the ten looks some are before this step, some after it.
  const std::string middle = "step_000000002768.h5";
  ASSERT_TRUE(fs::exists(folder_ / "run" / "checkpoints" / middle));
  for (const fs::path& file : checkpoints_of(folder_ / "run"))
    if (file.filename().string() > middle) fs::remove(file);

  const Outcome resumed =
      Program({"run", "--resume", (folder_ / "run").string(), "--quiet"}).wait();

  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(end_of("run"), end);
}

TEST_F(Stop, EndsByATorqueThatAServoReaches) {
  const json turned = ended(kBlade);
  EXPECT_EQ(turned["stopped_by"], "servo");
  EXPECT_LT(end_of("run"), 0.2);
  EXPECT_EQ(turned["status"], "finished");
}

TEST_F(Stop, IsRefusedWhereItsStrainHasNoDistance) {
  std::string text =
      std::string(kBall) + "[stop]\nstrain = { between = [\"floor\", \"lid\"], strain = 0.1 }\n";
  text.replace(text.find("\"21 mm\""), 7, "0");
  text.replace(text.find("\"10 mm\"]]"), 9, "\"-10 mm\"]]");
  EXPECT_THAT(run(text, "flat").err, HasSubstr("stop.strain.between: the two are at no distance"));
}

TEST_F(Stop, TellsOfAServoThatNeverReachesItsForce) {
  std::string text = std::string(kBall) + kPressed;
  text.replace(text.find("0.1 s"), 5, "5 ms");  // half of the way to the ball
  const json report = ended(text);
  EXPECT_THAT(
      report["warnings"].dump(),
      HasSubstr("never came to bear what it wanted: at the end it feels 0 N and wants 3 N"));
}

TEST_F(Stop, OfATorqueServoRefusesWhatDoesNotGoWithIt) {
  const auto refusal = [&](const std::string& old, const std::string& now) {
    std::string text(kBlade);
    text.replace(text.find(old), old.size(), now);
    const Outcome outcome = run(text, "wrong");
    EXPECT_EQ(outcome.exit_code, 1);
    return outcome.err;
  };
  EXPECT_THAT(refusal("about = \"z\"", "about = \"z\"\nforce = 1"),
              HasSubstr("loads.turn.force: does not go with torque"));
  EXPECT_THAT(refusal("about = \"z\"", "direction = \"z\""),
              HasSubstr("loads.turn.direction: does not go with torque"));
  EXPECT_THAT(refusal("about = \"z\"\n", ""), HasSubstr("loads.turn.about: missing"));
  EXPECT_THAT(refusal("hold_rotation = \"xy\"", "hold_rotation = \"xyz\""),
              HasSubstr("leave that free for the servo"));
  EXPECT_FALSE(fs::exists(folder_ / "wrong"));
}

}  // namespace
}  // namespace plekton::apps::stop_test
