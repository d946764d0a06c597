// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/takeover/yade_scene.hpp"

#include "apps/scenario/problems.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace plekton::apps::yade::yade_scene_test {
namespace {

constexpr std::string_view kTold = R"({"iteration": 7, "time": 0.5, "dt": 1e-3, "periodic": false,
"engines": ["NewtonIntegrator"], "functors": ["Ig2_Sphere_Sphere_ScGeom"],
"functor_settings": {"Ip2_FrictMat_FrictMat_FrictPhys": ["kn", "ks"]}, "gravity": [0, 0, -9.81],
"damping": 0.2, "damp_gravity": true, "stepper": "", "forces": [{"id": 0, "force": [1, 0, 0], "torque": [0, 0, 2]}],
"materials": [{"type": "FrictMat", "label": "sand", "young": 1e7, "poisson": 0.3, "friction_angle": 0.5}],
"spheres": [{"id": 0, "material": 0, "x": [1, 2, 3], "v": [0, 0, -1], "w": [4, 0, 0], "blocked": "xY", "mass": 0.1, "r": 0.02}],
"nodes": [{"id": 1, "material": 0, "x": [0, 0, 0], "v": [0, 0, 0], "w": [0, 0, 0], "blocked": "", "mass": 0.1, "r": 0.01, "inertia": 0.25}],
"connections": [], "pfacets": [],
"walls": [{"id": 2, "material": 0, "x": [0, 0, -1], "v": [0, 0, 0], "w": [0, 0, 0], "blocked": "xyzXYZ", "mass": 0, "axis": 2, "sense": 1}],
"facets": [{"id": 3, "material": 0, "x": [0, 0, 0], "v": [0, 0, 0], "w": [0, 0, 0], "blocked": "xyzXYZ", "mass": 0,
  "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "facets": [[0, 1, 2]]}],
"clumps": [], "bonds": [], "others": {"Polyhedra": 2}, "contacts": 5})";

TEST(YadeScene, IsReadAsItIsTold) {
  const Scene scene = parse_scene(kTold);

  EXPECT_EQ(scene.iteration, 7);
  EXPECT_EQ(scene.time_step, 1e-3);
  EXPECT_EQ(scene.materials.at(0).young, 1e7);
  EXPECT_EQ(scene.spheres.at(0).position, Vec3(1, 2, 3));
  EXPECT_EQ(scene.spheres.at(0).angular_velocity, Vec3(4, 0, 0));
  EXPECT_EQ(scene.spheres.at(0).blocked, "xY");
  EXPECT_EQ(scene.nodes.at(0).inertia, 0.25);
  EXPECT_EQ(scene.walls.at(0).axis, 2);
  EXPECT_EQ(scene.walls.at(0).sense, 1);
  EXPECT_EQ(scene.facets.at(0).points.size(), 3u);
  EXPECT_FALSE(scene.facets.at(0).is_box);
  EXPECT_EQ(scene.forces.at(0).torque, Vec3(0, 0, 2));
  EXPECT_EQ(scene.others.at("Polyhedra"), 2);
  EXPECT_TRUE(has_functor(scene, "Ig2_Sphere_Sphere_ScGeom"));
  EXPECT_FALSE(has_functor(scene, "Ig2_Sphere_Sphere"));
  EXPECT_EQ(scene.functor_settings.at("Ip2_FrictMat_FrictMat_FrictPhys"),
            (std::vector<std::string>{"kn", "ks"}));
}

TEST(YadeScene, IsRefusedWhereItIsNotWhatIsExpected) {
  for (const std::string text : {"", "{}", "[1]", "{\"iteration\": \"seven\"}"})
    EXPECT_THROW(parse_scene(text), InputError) << text;
}

}  // namespace
}  // namespace plekton::apps::yade::yade_scene_test
