// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/model/scene_hash.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace plekton::dynamics::scene_hash_test {
namespace {

using contact::MaterialId;
using test::Random;

/// The next number, which differs in its last bit.
void nudge(double& number) {
  number = std::nextafter(number, 2.0 * number + 1.0);
}

Scene of_all_kinds() {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.5}, {2e6, 0.3, 0.5}};
  scene.add_sphere(Vec3(0, 0, 3), 0.1, 1000.0, MaterialId{0});
  scene.add_sphere(Vec3(1, 0, 3), 0.1, 1000.0, MaterialId{0});
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(2, 2, 0), Vec3(3, 2, 0)})
    scene.add_node(x);
  scene.add_cylinder(NodeId{5}, NodeId{6}, 0.02, MaterialId{0});
  scene.add_facet(NodeId{2}, NodeId{3}, NodeId{4}, 0.01, MaterialId{0});
  scene.add_beam(NodeId{5}, NodeId{6}, circular_section(0.02, 1e7, 0.3), 1000.0);
  scene.add_sheet_facet({NodeId{2}, NodeId{3}, NodeId{4}}, solid_sheet(0.02, 1e6, 0.3), 1000.0);
  scene.sheet_facets[0].section.strength = 1e5;
  scene.add_rigid_body(std::vector{NodeId{0}, NodeId{1}},
                       {2.0, Vec3(0.5, 0, 3), Mat3(Vec3(1, 2, 3).asDiagonal())});
  scene.cables.push_back({.nodes = {NodeId{5}, NodeId{6}}});
  scene.ties = {{.node = NodeId{2}, .to = material_point(NodeId{3}), .stiffness = 10.0},
                {.node = NodeId{4}, .to = FixedPoint{Vec3::UnitZ()}, .stiffness = 20.0}};
  scene.planes = {{Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), MaterialId{0}},
                  {.point = Vec3::Zero(),
                   .form = contact::Plane::Form::cylinder,
                   .radius = 5.0,
                   .axis = Vec3::UnitZ()}};
  return scene;
}

