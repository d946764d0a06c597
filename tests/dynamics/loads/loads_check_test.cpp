// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/loads_check.hpp"

#include "dynamics/model/scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace plekton::dynamics::loads_check_test {
namespace {

using testing::IsEmpty;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A body (reference node 4) of node 3, three nodes with a bond and a sheet between them, two planes
/// that face each other, and a load of every kind.
Scene loaded_scene() {
  Scene scene;
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
    scene.add_node(x);
  scene.add_rigid_body(std::vector{NodeId{3}}, {1.0, Vec3::Zero(), Mat3::Identity()});
  scene.add_beam(NodeId{0}, NodeId{1}, circular_section(0.01, 1e7, 0.3), 1000.0);
  scene.add_sheet_facet({NodeId{0}, NodeId{1}, NodeId{2}}, solid_sheet(0.01, 1e7, 0.3), 1000.0);
  scene.add_facet(NodeId{0}, NodeId{1}, NodeId{2}, 0.01, contact::MaterialId{0});
  scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ()});
  scene.planes.push_back({Vec3::UnitZ(), -Vec3::UnitZ()});
  Loads& loads = scene.loads;
  loads.motions = {{.nodes = {NodeId{0}, NodeId{1}}, .held = Held::along_x | Held::about_y}};
  loads.plane_motions = {{.plane = 0}};
  loads.servos = {{.plane = 1, .force = 1.0, .largest_speed = 1.0}};
  loads.body_servos = {{.body = 0, .axis = 0, .force = 1.0, .largest_speed = 1.0}};
  loads.forces = {{.nodes = {NodeId{2}}}};
  loads.ground_springs = {{.nodes = {NodeId{2}}, .stiffness = Vec3(0, 1, 2)}};
  loads.pressures = {{.facets = {geometry::FaceId{0}}}};
  loads.beam_damping = {{.bonds = {0}}};
  loads.sheet_damping = {{.facets = {0}}};
  loads.mass_damping = {{.nodes = {NodeId{0}, NodeId{4}}}};
  return scene;
}

std::string problems_of(const Scene& scene) {
  std::ostringstream text;
  list_load_problems(scene, text);
  return text.str();
}

TEST(LoadsCheck, FindsNothingWrongWithALoadOfEveryKind) {
  EXPECT_THAT(problems_of(loaded_scene()), IsEmpty());
}

TEST(LoadsCheck, WritesTheLineOfWhatIsWrongAndNoOther) {
  struct Case {
    std::function<void(Scene&)> spoil;
    const char* line;
  };
  const std::vector<Case> cases = {
      {[](Scene& s) { s.loads.motions[0].start = {Vec3::Zero()}; },
       "prescribed motion 0: must have a place at the start for each of its nodes, or none\n"},
      {[](Scene& s) { s.loads.motions[0].angular_velocity.y() = kInfinity; },
       "prescribed motion 0: its angular velocity (  0 inf   0) is not finite\n"},
      {[](Scene& s) {
         s.loads.motions[0].held = Held::translation;
         s.loads.motions[0].turn = {Vec3::Zero(), Vec3::UnitX(), kInfinity};
       },
       "prescribed motion 0: the angle of its turn must be finite\n"},
      {[](Scene& s) { s.loads.plane_motions[0].plane = 2; },
       "motion of a plane 0: there is no plane 2, only 2 planes\n"},
      {[](Scene& s) { s.loads.plane_motions.push_back({.plane = 0}); },
       "motion of a plane 1: plane 0 is driven already; drive every plane once\n"},
      {[](Scene& s) { s.loads.servos[0].largest_speed = kInfinity; },
       "servo 0: its target, area and speed (  1   1 inf) is not finite\n"},
      {[](Scene& s) { s.loads.body_servos[0].towards = 0.5; },
       "servo of a rigid body 0: goes towards 1 or -1 along its axis\n"},
      {[](Scene& s) { s.loads.body_servos[0].axis = 3; },
       "servo of a rigid body 0: there is no axis 3, only 0, 1 and 2\n"},
      {[](Scene& s) { s.loads.body_servos[0].gain = 0.0; },
       "servo of a rigid body 0: its gain must be above 0, at most 1\n"},
      {[](Scene& s) { s.loads.forces[0].nodes.clear(); },
       "nodal force 0: has no nodes; give at least one\n"},
      {[](Scene& s) { s.loads.forces[0].torque.z() = kInfinity; },
       "nodal force 0: its torque (  0   0 inf) is not finite\n"},
      {[](Scene& s) { s.loads.ground_springs[0].stiffness.z() = kNan; },
       "ground springs 0: stiffness (  0   1 nan) N/m must be finite and not negative along every "
       "axis\n"},
      {[](Scene& s) {
         s.loads.beam_damping[0].bonds = {0, 0};
       },
       "beam damping 0: names bond 0 twice; name it once\n"},
      {[](Scene& s) { s.loads.beam_damping[0].bonds.clear(); },
       "beam damping 0: has no bonds; give at least one\n"},
      {[](Scene& s) { s.loads.sheet_damping[0].ratio = kInfinity; },
       "sheet damping 0: its ratio must be finite and not negative\n"},
      {[](Scene& s) { s.loads.mass_damping[0].nodes.push_back(NodeId{-1}); },
       "mass damping 0: there is no node -1, only 5 nodes\n"},
      {[](Scene& s) { s.loads.pressures[0].pressure = kInfinity; },
       "surface pressure 0: its pressure is inf Pa; it must be finite\n"},
  };
  for (const Case& one : cases) {
    Scene scene = loaded_scene();
    one.spoil(scene);
    EXPECT_EQ(problems_of(scene), one.line);
  }
}

