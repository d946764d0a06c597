// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/takeover/material_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plekton::apps::yade::material_table_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Scene scene_of(std::vector<Material> materials) {
  Scene scene;
  scene.materials = std::move(materials);
  return scene;
}

std::string text_of(const MaterialTable& table) {
  std::vector<std::string> notes;
  return table.text(notes);
}

TEST(MaterialTable, HasARowForEachMaterialAndDensity) {
  const Scene scene =
      scene_of({{.type = "FrictMat", .label = "sand", .young = 1e7, .poisson = 0.4}});
  MaterialTable table(scene);

  EXPECT_EQ(table.of_surface(0), "\"sand\"");
  EXPECT_EQ(table.of_grains(0, 2650.0), "\"sand\"");
  EXPECT_EQ(table.of_grains(0, 2650.0 * (1.0 + 1e-12)), "\"sand\"");
  EXPECT_EQ(table.of_grains(0, 1000.0), "\"sand 2\"");
  EXPECT_EQ(table.of_rigid(0), "\"sand (rigid)\"");
  EXPECT_THAT(
      text_of(table),
      AllOf(HasSubstr("[materials.\"sand\"]\nyoung_modulus = 10000000"),
            HasSubstr("stiffness_ratio = 0.4"), HasSubstr("density = 2650\n"),
            HasSubstr(
                "between = \"sand\"\nand = \"sand (rigid)\"\nstiffness_radius = \"curvature\"")));
}

TEST(MaterialTable, MakesNamesOfLabelsThatAreNone) {
  const Scene scene = scene_of({{.type = "FrictMat", .label = ""}, {.label = "=1\"\\\n"}});
  MaterialTable table(scene);

  EXPECT_EQ(table.of_surface(0), "\"FrictMat\"");
  EXPECT_EQ(table.of_surface(1), "\"m =1\\\"\\\\ \"");
  EXPECT_EQ(table.of_surface(-1), "\"none\"");
}

TEST(MaterialTable, GluesCohesiveMaterialsWhereALawDoes) {
  Scene scene = scene_of({{.label = "clay",
                           .is_cohesive = true,
                           .normal_cohesion = 3e4,
                           .shear_cohesion = 1e4,
                           .rolls = true,
                           .rolling_stiffness = 2.0,
                           .rolling_limit = 0.1}});
  MaterialTable table(scene);
  table.of_grains(0, 2000.0);
  EXPECT_THAT(text_of(table), Not(HasSubstr("cohesive")));

  scene.functors = {"Ig2_Sphere_Sphere_ScGeom6D", "Law2_ScGeom6D_CohFrictPhys_CohesionMoment",
                    "setCohesionNow"};

  EXPECT_THAT(text_of(table),
              AllOf(HasSubstr("law = \"cohesive_frictional\"\ntensile_strength = 30000\n"
                              "shear_strength = 10000\nbonds = \"start\"\nrolling_stiffness = 2\n"),
                    HasSubstr("rolling_limit = 0.1\n"), Not(HasSubstr("twisting_limit"))));
}

TEST(MaterialTable, TakesHertzForMindlin) {
  Scene scene = scene_of({{.label = "steel", .young = 2e11, .poisson = 0.28}});
  scene.functors = {"Law2_ScGeom_MindlinPhys_Mindlin"};
  MaterialTable table(scene);
  table.of_grains(0, 7800.0);

  EXPECT_THAT(text_of(table),
              AllOf(HasSubstr("poisson_ratio = 0.28"), HasSubstr("law = \"hertz_mindlin\"")));
}

}  // namespace
}  // namespace plekton::apps::yade::material_table_test
