// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that move far in a step, as the user of the program meets them.
#include "dynamics/time_step/motion_step.hpp"
#include "tests/apps/command_line/command_fixture.hpp"

#include <gmock/gmock.h>

namespace plekton::apps::motion_test {
namespace {

using testing::HasSubstr;

class FastMotion : public Command {};

TEST_F(FastMotion, ShortensTheStepThatIsChosenAndSaysSo) {
  const std::vector<std::string> arguments = {"run",   scenario(),
                                              "--out", out(),
                                              "--set", "grains.gravel.velocity=[0, 0, -100]",
                                              "--set", "simulation.duration=1 ms"};

  const Outcome outcome = outcome_of(arguments);

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("of the smallest radius in each"));
  EXPECT_LE(report()["largest_motion_ratio"], dynamics::kLargestMotion * (1.0 + 1e-12));
}

TEST_F(FastMotion, IsWarnedOfWhereTheStepIsGiven) {
  const std::vector<std::string> arguments = {"run",   scenario(),
                                              "--out", out(),
                                              "--set", "grains.gravel.velocity=[0, 0, -400]",
                                              "--set", "simulation.duration=1 ms",
                                              "--set", "simulation.time_step=2 us"};

  const Outcome outcome = outcome_of(arguments);

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("warning: the fastest node moves by"));
  EXPECT_EQ(report()["timing"]["time_step_s"], 2e-6);
}

// A ball is dropped and comes to its highest point again, where nothing is left but its weight.
TEST_F(FastMotion, OfASphereEndsAtItsTimeWithAnErrorOverWhatWentThrough) {
  test::write_bytes(folder_ / "ball.toml", R"([simulation]
duration = "0.2 s"
[materials.rock]
density = 2650
young_modulus = "10 MPa"
friction_angle = "30 deg"
[[grains]]
material = "rock"
count = 1
radius = "5 cm"
box = { min = [-0.051, -0.051, 0.01], max = [0.051, 0.051, 0.1102] }
[[planes]]
point = [0, 0, 0]
material = "rock"
)");

  const Outcome outcome = outcome_of({"run", (folder_ / "ball.toml").string(), "--out", out()});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_NEAR(report()["timing"]["simulated_time_s"], 0.2, 1e-15);
  EXPECT_LT(report()["energy_closure"], 0.05);
}

// Soft on the scale of its weight: the critical step is longer than it takes to fall by a radius.
TEST_F(FastMotion, OfBouldersOnASheetOfTenKilometresDoesNotDiverge) {
  geometry::write_mesh_file(folder_ / "sheet.off", geometry::plane_sheet({1e4, 1e4, 20, 20}));
  test::write_bytes(folder_ / "large.toml", R"([simulation]
duration = "60 s"
[materials.stone]
density = "2650 kg/m3"
young_modulus = "1 MPa"
friction_angle = "35 deg"
[[membranes]]
mesh = "sheet.off"
thickness = "20 m"
young_modulus = "10 MPa"
density = "1000 kg/m3"
material = "stone"
hold = "rim"
[[grains]]
material = "stone"
count = 20
radius = "100 m"
box = { min = [-1500, -1500, 200], max = [1500, 1500, 1200] }
velocity = [0, 0, "-50 m/s"]
)");

  const Outcome outcome = outcome_of({"run", (folder_ / "large.toml").string(), "--out", out()});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_LT(report()["energy_closure"], 1e-3);
  EXPECT_LE(report()["largest_motion_ratio"], dynamics::kLargestMotion * (1.0 + 1e-12));
}

}  // namespace
}  // namespace plekton::apps::motion_test
