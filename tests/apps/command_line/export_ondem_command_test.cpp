// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/checkpoints.hpp"
#include "apps/scenario/scenario_reader.hpp"
#include "apps/scene/build_scene.hpp"
#include "dynamics/ondem/read_ondem.hpp"
#include "tests/apps/command_line/command_fixture.hpp"

#include <cstring>

namespace plekton::apps::export_ondem_command_test {
namespace {

using testing::HasSubstr;

/// Three numbers of each row as they stand in a checkpoint, without the first nodes.
std::vector<double> rows_of(const geometry::StateTree& state, const std::string& name,
                            std::size_t first) {
  const auto& numbers = std::get<std::vector<double>>(state.arrays.at(name).numbers);
  return {numbers.begin() + static_cast<std::ptrdiff_t>(3 * first), numbers.end()};
}

std::vector<double> flat(const std::vector<geometry::Vec3>& vectors) {
  std::vector<double> numbers;
  for (const geometry::Vec3& v : vectors) numbers.insert(numbers.end(), v.data(), v.data() + 3);
  return numbers;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

class ExportOndemCommand : public Command {
 protected:
  void run() const {
    ASSERT_EQ(outcome_of({"run", scenario(), "--out", out(), "--quiet"}).exit_code, kDone);
  }
  std::string file() const { return (folder_ / "a.vtkhdf").string(); }
  Outcome exported(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"export-ondem", out()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return outcome_of(arguments);
  }
};

// Sheet and gravel of the fixture: 121 nodes of the sheet, then 20 grains.
TEST_F(ExportOndemCommand, WritesWhatTheLastCheckpointHoldsToTheLastBit) {
  run();
  const Outcome outcome = exported({"--out", file()});
  ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("a.vtkhdf: 20 spheres, 1 membranes"));

  const dynamics::OndemScene scene = dynamics::read_ondem(file());
  const geometry::StateTree state = last_checkpoint(out()).state;
  std::vector<geometry::Vec3> places, velocities, spins;
  for (const dynamics::OndemBody& body : scene.bodies) {
    places.push_back(body.position);
    velocities.push_back(body.velocity);
    spins.push_back(body.angular_velocity);
  }
  EXPECT_TRUE(same_bits(flat(places), rows_of(state, "nodes/position", 121)));
  EXPECT_TRUE(same_bits(flat(velocities), rows_of(state, "nodes/velocity", 121)));
  EXPECT_TRUE(same_bits(flat(spins), rows_of(state, "nodes/angular_velocity", 121)));
  EXPECT_EQ(scene.membranes.at(0).facets.size(), 200U);
  EXPECT_EQ(scene.planes.at(0).name, "floor");
  EXPECT_EQ(scene.state.hash(), state.hash());
}

TEST_F(ExportOndemCommand, MakesAFileThatAScenarioTakesWithTheSameBits) {
  run();
  ASSERT_EQ(exported({"--out", file()}).exit_code, kDone);
  const geometry::StateTree state = last_checkpoint(out()).state;
  const std::string again =
      "[simulation]\nduration = \"1 ms\"\n[materials.gravel]\ndensity = 2650\nyoung_modulus = "
      "2e7\nfriction_angle = 0.6\n[[membranes]]\nname = \"sheet\"\nondem = \"a.vtkhdf\"\nthickness "
      "= 0.002\nmaterial = \"gravel\"\nyoung_modulus = 5e7\nareal_mass = 0.3\n[[grains]]\nmaterial "
      "= \"gravel\"\nondem = \"a.vtkhdf\"\nondem_block = \"gravel\"\nondem_material = \"gravel\"\n";
  const BuiltScene built = build_scene(parse_scenario(again, folder_ / "again.toml", {}));

  const dynamics::NodeState& nodes = built.scene.state;
  EXPECT_EQ(built.scene.elements.facets.size(), 200U);
  EXPECT_TRUE(same_bits(flat(nodes.position), rows_of(state, "nodes/position", 0)));
  EXPECT_TRUE(same_bits(flat(nodes.velocity), rows_of(state, "nodes/velocity", 0)));
  test::write_bytes(folder_ / "again.toml", again);
  const Outcome check = outcome_of({"check", (folder_ / "again.toml").string()});
  EXPECT_EQ(check.exit_code, kDone) << check.err;
}

TEST_F(ExportOndemCommand, ReplacesNoFileButOneOfItsOwn) {
  run();
  test::write_bytes(file(), "mine");

  const Outcome refused = exported({"--out", file()});
  EXPECT_EQ(refused.exit_code, kFailed);
  EXPECT_THAT(refused.err, HasSubstr("a.vtkhdf: is there already and no ON-DEM file"));
  EXPECT_EQ(test::bytes_of(file()), "mine");

  std::filesystem::remove(file());
  EXPECT_EQ(exported({"--out", file()}).exit_code, kDone);
  EXPECT_EQ(exported({"--out", file()}).exit_code, kDone);
}

TEST_F(ExportOndemCommand, SaysInOneLineWhatIsWrong) {
  const auto expect_refused = [](const Outcome& outcome, const std::string& message) {
    EXPECT_EQ(outcome.exit_code, kFailed);
    EXPECT_THAT(outcome.err, HasSubstr(message));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  expect_refused(exported(), "there is no such folder");
  expect_refused(exported({"--out", "a.vtk"}), "expected a file that ends in .vtkhdf");
  run();
  expect_refused(exported({"--at", "soon"}), "--at");
  expect_refused(exported({"--at", "0 s"}), "its first checkpoint comes after 0 s");
  expect_refused(exported({"--at", "5 s"}),
                 "--at: got \"5 s\"; expected times up to the last checkpoint of the run, which is "
                 "of 0.02 s");
  expect_refused(exported({"--out", "/no/such/a.vtkhdf"}), "/no/such/a.vtkhdf");
}

}  // namespace
}  // namespace plekton::apps::export_ondem_command_test
