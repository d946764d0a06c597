// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/free_collision.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <functional>

/// Two free structures that collide: no gravity, nothing held.
namespace plekton::dynamics {
namespace {

using test::momenta_of;
using Simulation = dynamics::Simulation<contact::LinearFrictional>;

constexpr double kRadius = 0.02;
constexpr contact::MaterialId kMaterial{0};

/// Adds a body whose first node is at a place, turned, with a velocity.
struct Body {
  std::vector<Vec3> x;
  std::vector<std::array<std::size_t, 2>> beams;
  std::vector<std::array<std::size_t, 3>> facets;
};

Body chain() {
  Body body;
  for (int i = 0; i <= 4; ++i) body.x.emplace_back(0.15 * i - 0.3, 0.0, 0.0);
  for (std::size_t i = 0; i < 4; ++i) body.beams.push_back({i, i + 1});
  return body;
}

Body sheet() {
  Body body;
  constexpr std::size_t kSquares = 3;
  const auto node = [](std::size_t i, std::size_t j) { return j * (kSquares + 1) + i; };
  for (std::size_t j = 0; j <= kSquares; ++j) {
    for (std::size_t i = 0; i <= kSquares; ++i)
      body.x.emplace_back(0.15 * static_cast<double>(i) - 0.225,
                          0.15 * static_cast<double>(j) - 0.225, 0.0);
  }
  for (std::size_t j = 0; j < kSquares; ++j) {
    for (std::size_t i = 0; i < kSquares; ++i) {
      body.facets.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      body.facets.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
      body.beams.push_back({node(i, j), node(i + 1, j + 1)});
    }
  }
  for (std::size_t j = 0; j <= kSquares; ++j) {
    for (std::size_t i = 0; i < kSquares; ++i) {
      body.beams.push_back({node(i, j), node(i + 1, j)});
      body.beams.push_back({node(j, i), node(j, i + 1)});
    }
  }
  return body;
}

void add(Scene& scene, const Body& body, const Vec3& turns, const Vec3& place,
         const Vec3& velocity) {
  const geometry::Mat3 rotation =
      (Eigen::AngleAxisd(turns.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(turns.y(), Vec3::UnitY()) *
       Eigen::AngleAxisd(turns.x(), Vec3::UnitX()))
          .toRotationMatrix();
  std::vector<NodeId> nodes;
  for (const Vec3& x : body.x) {
    nodes.push_back(scene.add_node(rotation * x + place));
    scene.state.velocity.back() = velocity;
  }
  for (const auto& f : body.facets)
    scene.add_facet(nodes[f[0]], nodes[f[1]], nodes[f[2]], kRadius, kMaterial);
  for (const auto& b : body.beams) {
    scene.add_beam(nodes[b[0]], nodes[b[1]], circular_section(kRadius, 1e7, 0.3), 1000.0);
    scene.add_cylinder(nodes[b[0]], nodes[b[1]], kRadius, kMaterial);
  }
}

struct Case {
  const char* name;
  Body (*still)();
  Body (*flying)();
  Vec3 turns;
  double friction;
};

class StructureCollision : public testing::TestWithParam<Case> {};

Scene scene_of(const Case& item) {
  Scene scene;
  scene.materials = {{1e7, 0.3, item.friction}};
  add(scene, item.still(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero());
  // Its lowest node, if it has one, just above the middle.
  Scene alone;
  add(alone, item.flying(), item.turns, Vec3::Zero(), Vec3::Zero());
  Vec3 lowest = Vec3::Zero();
  for (const Vec3& x : alone.state.position) {
    if (x.z() < lowest.z() - 1e-3) lowest = x;
  }
  const Vec3 middle(0.03, 0.02, 2.0 * kRadius + 1e-3);
  add(scene, item.flying(), item.turns, middle - lowest, Vec3(0.3, 0.1, -1.0));
  return scene;
}

TEST_P(StructureCollision, KeepsBothMomentaAndGainsNoEnergy) {
  // A tenth of the chosen step: the ledger's error falls with its square.
  const Simulation probe(scene_of(GetParam()), {.motion = {.gravity = Vec3::Zero()}});
  Simulation simulation(scene_of(GetParam()), {.time_step = 0.1 * probe.time_step(),
                                               .motion = {.gravity = Vec3::Zero()}});
  const auto before = momenta_of(simulation);
  const double energy = simulation.energy().initial;

  std::size_t touched = 0;
  double worst_linear = 0.0, worst_angular = 0.0, most = 0.0, worst_closure = 0.0;
  while (simulation.time() < 0.05) {
    simulation.step();
    const auto now = momenta_of(simulation);
    worst_linear = std::max(worst_linear, (now.linear - before.linear).norm());
    worst_angular = std::max(worst_angular, (now.angular - before.angular).norm());
    const Energy e = simulation.energy();
    most = std::max(most, e.kinetic + e.contact_elastic + e.bond_elastic);
    worst_closure = std::max(worst_closure, e.closure());
    touched += simulation.contacts().counts().between_structures > 0;
  }

  EXPECT_GT(touched, 0u);
  EXPECT_LE(worst_linear, 1e-10 * before.linear.norm());
  EXPECT_LE(worst_angular, 1e-10 * before.angular.norm());
  EXPECT_LE(most, (1.0 + 1e-3) * energy);
  EXPECT_LE(worst_closure, 5e-3);
  EXPECT_LT(simulation.largest_overlap_ratio(), 0.5);
}

INSTANTIATE_TEST_SUITE_P(
    Of, StructureCollision,
    testing::Values(Case{"CrossedChains", chain, chain, Vec3(0, 0, 1.2), 0.0},
                    Case{"CrossedChainsWithFriction", chain, chain, Vec3(0, 0.1, 1.2), 0.7},
                    Case{"ParallelChains", chain, chain, Vec3(0, 0, 0), 0.7},
                    Case{"ChainOnSheet", sheet, chain, Vec3(0, 0.05, 0.4), 0.7},
                    Case{"SheetOnSheet", sheet, sheet, Vec3(0, 0, 0.3), 0.0},
                    Case{"SheetOnSheetWithFriction", sheet, sheet, Vec3(0.05, 0, 0.3), 0.7},
                    Case{"SheetEdgeOnSheet", sheet, sheet, Vec3(1.2, 0.1, 0.3), 0.7}),
    [](const auto& item) { return item.param.name; });

}  // namespace
}  // namespace plekton::dynamics
