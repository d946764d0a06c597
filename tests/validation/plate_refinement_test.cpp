// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/clamped_plate.hpp"
#include "tests/support/refinement.hpp"
#include "tests/support/sheet_meshes.hpp"

#include <gtest/gtest.h>

#include <string>

/// Bending of sheets against plate theory, on finer and finer meshes.
namespace plekton::test::plate_refinement_test {
namespace {

using dynamics::solid_sheet;

constexpr double kModulus = 1e9;  // Pa
constexpr double kRadius = 1.0;   // m

bool on_rim(const Vec3& x) {
  return x.norm() > kRadius * (1.0 - 1e-9);
}

/// m, of the middle of a circular plate.
double middle_of_disk(int rings, double jitter_share, const SheetSection& section, Held rim,
                      double load) {
  Mesh mesh = disk(kRadius, rings);
  jitter(mesh, jitter_share * kRadius / rings,
         [](const Vec3& x) { return !on_rim(x) && x.norm() > 0.0; });
  Scene scene =
      sheet_of(mesh, section, 0.0, [&](const Vec3& x) { return on_rim(x) ? rim : Held::nothing; });

  SheetStatics(scene).balance(uniform_load(scene, Vec3(0.0, 0.0, load)));

  return scene.state.position[0].z();
}

/// The deflection is so small that w = q a⁴ / (64 D) for a clamped plate, and (5 + nu) / (1 + nu)
/// times that for one whose rim may turn.
void refine_small_deflection(double jitter_share, double nu, Held rim) {
  const SheetSection section = solid_sheet(0.02, kModulus, nu);
  const double expected = 1e-6;
  const double factor = rim == Held::everything ? 1.0 : (5.0 + nu) / (1.0 + nu);
  const double load = expected * 64.0 * section.bending_stiffness / factor;
  Refinement table((rim == Held::everything ? "clamped" : "hinged") +
                       std::string(" circular plate, w (m), nu = ") + std::to_string(nu) +
                       (jitter_share > 0.0 ? ", irregular mesh" : ""),
                   expected);
  for (const int rings : {4, 8, 16, 32})
    table.add(rings, middle_of_disk(rings, jitter_share, section, rim, load));
  table.print();
  EXPECT_LT(table.last_error(), 0.003);
  EXPECT_GT(table.last_order(), 1.7);
}

TEST(PlateRefinement, ClampedCircularPlateBendsLittleAsTheory) {
  for (const double nu : {0.0, 0.3, 0.49}) refine_small_deflection(0.0, nu, Held::everything);
}

TEST(PlateRefinement, ClampedCircularPlateBendsAsTheoryOnIrregularMeshes) {
  refine_small_deflection(0.25, 0.3, Held::everything);
}

// The rim of a mesh is a polygon whose corners alone are held: its sides may rise, so this is no
// polygonal plate on simple supports, which would not become the circular one (Babuska's paradox).
TEST(PlateRefinement, HingedCircularPlateBendsAsTheoryForEveryPoissonRatio) {
  for (const double nu : {0.0, 0.3}) refine_small_deflection(0.0, nu, Held::translation);
}

// Large deflection: stretching carries the load. Von Karman's theory needs small slopes: w / a = 2
// % here, which changes w by the square of it.
TEST(PlateRefinement, ClampedCircularPlateStiffensAsVonKarmanSays) {
  constexpr double kPoisson = 0.3;
  constexpr double kThickness = 0.01;
  const SheetSection section = solid_sheet(kThickness, kModulus, kPoisson);
  const ClampedPlate theory(kPoisson);
  EXPECT_NEAR(theory.middle(1e-3), 1e-3 / 64.0, 1e-8);
  for (const double linear : {1.0, 4.0, 16.0}) {  // w / t if it did not stretch
    const double load = 64.0 * linear;
    const double expected = kThickness * theory.middle(load);
    Refinement table("clamped circular plate, w (m), " + std::to_string(expected / kThickness) +
                         " thicknesses, linear theory " + std::to_string(linear),
                     expected);
    for (const int rings : {4, 8, 16}) {
      const double q = load * section.bending_stiffness * kThickness / std::pow(kRadius, 4);
      table.add(rings, middle_of_disk(rings, 0.0, section, Held::everything, q));
    }
    table.print();
    EXPECT_LT(table.last_error(), 0.004);
    EXPECT_GT(table.last_order(), 1.7);
  }
}

// Square plate, clamped: w = 0.00126532 q a⁴ / D (Taylor & Govindjee, Commun. Numer. Meth. Engng 20
// (2004) 757-765).
TEST(PlateRefinement, ClampedSquarePlateBendsAsTheory) {
  const SheetSection section = solid_sheet(0.02, kModulus, 0.3);
  constexpr double kExpected = 1e-6;
  const double load = kExpected * section.bending_stiffness / 0.00126532;
  for (const auto pattern : {geometry::SheetPattern::diagonal, geometry::SheetPattern::alternating,
                             geometry::SheetPattern::cross}) {
    Refinement table(
        "clamped square plate, w (m), pattern " + std::to_string(static_cast<int>(pattern)),
        kExpected);
    for (const int cells : {4, 8, 16, 32}) {
      Scene scene = sheet_of(geometry::plane_sheet({1.0, 1.0, cells, cells, pattern}), section, 0.0,
                             [](const Vec3& x) {
                               return x.head<2>().cwiseAbs().maxCoeff() > 0.5 - 1e-9
                                          ? Held::everything
                                          : Held::nothing;
                             });
      SheetStatics(scene).balance(uniform_load(scene, Vec3(0.0, 0.0, load)));
      table.add(cells, scene.state.position[nearest_node(scene, Vec3::Zero())].z());
    }
    table.print();
    EXPECT_LT(table.last_error(), 0.005);
    EXPECT_GT(table.last_order(), 1.7);
  }
}

/// A strip along x, clamped at x = 0.
Scene strip(int cells, double length, double width, const SheetSection& section) {
  Mesh mesh = geometry::plane_sheet({length, width, cells,
                                     std::max(1, static_cast<int>(cells * width / length)),
                                     geometry::SheetPattern::alternating});
  for (Vec3& x : mesh.points) x.x() += 0.5 * length;
  return sheet_of(mesh, section, 0.0,
                  [](const Vec3& x) { return x.x() < 1e-9 ? Held::everything : Held::nothing; });
}

// Without Poisson's effect a strip is a beam of E I = D b: w = F L³ / (3 E I).
TEST(PlateRefinement, AStripBendsAsABeam) {
  const SheetSection section = solid_sheet(0.01, kModulus, 0.0);
  constexpr double kLength = 1.0, kWidth = 0.25, kExpected = 1e-6;
  Refinement table("cantilever strip, w at the tip (m)", kExpected);
  for (const int cells : {4, 8, 16, 32}) {
    Scene scene = strip(cells, kLength, kWidth, section);
    const double force =
        3.0 * kExpected * section.bending_stiffness * kWidth / std::pow(kLength, 3);
    SheetLoads loads = uniform_load(scene, Vec3::Zero());
    for (const auto& facet : scene.sheet_facets) {  // evenly along the end
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& a = scene.state.position[index_of(facet.nodes[i])];
        const Vec3& b = scene.state.position[index_of(facet.nodes[(i + 1) % 3])];
        if (a.x() < kLength - 1e-9 || b.x() < kLength - 1e-9) continue;
        for (const std::size_t n : {i, (i + 1) % 3})
          loads.dead[static_cast<Eigen::Index>(6 * index_of(facet.nodes[n]) + 2)] +=
              0.5 * force * (b - a).norm() / kWidth;
      }
    }

    SheetStatics(scene).balance(loads);

    table.add(cells, scene.state.position[nearest_node(scene, Vec3(kLength, 0.0, 0.0))].z());
  }
  table.print();
  EXPECT_LT(table.last_error(), 0.001);
}

}  // namespace
}  // namespace plekton::test::plate_refinement_test
