// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/facet_traction.hpp"

#include "geometry/mesh/generate/generators.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

namespace plekton::dynamics::facet_traction_test {
namespace {

using geometry::Facet;
using geometry::index_of;
using geometry::Vec3;

std::vector<Facet> facets_of(const geometry::Mesh& mesh) {
  std::vector<Facet> facets;
  for (const auto& nodes : mesh.facets) facets.push_back({nodes, 0.01});
  return facets;
}

Vec3 area_of(const Facet& facet, const std::vector<Vec3>& x) {
  const Vec3& corner = x[index_of(facet.nodes[0])];
  return 0.5 * (x[index_of(facet.nodes[1])] - corner).cross(x[index_of(facet.nodes[2])] - corner);
}

TEST(FacetTraction, OfAUniformPressureIsThatPressure) {
  const geometry::Mesh mesh = geometry::plane_sheet({1.0, 2.0, 3, 4});
  const std::vector<Facet> facets = facets_of(mesh);
  const double pressure = 200.0;
  const Vec3 shear(30.0, -10.0, 0.0);
  std::vector<Vec3> forces(mesh.points.size(), Vec3::Zero());
  for (const Facet& facet : facets) {
    const Vec3 area = area_of(facet, mesh.points);
    for (const auto node : facet.nodes)
      forces[index_of(node)] += (-pressure * area + area.norm() * shear) / 3.0;
  }

  for (const FacetTraction& traction : facet_tractions(facets, forces, mesh.points)) {
    EXPECT_NEAR(traction.pressure, pressure, 1e-12 * pressure);
    EXPECT_NEAR((traction.shear - shear).norm(), 0.0, 1e-12 * pressure);
  }
}

TEST(FacetTraction, TimesAreaAddsUpToTheForceOnTheNodes) {
  const geometry::Mesh mesh = geometry::icosphere(0.3, 2);
  const std::vector<Facet> facets = facets_of(mesh);
  test::Random random(5);
  std::vector<Vec3> forces;
  Vec3 expected = Vec3::Zero();
  double size = 0.0;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    forces.push_back(random.in_cube(10.0));
    expected += forces.back();
    size += forces.back().norm();
  }

  const std::vector<FacetTraction> tractions = facet_tractions(facets, forces, mesh.points);

  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < facets.size(); ++i) {
    const Vec3 area = area_of(facets[i], mesh.points);
    sum += area.norm() * tractions[i].shear - tractions[i].pressure * area;
    EXPECT_NEAR(tractions[i].shear.dot(area.normalized()), 0.0, 1e-12 * tractions[i].shear.norm());
  }
  EXPECT_NEAR((sum - expected).norm(), 0.0, 1e-12 * size);
}

TEST(FacetTraction, IsFiniteOnAFacetWithoutArea) {
  const std::vector<Vec3> x{Vec3::Zero(), Vec3::UnitX(), 2.0 * Vec3::UnitX()};
  const std::vector<Facet> facets{
      {{geometry::NodeId{0}, geometry::NodeId{1}, geometry::NodeId{2}}, 0.01}};

  const auto tractions = facet_tractions(facets, std::vector<Vec3>(3, Vec3::UnitZ()), x);

  EXPECT_EQ(tractions[0].pressure, 0.0);
  EXPECT_EQ(tractions[0].shear, Vec3::Zero());
}

}  // namespace
}  // namespace plekton::dynamics::facet_traction_test
