// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/stress/stress.hpp"

#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>

#include <sstream>

namespace plekton::stress::stress_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kScene = R"([simulation]
duration = 0.001
gravity = [0, 0, 0]
damping = 0.1
[materials.stone]
density = 2650
young_modulus = 1e7
friction_angle = 0.5
[[grains]]
name = "stones"
material = "stone"
radius = 0.01
centres = [[0, 0, 0.0101], [0.021, 0.004, 0.02]]
velocity = [0, 0, -1]
[[planes]]
name = "floor"
point = [0, 0, 0]
material = "stone"
[[loads]]
name = "drag"
kind = "mass_damping"
grains = "stones"
rate = 10
)";

TEST(Stress, CountsASoundScene) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "a.toml", kScene);
  StressOptions options;
  options.out = folder / "out";
  std::ostringstream log;
  const Tally tally = stress_file(folder / "a.toml", options, log);

  EXPECT_EQ(tally.scenes, 1U);
  EXPECT_EQ(tally.failed, 0U);
  EXPECT_EQ(log.str(), "");
  EXPECT_THAT(folder.names(), ElementsAre("a.toml"));
  EXPECT_THAT(table_of(tally), HasSubstr("mass_damping"));
}

/// The seeded defect needs a plane: what is left of the scene has it, and neither load nor damping.
TEST(Stress, WritesASceneThatFailsAndAsLittleOfItAsFails) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "a.toml", kScene);
  StressOptions options;
  options.out = folder / "out";
  options.disturb = [](dynamics::Simulation& simulation, Part part) {
    if (part != Part::two_threads || simulation.planes().empty()) return;
    simulation.set_velocity(geometry::id_at<geometry::NodeId>(0),
                            simulation.state().velocity[0] * (1.0 + 1e-15));
  };
  std::ostringstream log;
  const Tally tally = stress_file(folder / "a.toml", options, log);

  EXPECT_EQ(tally.failed, 1U);
  EXPECT_EQ(tally.faults[static_cast<std::size_t>(Fault::threads)], 1U);
  EXPECT_THAT(log.str(), HasSubstr("another state on 2 threads"));
  const std::string small = test::bytes_of(folder / "out/a_small.toml");
  EXPECT_THAT(small, HasSubstr("# threads: another state"));
  EXPECT_THAT(small, HasSubstr("[[planes]]"));
  EXPECT_THAT(small, Not(HasSubstr("[[loads]]")));
  EXPECT_THAT(small, Not(HasSubstr("damping")));
  options.disturb = nullptr;
  EXPECT_EQ(stress_file(folder / "out/a_small.toml", options, log).failed, 0U);
}

TEST(Stress, RunsAFewRandomScenes) {
  const test::TemporaryFolder folder;
  StressOptions options;
  options.out = folder / "out";
  options.scenes = 3;
  options.steps = 50;
  options.seed = 5;
  std::ostringstream log;
  const Tally tally = stress(options, log);

  EXPECT_EQ(tally.scenes, 3U);
  EXPECT_EQ(tally.failed, 0U) << log.str();
}

}  // namespace
}  // namespace plekton::stress::stress_test
