// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/refinement.hpp"
#include "tests/support/sheet_meshes.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

/// Stretching of sheets against membrane theory, on finer and finer meshes.
namespace plekton::test::membrane_refinement_test {
namespace {

using dynamics::solid_sheet;

constexpr double kModulus = 1e9;     // Pa
constexpr double kDensity = 1e3;     // kg/m³
constexpr double kThickness = 0.01;  // m

// A square sheet hangs from its upper side, which may get narrower: the tension falls from rho g t
// L to nothing, the middle of the lower side sinks by rho g L² / (2 E), a strip being in uniaxial
// tension (small strain, nu = 0).
TEST(MembraneRefinement, AHangingSheetIsStretchedByItsWeight) {
  const SheetSection section = solid_sheet(kThickness, kModulus, 0.0);
  constexpr double kSide = 1.0, kExpected = 1e-6;
  const double weight = 2.0 * kExpected * kModulus * kThickness / (kSide * kSide);  // Pa
  Refinement table("hanging square sheet, lower side sinks (m)", kExpected);
  Refinement tension("hanging square sheet, tension near the upper side (N/m)", weight * kSide);
  for (const int cells : {4, 8, 16, 32}) {
    Mesh mesh = geometry::plane_sheet({kSide, kSide, cells, cells});
    Scene scene = sheet_of(mesh, section, kDensity, [&](const Vec3& x) {
      return x.y() > 0.5 * kSide - 1e-9 ? Held::everything : Held::nothing;
    });
    SheetStatics statics(scene);

    statics.balance(uniform_load(scene, Vec3(0.0, -weight, 0.0)));

    const std::size_t lowest = nearest_node(scene, Vec3(0.0, -0.5 * kSide, 0.0));
    table.add(cells, -0.5 * kSide - scene.state.position[lowest].y());
    double most = 0.0;
    for (std::size_t i = 0; i < statics.sheets().size(); ++i)
      most = std::max(most, statics.sheets().membrane_force(i, scene.state.position)(1, 1));
    tension.add(cells, most);
  }
  table.print();
  tension.print();
  EXPECT_LT(table.last_error(), 0.002);
  EXPECT_LT(tension.last_error(), 0.02);
  EXPECT_GT(tension.last_order(), 0.9);  // constant in a facet: first order
}

// A sphere of radius R0 blown up to R = s R0: both membrane forces are E t / (1 - nu) 1/2 (s² - 1)
// = p R / 2, so p = E t / ((1 - nu) R0) (s² - 1) / s; for small strain 2 E t / ((1 - nu) R0) (s -
// 1).
void refine_sphere(double stretch, double nu, int finest) {
  constexpr double kRadius = 0.5;
  const SheetSection section = solid_sheet(kThickness, kModulus, nu);
  const double pressure =
      section.tensile_stiffness / ((1.0 - nu) * kRadius) * (stretch * stretch - 1.0) / stretch;
  Refinement table("inflated sphere, growth of the radius (m), nu = " + std::to_string(nu),
                   (stretch - 1.0) * kRadius);
  for (int subdivisions = 1; subdivisions <= finest; ++subdivisions) {
    Scene scene = sheet_of(geometry::icosphere(kRadius, subdivisions), section, kDensity,
                           [](const Vec3&) { return Held::nothing; });
    const double before = scene.state.position[0].norm();

    SheetStatics(scene).balance({Eigen::VectorXd(), pressure});

    double mean = 0.0;
    for (const Vec3& x : scene.state.position) mean += x.norm();
    mean /= static_cast<double>(scene.state.size());
    table.add(1 << subdivisions, mean - before);
  }
  table.print();
  EXPECT_LT(table.last_error(), 0.01);
  EXPECT_GT(table.last_order(), 1.7);
}

TEST(MembraneRefinement, ASphereGrowsWithItsPressureLittle) {
  refine_sphere(1.001, 0.0, 3);
  refine_sphere(1.001, 0.3, 4);
}

TEST(MembraneRefinement, ASphereGrowsWithItsPressureByATenth) {
  refine_sphere(1.1, 0.3, 3);
}

}  // namespace
}  // namespace plekton::test::membrane_refinement_test
