// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid bodies, as the user of the program meets them.
#include "apps/run/rigid_motions.hpp"

#include "tests/apps/command_line/command_fixture.hpp"

#include <gmock/gmock.h>

#include <map>
#include <sstream>
#include <string>

namespace plekton::apps::rigid_motions_test {
namespace {

using testing::HasSubstr;

/// A block of 1 kg that falls, and a clump of two spheres that rolls on a floor.
constexpr std::string_view kBodies = R"([simulation]
duration = "20 ms"
time_step = "10 us"
[materials.stone]
density = "2500 kg/m3"
young_modulus = "1 MPa"
friction_angle = "30 deg"
[[rigid_bodies]]
name = "block"
shape = { kind = "box", size = [0.1, 0.1, 0.1] }
translate = [1, 1, 1]
thickness = "2 mm"
material = "stone"
mass = "1 kg"
angular_velocity = [0, 0, "10 rad/s"]
[[rigid_bodies]]
name = "dumbbell"
spheres = [{ centre = [0, 0, 0], radius = "1 cm" }, { centre = [0, "15 mm", 0], radius = "1 cm" }]
translate = [0, 0, "1 cm"]
material = "stone"
density = "2500 kg/m3"
velocity = ["1 m/s", 0, 0]
[[planes]]
name = "floor"
point = [0, 0, 0]
material = "stone"
[output]
history_interval = "1 ms"
interval = "10 ms"
)";

class RigidBodyRuns : public Command {
 protected:
  RigidBodyRuns() { test::write_bytes(folder_ / "bodies.toml", std::string(kBodies)); }
  std::string bodies() const { return (folder_ / "bodies.toml").string(); }
};

/// The numbers of the last row of a CSV file, by the names of their columns.
std::map<std::string, double> last_row(const std::string& text) {
  std::istringstream lines(text);
  std::string head, line, last;
  std::getline(lines, head);
  while (std::getline(lines, line)) last = line;
  std::map<std::string, double> row;
  std::istringstream names(head), numbers(last);
  for (std::string name, number;
       std::getline(names, name, ',') && std::getline(numbers, number, ',');)
    row[name] = std::stod(number);
  return row;
}

/// A bar across a slope of 20 degrees, as gravity has it, on which it rolls without slip. The
/// bounces with which it begins are 0.2 um high.
constexpr std::string_view kRoller = R"([simulation]
duration = "0.2 s"
gravity = [3.355217606, 0, -9.218384668]
[materials.steel]
density = "7800 kg/m3"
young_modulus = "10 GPa"
friction_angle = "40 deg"
[[rigid_bodies]]
name = "roller"
shape = { kind = "chain", points = [[0, "-10 cm", "5 cm"], [0, "10 cm", "5 cm"]], divisions = 2 }
thickness = "10 cm"
material = "steel"
density = "7800 kg/m3"
[[planes]]
name = "floor"
point = [0, 0, 0]
material = "steel"
)";

// A solid cylinder has two thirds of the acceleration of what slides without friction.
TEST_F(RigidBodyRuns, RollDownAsABarDoes) {
  const std::string file = (folder_ / "roller.toml").string();
  test::write_bytes(file, std::string(kRoller));
  const std::string out = (folder_ / "roller").string();
  ASSERT_EQ(outcome_of({"run", file, "--quiet", "--out", out}).exit_code, 0);

  const auto row = last_row(test::bytes_of(out + "/rigid_bodies.csv"));
  const double time = row.at("time (s)");
  const double speed = 2.0 / 3.0 * 3.355217606 * time;
  EXPECT_NEAR(row.at("roller.velocity_x (m/s)"), speed, 1e-3 * speed);
  EXPECT_NEAR(row.at("roller.position_x (m)"), 0.5 * speed * time, 0.5e-3 * speed * time);
  EXPECT_NEAR(row.at("roller.angular_velocity_y (rad/s)"), speed / 0.05, 1e-3 * speed / 0.05);
}

TEST_F(RigidBodyRuns, SayWhatTheBodiesWeigh) {
  const Outcome outcome = outcome_of({"check", bodies()});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("rigid body block: mass 1 kg, centre (1.05, 1.05, 1.05) m, "
                                     "principal moments of inertia 0.001667, 0.001667, 0.001667 "
                                     "kg m2, a solid of the volume"));
  EXPECT_THAT(outcome.out, HasSubstr("rigid body dumbbell: mass"));
  EXPECT_THAT(outcome.out, HasSubstr("box of rigid_bodies.dumbbell:"));
}

// A free fall: v = g t at the half step before the end, and a turn of 10 rad/s.
TEST_F(RigidBodyRuns, WriteHowTheBodiesMove) {
  const Outcome outcome = outcome_of({"run", bodies(), "--out", out()});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  auto row = last_row(test::bytes_of(folder_ / "out/rigid_bodies.csv"));
  EXPECT_NEAR(row["block.velocity_z (m/s)"], -9.81 * (0.02 - 5e-6), 1e-9);
  EXPECT_NEAR(row["block.turn_z (rad)"], 0.2, 1e-12);
  EXPECT_EQ(row["block.force_z (N)"], 0.0);
  EXPECT_GT(row["dumbbell.force_z (N)"], 0.0);
  EXPECT_LT(row["dumbbell.velocity_x (m/s)"], 1.0);
}

TEST_F(RigidBodyRuns, GoOnFromACheckpointToTheLastBit) {
  const Outcome run =
      outcome_of({"run", bodies(), "--out", out(), "--set", "output.checkpoint_interval=5 ms"});
  ASSERT_EQ(run.exit_code, 0) << run.err;

  const Outcome outcome = outcome_of({"verify", out()});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

}  // namespace
}  // namespace plekton::apps::rigid_motions_test