TEST(SceneHash, DiffersWithWhateverASceneIsMadeOf) {
  const std::vector<std::pair<std::string, std::function<void(Scene&)>>> changes = {
      {"nothing", [](Scene&) {}},
      {"mass", [](Scene& s) { nudge(s.properties.mass[5]); }},
      {"inertia", [](Scene& s) { nudge(s.properties.inertia[5]); }},
      {"held", [](Scene& s) { s.properties.held[5] = Held::about_z; }},
      {"a node", [](Scene& s) { s.add_node(Vec3::Zero()); }},
      {"node of a sphere", [](Scene& s) { s.elements.spheres[1].nodes[0] = NodeId{5}; }},
      {"radius of a sphere", [](Scene& s) { nudge(s.elements.spheres[1].radius); }},
      {"material of a sphere", [](Scene& s) { s.sphere_materials[1] = MaterialId{1}; }},
      {"material of another one", [](Scene& s) { s.sphere_materials[0] = MaterialId{1}; }},
      {"ends of a bar",
       [](Scene& s) {
         std::swap(s.elements.cylinders[0].nodes[0], s.elements.cylinders[0].nodes[1]);
       }},
      {"radius of a bar", [](Scene& s) { nudge(s.elements.cylinders[0].radius); }},
      {"material of a bar", [](Scene& s) { s.cylinder_materials[0] = MaterialId{1}; }},
      {"corners of a facet",
       [](Scene& s) { std::swap(s.elements.facets[0].nodes[1], s.elements.facets[0].nodes[2]); }},
      {"radius of a facet", [](Scene& s) { nudge(s.elements.facets[0].radius); }},
      {"material of a facet", [](Scene& s) { s.facet_materials[0] = MaterialId{1}; }},
      {"ends of a bond", [](Scene& s) { std::swap(s.bonds[0].nodes[0], s.bonds[0].nodes[1]); }},
      {"length of a bond", [](Scene& s) { nudge(s.bonds[0].length); }},
      {"E of a bond", [](Scene& s) { nudge(s.bonds[0].section.young_modulus); }},
      {"G of a bond", [](Scene& s) { nudge(s.bonds[0].section.shear_modulus); }},
      {"A of a bond", [](Scene& s) { nudge(s.bonds[0].section.area); }},
      {"I of a bond", [](Scene& s) { nudge(s.bonds[0].section.second_moment); }},
      {"J of a bond", [](Scene& s) { nudge(s.bonds[0].section.torsion_constant); }},
      {"a second bond", [](Scene& s) { s.bonds.push_back(s.bonds[0]); }},
      {"nodes of a sheet",
       [](Scene& s) { std::swap(s.sheet_facets[0].nodes[1], s.sheet_facets[0].nodes[2]); }},
      {"E t of a sheet", [](Scene& s) { nudge(s.sheet_facets[0].section.tensile_stiffness); }},
      {"nu of a sheet", [](Scene& s) { nudge(s.sheet_facets[0].section.poisson_ratio); }},
      {"D of a sheet", [](Scene& s) { nudge(s.sheet_facets[0].section.bending_stiffness); }},
      {"t of a sheet", [](Scene& s) { nudge(s.sheet_facets[0].section.thickness); }},
      {"strength of a sheet", [](Scene& s) { nudge(s.sheet_facets[0].section.strength); }},
      {"shape of a sheet", [](Scene& s) { nudge(s.sheet_facets[0].corners[2].x()); }},
      {"height of a sheet", [](Scene& s) { nudge(s.sheet_facets[0].corners[2].y()); }},
      {"a second sheet", [](Scene& s) { s.sheet_facets.push_back(s.sheet_facets[0]); }},
      {"no body", [](Scene& s) { s.rigid_bodies.clear(); }},
      {"nodes of a body", [](Scene& s) { s.rigid_bodies[0].nodes.pop_back(); }},
      {"moments of a body", [](Scene& s) { nudge(s.rigid_bodies[0].moments.y()); }},
      {"no cable", [](Scene& s) { s.cables.clear(); }},
      {"a ring", [](Scene& s) { s.cables[0].is_closed = true; }},
      {"no tie", [](Scene& s) { s.ties.pop_back(); }},
      {"node of a tie", [](Scene& s) { s.ties[0].node = NodeId{4}; }},
      {"what a tie is to", [](Scene& s) { s.ties[0].to = material_point(NodeId{4}); }},
      {"to a cable", [](Scene& s) { s.ties[1].to = CablePlace{}; }},
      {"stiffness of a tie", [](Scene& s) { nudge(s.ties[1].stiffness); }},
      {"normal of a plane", [](Scene& s) { nudge(s.planes[0].normal.x()); }},
      {"material of a plane", [](Scene& s) { s.planes[0].material = MaterialId{1}; }},
      {"axis of a drum", [](Scene& s) { nudge(s.planes[1].axis.x()); }},
      {"a ball", [](Scene& s) { s.planes[1].form = contact::Plane::Form::sphere; }},
      {"a plane that turns", [](Scene& s) { s.planes[1].angular_velocity = 1.0; }},
      {"no plane", [](Scene& s) { s.planes.clear(); }}};

  std::map<std::uint64_t, std::string> found;
  for (const auto& [name, change] : changes) {
    Scene scene = of_all_kinds();
    change(scene);
    const auto [other, is_new] = found.emplace(scene_hash(scene), name);
    EXPECT_TRUE(is_new) << name << " has the hash of " << other->second;
  }
}

TEST(SceneHash, IsTheSameWhereverASceneIsHoweverItMovesAndWhateverActsOnIt) {
  Random random(61);
  const std::uint64_t hash = scene_hash(of_all_kinds());
  Scene scene = of_all_kinds();
  for (std::size_t i = 0; i < scene.state.size(); ++i) {
    scene.state.position[i] += random.in_cube(1.0);
    scene.state.velocity[i] = random.in_cube(1.0);
    scene.state.angular_velocity[i] = random.in_cube(1.0);
    scene.state.orientation[i] = Quat(random.rotation());
  }
  for (contact::Plane& plane : scene.planes) {
    plane.point = random.in_cube(1.0);
    plane.velocity = random.in_cube(1.0);
  }
  scene.planes[1].radius = 6.0;
  scene.planes[1].widening = 0.1;
  scene.loads.forces = {{.nodes = {NodeId{5}}, .force = Vec3::UnitX()}};
  scene.loads.plane_motions = {{.plane = 0}};

  EXPECT_EQ(scene_hash(scene), hash);
}

}  // namespace
}  // namespace plekton::dynamics::scene_hash_test
