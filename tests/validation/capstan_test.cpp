// SPDX-License-Identifier: GPL-3.0-or-later
// S2 of contacts that spread: a belt over half of a fixed drum, pulled slowly at one end. While it
// slips the pull grows by dT = mu T dphi: T2 / T1 = e^(mu pi) (Euler, Eytelwein), whatever the
// stiffness of the contact and the number of links: also where the overlaps are beyond the sagitta
// of the links, and all links and the drum are one region of contact.
//
// The belt is a chain of bars without bending stiffness, which would add EI / (2 R²) to the pull.
// What swings is damped in the bars and a little by drag, which adds m 300/s 0.01 m/s < 0.04 N to a
// pull of 2.7 to 9.6 N, and by numerical damping: bars that chatter press and slip by
// turns, and are dragged along with less than mu times what they press with in the mean.
//
// PLEKTON_CAPSTAN=all runs the whole grid: E of 1e5, 1e6 and 1e7 Pa, 30 to 120 links, friction 0.1,
// 0.3 and 0.5, on a cylinder; facets: the same on a drum of facets.
#include "dynamics/simulation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

namespace plekton::test::capstan_test {
namespace {

using dynamics::Held;
using geometry::NodeId;
using geometry::Vec3;
using std::numbers::pi;

constexpr double kDrumRadius = 0.1;    // m, of its surface
constexpr double kBeltRadius = 0.005;  // m
constexpr double kHolding = 2.0;       // N
constexpr double kHalfFacet = 0.005;   // m, half thickness of the facets of a drum
constexpr int kTail = 4;               // links beside the drum

enum class Drum { cylinder, facets };

struct Case {
  double young_modulus;  ///< Pa, of both materials
  int links;             ///< on the drum
  double friction;
  Drum drum;
};

void add_drum(dynamics::Scene& scene, Drum drum) {
  const contact::MaterialId material{1};
  if (drum == Drum::cylinder) {
    const NodeId a = scene.add_node({0.0, -0.1, 0.0}, Held::everything);
    const NodeId b = scene.add_node({0.0, 0.1, 0.0}, Held::everything);
    scene.add_cylinder(a, b, kDrumRadius, material);
    return;
  }
  constexpr int kSides = 90;
  std::vector<std::array<NodeId, 2>> rows;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2.0 * pi * (i + 0.3) / kSides;
    const double r = (kDrumRadius - kHalfFacet) / std::cos(pi / kSides);
    const auto node = [&](double y) {
      return scene.add_node({r * std::cos(angle), y, r * std::sin(angle)}, Held::everything);
    };
    rows.push_back({node(-0.031), node(0.027)});
  }
  for (int i = 0; i < kSides; ++i) {
    const auto& p = rows[static_cast<std::size_t>(i)];
    const auto& q = rows[static_cast<std::size_t>((i + 1) % kSides)];
    scene.add_facet(p[0], p[1], q[1], kHalfFacet, material);
    scene.add_facet(p[0], q[1], q[0], kHalfFacet, material);
  }
}

struct Belt {
  std::vector<NodeId> nodes;
  std::vector<std::size_t> bonds;
};

/// Just touching, with straight ends that hang down on both sides.
Belt add_belt(dynamics::Scene& scene, int links) {
  const auto section = dynamics::bar_section(kBeltRadius, 1e7);
  const double middle = kDrumRadius + kBeltRadius;  // m, of the links' middles from the axis
  const double half = 0.5 * pi / links;
  const double length = 2.0 * middle * std::tan(half);
  Belt belt;
  for (int i = -kTail; i <= links + kTail; ++i) {
    Vec3 x;
    if (i < 0 || i > links) {
      const double below = length * (i < 0 ? -i : i - links);
      x = Vec3(i < 0 ? middle : -middle, 0.0, -below);
    } else {
      const double angle = pi * i / links;
      const double r = i == 0 || i == links ? middle : middle / std::cos(half);
      x = Vec3(r * std::cos(angle), 0.0, r * std::sin(angle));
    }
    const bool is_pulled = i == links + kTail;
    belt.nodes.push_back(
        scene.add_node(x, is_pulled ? Held::rotation : Held::rotation | Held::along_y));
    if (belt.nodes.size() < 2) continue;
    const NodeId last = belt.nodes[belt.nodes.size() - 2];
    belt.bonds.push_back(scene.add_beam(last, belt.nodes.back(), section, 400.0));
    scene.add_cylinder(last, belt.nodes.back(), kBeltRadius, contact::MaterialId{0});
  }
  return belt;
}

struct Pulled {
  double ratio;    ///< of the mean pulls at both ends while it slips
  double overlap;  ///< largest, over the radius of the belt
  double closure;  ///< of the energy
};

Pulled pull(const Case& of) {
  dynamics::Scene scene;
  const contact::Material material{
      .young_modulus = of.young_modulus, .stiffness_ratio = 0.5, .friction = of.friction};
  scene.materials = {material, material};
  add_drum(scene, of.drum);
  Belt belt = add_belt(scene, of.links);
  // The free end is held by a weight, the other one goes down, slowly at first.
  constexpr double kEnd = 0.6;     // s
  constexpr double kSpeed = 0.01;  // m/s
  dynamics::NodalForce weight;
  weight.nodes = {belt.nodes.front()};
  weight.force = Vec3(0.0, 0.0, -kHolding);
  weight.factor = dynamics::TimeTable({{0.0, 0.0}, {0.1, 1.0}});
  scene.loads.forces.push_back(weight);
  dynamics::PrescribedMotion down;
  down.nodes = {belt.nodes.back()};
  down.velocity = Vec3(0.0, 0.0, -kSpeed);
  // Faster at first, until the belt is stretched and all of it slips.
  down.factor = dynamics::TimeTable({{0.1, 0.0}, {0.12, 4.0}, {0.25, 4.0}, {0.28, 1.0}});
  scene.loads.motions.push_back(down);
  dynamics::BeamDamping damping;
  damping.bonds = belt.bonds;
  damping.ratio = 0.5;
  scene.loads.beam_damping.push_back(damping);
  scene.loads.mass_damping.push_back(
      {std::vector<NodeId>(belt.nodes.begin(), belt.nodes.end() - 1), 300.0});
  dynamics::SimulationOptions options;
  options.motion.damping = 0.1;

  dynamics::Simulation simulation(scene, options);
  double held = 0.0, pulled = 0.0, deepest = 0.0;
  while (simulation.time() < kEnd) {
    simulation.step();
    if (simulation.time() < 0.35) continue;
    const double dt = simulation.time_step();
    held += dt * simulation.bond_forces(belt.bonds.front()).tension;
    pulled += dt * simulation.bond_forces(belt.bonds.back()).tension;
    deepest = std::max(deepest, simulation.contacts().largest_overlap_ratio());
  }
  return {pulled / held, deepest, simulation.energy().closure()};
}

void expect_euler(const Case& of) {
  const Pulled found = pull(of);
  const double expected = std::exp(of.friction * pi);
  std::printf(
      "E %.0e Pa, %3d links, friction %.1f, %s: T2/T1 %.4f, %+.2f %%; overlap %.3f; closure %.1e\n",
      of.young_modulus, of.links, of.friction, of.drum == Drum::cylinder ? "cylinder" : "facets",
      found.ratio, 100.0 * (found.ratio / expected - 1.0), found.overlap, found.closure);
  EXPECT_NEAR(found.ratio, expected, 0.05 * expected);
}

/// Of the grid, or those that a run of all tests has time for.
std::vector<Case> cases() {
  const char* const grid = std::getenv("PLEKTON_CAPSTAN");
  if (grid == nullptr)
    return {{1e5, 30, 0.3, Drum::cylinder},
            {1e7, 30, 0.5, Drum::cylinder},
            {1e5, 30, 0.3, Drum::facets}};
  const Drum drum = std::string(grid) == "facets" ? Drum::facets : Drum::cylinder;
  std::vector<Case> all;
  for (const int links : {30, 60, 120})
    for (const double young_modulus : {1e5, 1e6, 1e7})
      for (const double friction : {0.1, 0.3, 0.5})
        all.push_back({young_modulus, links, friction, drum});
  return all;
}

TEST(Capstan, PullsByEulersFormula) {
  for (const Case& of : cases()) expect_euler(of);
}

}  // namespace
}  // namespace plekton::test::capstan_test
