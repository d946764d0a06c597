// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/models.hpp"
#include "dynamics/simulation.hpp"
#include "tests/support/named_laws.hpp"

#include <gtest/gtest.h>

#include <string>

/// One rule for the materials of all pairs: a sphere rebounds in the same way from a plane, from a
/// facet and from a sheet, however it is cut into facets. To a contact, a plane is the sphere's own
/// mirror image, so the sheets have its radius.
namespace plekton::dynamics::material_rule_test {
namespace {

using contact::AnyLaw;
using geometry::NodeId;

constexpr double kRadius = 0.05;  // m
constexpr contact::MaterialId kMaterial{0};

Scene sphere_above(const Vec3& place) {
  Scene scene;
  scene.materials = {{1e7, 0.4, 0.5, 0.3}};
  scene.add_sphere(place + Vec3(0, 0, kRadius + 1e-5), kRadius, 2000.0, kMaterial);
  scene.state.velocity.back() = Vec3(0.4, 0.3, -1.0);
  scene.state.angular_velocity.back() = Vec3(2.0, -3.0, 5.0);
  return scene;
}

Scene on_plane(const Vec3& place) {
  Scene scene = sphere_above(place);
  scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), kMaterial});
  return scene;
}

/// A held square sheet of 2 m whose upper surface is z = 0.
Scene on_sheet(const Vec3& place, int squares) {
  Scene scene = sphere_above(place);
  std::vector<NodeId> nodes;
  for (int j = 0; j <= squares; ++j) {
    for (int i = 0; i <= squares; ++i) {
      const Vec3 x(2.0 * i / squares - 1.0, 2.0 * j / squares - 1.0, -kRadius);
      nodes.push_back(scene.add_node(x, Held::everything));
    }
  }
  const auto node = [&](int i, int j) {
    return nodes[static_cast<std::size_t>(j * (squares + 1) + i)];
  };
  for (int j = 0; j < squares; ++j) {
    for (int i = 0; i < squares; ++i) {
      scene.add_facet(node(i, j), node(i + 1, j), node(i + 1, j + 1), kRadius, kMaterial);
      scene.add_facet(node(i, j), node(i + 1, j + 1), node(i, j + 1), kRadius, kMaterial);
    }
  }
  return scene;
}

struct Rebound {
  Vec3 velocity;
  Vec3 spin;
};

Rebound rebound_of(Scene scene, const test::NamedLaw& law) {
  Simulation simulation(std::move(scene), {.time_step = 2e-6, .motion = {.gravity = Vec3::Zero()}},
                        contact::any_law({{{kMaterial, kMaterial}, law.properties}}));
  while (simulation.time() < 0.02) simulation.step();
  return {simulation.state().velocity[0], simulation.state().angular_velocity[0]};
}

class MaterialRule : public testing::TestWithParam<test::NamedLaw> {};

TEST_P(MaterialRule, ASphereReboundsTheSameFromAPlaneAFacetAndAnySheet) {
  const Vec3 place(0.123, 0.077, 0.0);
  const Rebound expected = rebound_of(on_plane(place), GetParam());
  EXPECT_GT((expected.velocity - Vec3(0.4, 0.3, -1.0)).norm(), 0.1);
  for (const int squares : {1, 2, 5, 20, 50}) {
    const Rebound rebound = rebound_of(on_sheet(place, squares), GetParam());
    EXPECT_LE((rebound.velocity - expected.velocity).norm(), 1e-9) << squares;
    EXPECT_LE((rebound.spin - expected.spin).norm(), 1e-9 / kRadius) << squares;
  }
}

INSTANTIATE_TEST_SUITE_P(Under, MaterialRule, testing::ValuesIn(test::kLaws),
                         [](const auto& item) { return std::string(item.param.name); });

}  // namespace
}  // namespace plekton::dynamics::material_rule_test