TEST(LoadsCheck, SaysOnceForAMotionWhichOfItsComponentsAreHeldAlready) {
  Scene scene = loaded_scene();
  for (const std::size_t node : {0U, 1U}) scene.properties.held[node] = Held::along_x;
  scene.loads.motions.push_back(
      {.nodes = {NodeId{2}, NodeId{1}, NodeId{0}}, .held = Held::about_y | Held::about_z});

  EXPECT_EQ(problems_of(scene),
            "prescribed motion 0: node 0: its translation along x is held or prescribed already; "
            "prescribe every component once\n"
            "prescribed motion 1: node 1: its rotation about y is held or prescribed already; "
            "prescribe every component once\n");
}

TEST(LoadsCheck, LeavesTheReferenceNodeOfABodyToItsLoadsAndRefusesThoseOnNodesThatFollow) {
  const std::string follows = ": node 3 follows rigid body 0; load the reference node of that, 4\n";
  Scene scene = loaded_scene();
  scene.loads.forces[0].nodes = {NodeId{4}};
  scene.loads.ground_springs[0].nodes = {NodeId{4}};
  EXPECT_THAT(problems_of(scene), IsEmpty());

  scene.loads.forces[0].nodes = {NodeId{3}};
  scene.loads.ground_springs[0].nodes = {NodeId{3}};
  scene.loads.mass_damping[0].nodes = {NodeId{3}};

  EXPECT_EQ(problems_of(scene),
            "nodal force 0" + follows + "ground springs 0" + follows + "mass damping 0" + follows);
}

TEST(LoadsCheck, RefusesAServoOfABodyThatAMotionMovesAlongItsAxisAlone) {
  Scene scene = loaded_scene();
  scene.loads.motions[0] = {.nodes = {NodeId{4}}, .held = Held::along_y | Held::rotation};
  EXPECT_THAT(problems_of(scene), IsEmpty());

  scene.loads.motions[0].held = Held::along_x;

  EXPECT_EQ(problems_of(scene),
            "servo of a rigid body 0: its rigid body is held or moved along that axis already\n");
}

TEST(LoadsCheck, RefusesTwoServosThatDriveABodyAlike) {
  Scene scene = loaded_scene();
  scene.loads.body_servos.push_back(scene.loads.body_servos[0]);

  EXPECT_EQ(
      problems_of(scene),
      "servo of a rigid body 1: rigid body 0 is driven so already; drive every motion once\n");

  scene.loads.body_servos[1].axis = 2;
  EXPECT_THAT(problems_of(scene), IsEmpty());
}

}  // namespace
}  // namespace plekton::dynamics::loads_check_test
