// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_ondem_source.hpp"

#include "apps/scenario/scenario_reader.hpp"
#include "apps/scene/build_scene.hpp"
#include "dynamics/ondem/write_ondem.hpp"
#include "tests/support/ondem_scene.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

namespace plekton::apps::read_ondem_source_test {
namespace {

using dynamics::OndemScene;
using testing::HasSubstr;
using testing::ThrowsMessage;

template <class Value>
bool same_bits(const Value& a, const Value& b) {
  return std::memcmp(&a, &b, sizeof(Value)) == 0;
}

class OndemSource : public testing::Test {
 protected:
  OndemSource() { write(test::ondem_scene()); }
  void write(const OndemScene& scene) const { dynamics::write_ondem(folder_ / "a.vtkhdf", scene); }

  Scenario scenario(const std::string& tables) const {
    return parse_scenario(
        "[simulation]\nduration = 1\n[materials.sand]\ndensity = 2650\nyoung_modulus = 1e7\n"
        "friction_angle = 0.5\n" +
            tables,
        folder_ / "case.toml", {});
  }
  static std::string grains(const std::string& more = "") {
    return "[[grains]]\nmaterial = \"sand\"\nondem = \"a.vtkhdf\"\n" + more;
  }
  static std::string membrane(const std::string& more = "") {
    return "[[membranes]]\nname = \"net\"\nondem = \"a.vtkhdf\"\nmaterial = \"sand\"\n"
           "thickness = 0.002\nyoung_modulus = 1e9\ndensity = 1000\n" +
           more;
  }
  void expect_refused(const std::string& tables, const std::string& message) const {
    EXPECT_THAT([&] { scenario(tables); }, ThrowsMessage<InputError>(HasSubstr(message)));
  }

  test::TemporaryFolder folder_;
};

TEST_F(OndemSource, MakesGrainsOfTheSpheresToTheLastBit) {
  // A speed of 1e300 m/s, of the file of the reader's test, is no start of a scene.
  OndemScene ondem = test::ondem_scene();
  ondem.bodies[0].velocity = {0.1, 1.0 / 3.0, -0.0};
  write(ondem);
  const BuiltScene built = build_scene(scenario(grains()));

  ASSERT_EQ(built.scene.elements.spheres.size(), 1U);  // the members of the clump are left out
  const dynamics::OndemBody& body = ondem.bodies.front();
  EXPECT_TRUE(same_bits(built.scene.elements.spheres[0].radius, body.radius));
  EXPECT_TRUE(same_bits(built.scene.state.position[0], body.position));
  EXPECT_TRUE(same_bits(built.scene.state.velocity[0], body.velocity));
  EXPECT_TRUE(same_bits(built.scene.state.angular_velocity[0], body.angular_velocity));
  EXPECT_TRUE(same_bits(built.scene.state.orientation[0].coeffs(), body.orientation.coeffs()));
}

TEST_F(OndemSource, TakesThoseOfABlockAndAMaterialAlone) {
  EXPECT_EQ(scenario(grains("ondem_block = \"sand\"\nondem_material = \"material 10\"\n"))
                .grains[0]
                .centres.size(),
            1U);
  expect_refused(grains("ondem_block = \"pairs\"\n"), "no free spheres there, but 2 bodies");
  expect_refused(grains("ondem_material = \"material 3\"\n"), "no free spheres there");
}

TEST_F(OndemSource, SaysWhichBlocksAndMaterialsThereAre) {
  expect_refused(grains("ondem_block = \"gravel\"\n"),
                 "ondem_block: there is no block \"gravel\" in the file; there are \"sand\"");
  expect_refused(grains("ondem_material = \"gravel\"\n"), "there is no material \"gravel\"");
}

TEST_F(OndemSource, LetsTheScenarioSayHowGrainsMove) {
  const Scenario read = scenario(grains("velocity = [1, 2, 3]\n"));

  EXPECT_TRUE(read.grains[0].velocities.empty());
  EXPECT_EQ(read.grains[0].velocity, geometry::Vec3(1, 2, 3));
  EXPECT_EQ(read.grains[0].angular_velocities.size(), 1U);
}

TEST_F(OndemSource, RefusesWhatSaysTheSameTwice) {
  expect_refused(grains("radius = 1\n"), "the file of ondem has the places and radii");
  expect_refused(grains("table = \"a.csv\"\n"), "leave one of them out");
  expect_refused(grains("count = 3\n"), "ondem says where each grain is");
  expect_refused(grains("velocities = [[0, 0, 0]]\n"), "ondem says that of each grain");
  expect_refused(membrane("mesh = \"a.off\"\n"), "ondem: has the shape already");
}

TEST_F(OndemSource, MakesAMembraneOfFacetsAndBars) {
  const BuiltScene built = build_scene(scenario(membrane()));

  const dynamics::OndemMembrane net = test::ondem_scene().membranes.front();
  ASSERT_EQ(built.scene.state.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(same_bits(built.scene.state.position[i], net.position[i]));
    EXPECT_TRUE(same_bits(built.scene.state.velocity[i], net.velocity[i]));
  }
  EXPECT_EQ(built.scene.elements.facets.size(), 1U);
  EXPECT_EQ(built.scene.elements.cylinders.size(), 4U);  // three sides and a bar
}

TEST_F(OndemSource, LeavesOutNodesWithoutElements) {
  OndemScene ondem = test::ondem_scene();
  ondem.membranes[0].facets.clear();
  ondem.membranes[0].facet_radius.clear();
  ondem.membranes[0].cylinders = {{2, 3}};
  ondem.membranes[0].cylinder_radius = {0.001};
  write(ondem);
  const BuiltScene built = build_scene(scenario(membrane()));

  ASSERT_EQ(built.scene.state.size(), 2U);
  EXPECT_EQ(built.scene.state.position[0], ondem.membranes[0].position[2]);
  EXPECT_EQ(built.scene.elements.cylinders.size(), 1U);
}

TEST_F(OndemSource, AsksWhichMembraneOfSeveral) {
  OndemScene ondem = test::ondem_scene();
  ondem.membranes.push_back(ondem.membranes.front());
  ondem.membranes.back().name = "sheet";
  write(ondem);

  expect_refused(membrane(), "the file has 2 membranes, \"net\", \"sheet\"; say which one");
  expect_refused(membrane("ondem_membrane = \"cloth\"\n"), "there is no membrane \"cloth\"");
  EXPECT_EQ(scenario(membrane("ondem_membrane = \"sheet\"\n")).membranes.size(), 1U);
}

TEST_F(OndemSource, SaysInOneProblemWhatIsWrongWithAFile) {
  expect_refused("[[grains]]\nmaterial = \"sand\"\nondem = \"b.vtkhdf\"\n", "b.vtkhdf");
  test::write_bytes(folder_ / "a.vtkhdf", "x,y,z,r\n");
  try {
    scenario(grains());
    FAIL() << "it was read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a.vtkhdf: is no whole HDF5 file"));
    EXPECT_EQ(std::strchr(error.what(), '\n'), nullptr) << error.what();
  }
}

}  // namespace
}  // namespace plekton::apps::read_ondem_source_test
