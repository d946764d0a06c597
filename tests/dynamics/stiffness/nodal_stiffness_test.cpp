// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/stiffness/nodal_stiffness.hpp"

#include "dynamics/structure/beam_stiffness.hpp"
#include "tests/support/stiffness_reference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace plekton::test::nodal_stiffness_test {
namespace {

using dynamics::CriticalStep;
using dynamics::NodalStiffness;

constexpr double kRounding = 1.0 + 1e-7;  // of numerically differentiated stiffness matrices

CriticalStep estimate(const Scene& scene) {
  NodalStiffness stiffness(scene.state.size());
  for (const BeamBond& bond : scene.bonds) add_beam(stiffness, bond, scene.state);
  return stiffness.critical_step(scene.properties);
}

struct Chain {
  double radius;    // m, the bonds are 0.1 m long
  double critical;  // s, 2 / omega_max
};
// Chains of 10 bonds, E = 1e8 Pa, nu = 0.3, 1000 kg/m³; omega_max of the lumped Euler-Bernoulli
// matrix, at which the leapfrog was seen to become unstable to 0.2 %.
constexpr std::array<Chain, 4> kChains{
    {{0.05, 2.168e-4}, {0.02, 2.300e-4}, {0.005, 2.309e-4}, {0.1, 1.628e-4}}};

TEST(TimeStep, OfAChainIsJustBelowWhatTheWholeMatrixGives) {
  for (const auto& [radius, critical] : kChains) {
    const Scene scene = chain(10, 1.0, dynamics::circular_section(radius, 1e8, 0.3));

    const double limit = true_limit(scene);
    const double dt = estimate(scene).dt;

    EXPECT_NEAR(limit, critical, 0.5e-7);  // the reference has four digits
    EXPECT_LE(dt, limit * kRounding);
    EXPECT_GT(dt, 0.85 * limit);
    // Element by element (Fried): omega² <= (c / L)² (7.5 + 12 (r / L)²).
    const double fried =
        2.0 * 0.1 / std::sqrt(1e8 / 1000.0) / std::sqrt(7.5 + 12.0 * radius * radius / 0.01);
    EXPECT_NEAR(dt, fried, 1e-12 * fried);
  }
}

TEST(TimeStep, OfAnyFrameIsNeverAboveTheTrueLimit) {
  Random random(1);
  double smallest = 1.0;
  for (int i = 0; i < 300; ++i) {
    const Scene scene = random_frame(random);

    const double ratio = estimate(scene).dt / true_limit(scene);

    EXPECT_LE(ratio, kRounding);
    smallest = std::min(smallest, ratio);
  }
  EXPECT_GT(smallest, 0.15);  // a guard: inertias here are up to 1e4 times off those of a ball
}

TEST(TimeStep, HoldsForStretchedAndBentFrames) {
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    Scene scene = random_frame(random);
    Eigen::VectorXd displacement(first_entry(scene.state.size()));
    for (Eigen::Index k = 0; k < displacement.size(); k += 3) {
      displacement.segment<3>(k) = random.in_cube(k % 6 == 0 ? 0.05 : 0.2);
    }
    scene.state = displaced(scene.state, displacement);

    EXPECT_LE(estimate(scene).dt, true_limit(scene) * kRounding);
  }
}

// A node moves along the bars of one direction and across those of the other, which are taut.
TEST(TimeStep, CountsTheTensionOfANetStretchedFar) {
  constexpr std::size_t kSide = 6;
  dynamics::BeamSection bar = dynamics::circular_section(0.01, 1e6, 0.3);
  bar.second_moment = bar.torsion_constant = 0.0;
  Scene scene;
  for (std::size_t i = 0; i < kSide * kSide; ++i) {
    const NodeId node = scene.add_node(
        0.1 * Vec3(static_cast<double>(i % kSide), static_cast<double>(i / kSide), 0.0));
    if (i % kSide > 0) scene.add_beam(geometry::id_at<NodeId>(i - 1), node, bar, 1000.0);
    if (i >= kSide) scene.add_beam(geometry::id_at<NodeId>(i - kSide), node, bar, 1000.0);
  }
  const double at_rest = estimate(scene).dt;
  for (Vec3& position : scene.state.position) position *= 4.0;

  const double dt = estimate(scene).dt;

  EXPECT_LE(dt, true_limit(scene) * kRounding);
  EXPECT_GT(dt, 0.9 * true_limit(scene));
  EXPECT_LT(dt, 0.9 * at_rest);
}

TEST(TimeStep, OfContactsIsNeverAboveTheTrueLimit) {
  constexpr std::size_t kNodes = 8;
  Random random(3);
  double smallest = 1.0;
  for (int i = 0; i < 300; ++i) {
    NodeProperties properties;
    for (std::size_t n = 0; n < kNodes; ++n) {
      properties.mass.push_back(std::abs(random.signed_power(-1.0, 1.0)));
      properties.inertia.push_back(0.4 * properties.mass.back() *
                                   std::abs(random.signed_power(-1.0, 0.0)));
      properties.held.push_back(n > 5 && random.coin() ? Held::everything : Held::nothing);
    }
    ContactMatrix exact(kNodes);
    NodalStiffness stiffness(kNodes);
    for (int k = 0; k < 12; ++k) {
      const ContactStiffness contact{random.direction(), std::abs(random.signed_power(-1.0, 1.0)),
                                     std::abs(random.signed_power(-2.0, 1.0)),
                                     random.uniform(0.1, 1.0), random.uniform(0.1, 1.0)};
      const auto node = [&](std::size_t n) { return geometry::id_at<NodeId>(n); };
      const std::size_t ball = random.index(4);
      const std::size_t other = (ball + 1 + random.index(3)) % 4;
      const double w = random.unit();
      const double v = (1.0 - w) * random.unit();
      const geometry::CorePoint core{{node(4), node(5), node(6 + random.index(2))},
                                     Vec3(w, v, 1.0 - w - v),
                                     geometry::Feature(geometry::FaceId{0})};
      switch (k % 3) {
        case 0:
          exact.add(node(ball), geometry::core_point(node(other)), contact);
          stiffness.add_pair(node(ball), node(other), contact);
          break;
        case 1:
          exact.add(node(ball), core, contact);
          stiffness.add_on_surface(node(ball), core, contact);
          break;
        default:
          exact.add_wall(node(ball), contact);
          stiffness.add_to_wall(node(ball), contact);
      }
    }

    const double ratio =
        stiffness.critical_step(properties).dt / true_limit(exact.matrix(), properties);

    EXPECT_LE(ratio, kRounding);
    smallest = std::min(smallest, ratio);
  }
  EXPECT_GT(smallest, 0.4);
}

TEST(TimeStep, OfOneContactBetweenEqualBallsIsExact) {
  const NodeProperties properties{{2.0, 2.0}, {0.1, 0.1}, {Held::nothing, Held::nothing}};
  const ContactStiffness contact{Vec3(0.6, 0.8, 0.0), 10.0, 7.0, 0.5, 0.5};
  NodalStiffness pair(2);
  NodalStiffness wall(2);

  pair.add_pair(NodeId{0}, NodeId{1}, contact);
  wall.add_to_wall(NodeId{1}, contact);

  // Shear moves and turns a ball at once: omega² = k_s (1 / m + arm² / I), twice that for two
  // balls.
  const double rate = 7.0 * (1.0 / 2.0 + 0.25 / 0.1);
  EXPECT_NEAR(pair.critical_step(properties).dt, 2.0 / std::sqrt(2.0 * rate), 1e-14);
  EXPECT_NEAR(wall.critical_step(properties).dt, 2.0 / std::sqrt(rate), 1e-14);
  EXPECT_TRUE(wall.critical_step(properties).rotation);
  EXPECT_EQ(wall.critical_step(properties).node, NodeId{1});
}

TEST(TimeStep, OfOneContactBetweenAHeavyAndALightSphereIsExactWhereMassesAreKnown) {
  const NodeProperties properties{{2.0, 0.01}, {0.1, 0.1}, {Held::nothing, Held::nothing}};
  NodalStiffness pair(2, &properties);

  pair.add_pair(NodeId{0}, NodeId{1}, {Vec3(0.6, 0.8, 0.0), 10.0, 0.0, 0.5, 0.5});

  const double exact = 2.0 / std::sqrt(10.0 * (1.0 / 2.0 + 1.0 / 0.01));
  EXPECT_NEAR(pair.critical_step(properties).dt, exact, 1e-12 * exact);
}

TEST(TimeStep, DoesNotDependOnWhichSphereOfAPairIsNamedFirst) {
  const NodeProperties properties{
      {1.0, 9.0, 9.0}, {0.1, 9.0, 9.0}, std::vector<Held>(3, Held::nothing)};
  const Vec3 n(0.0, 0.6, 0.8);  // from ball 0 to both others, which lie on the same side of it
  const auto step = [&](bool swaps_first, bool swaps_second) {
    NodalStiffness stiffness(3);
    const auto add = [&](NodeId other, bool swaps) {
      if (swaps) {
        stiffness.add_pair(other, NodeId{0}, {-n, 10.0, 7.0, 0.4, 0.5});
      } else {
        stiffness.add_pair(NodeId{0}, other, {n, 10.0, 7.0, 0.5, 0.4});
      }
    };
    add(NodeId{1}, swaps_first);
    add(NodeId{2}, swaps_second);
    return stiffness.critical_step(properties).dt;
  };

  EXPECT_DOUBLE_EQ(step(false, true), step(false, false));
  EXPECT_DOUBLE_EQ(step(true, true), step(false, false));
}

// A heavy sphere on the middle of a light cylinder: the contact stiffness acts on its light nodes.
// dt_c = 2 / sqrt(k (1 / m_sphere + 1 / (2 m_node))) = 2.6515e-5 s.
TEST(TimeStep, CountsContactsOnTheNodesOfACylinder) {
  constexpr double kNormal = 2.857142857e7;
  constexpr double kNodeMass = 0.002513274123;
  constexpr double kSphereMass = 5.235987756;
  NodeProperties properties{{kNodeMass, kNodeMass, kSphereMass},
                            {1.0, 1.0, 1.0},
                            {Held::nothing, Held::nothing, Held::nothing}};
  const geometry::CorePoint middle{{NodeId{0}, NodeId{1}, NodeId{1}},
                                   Vec3(0.5, 0.5, 0.0),
                                   geometry::Feature(geometry::EdgeId{0})};
  NodalStiffness stiffness(3);

  stiffness.add_on_surface(NodeId{2}, middle, {Vec3::UnitZ(), kNormal, 0.0, 0.05, 0.02});

  const CriticalStep step = stiffness.critical_step(properties);
  EXPECT_LE(step.dt, 2.6515e-5);
  EXPECT_GE(step.dt, 0.5 * 2.6515e-5);
  EXPECT_EQ(step.node, NodeId{0});
  EXPECT_FALSE(step.rotation);
}

TEST(TimeStep, IsTheShortestOfAllPiecesOfTheNodes) {
  constexpr std::size_t kNodes = 23;
  const NodeProperties properties{std::vector<double>(kNodes, 1.0),
                                  std::vector<double>(kNodes, 1.0),
                                  std::vector<Held>(kNodes, Held::nothing)};
  NodalStiffness whole(kNodes);
  NodalStiffness piece(5);
  const auto add_to = [](NodalStiffness& stiffness) {
    for (std::size_t i = 1; i < kNodes; ++i) {
      const double k = 1.0 + static_cast<double>(i * i % 11);
      stiffness.add_pair(geometry::id_at<NodeId>(i - 1), geometry::id_at<NodeId>(i),
                         {Vec3::UnitX(), k, 0.5 * k, 1.0, 2.0});
      stiffness.add(geometry::id_at<NodeId>(i), {k, 0.1 * k});
    }
  };
  add_to(whole);
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t first = 0; first < kNodes; first += piece.node_count()) {
    piece.begin_at(first);
    add_to(piece);
    shortest = std::min(shortest, piece.critical_step(properties).dt);
  }

  EXPECT_EQ(shortest, whole.critical_step(properties).dt);
}

// Spheres in the densest packing: those with even sums of integer coordinates, radius 1 / sqrt(2).
TEST(TimeStep, OfAnExpectedDensePackingHoldsForTheDensestOne) {
  const double radius = std::sqrt(0.5);
  std::vector<Vec3> centres;
  for (int x = 0; x <= 4; ++x) {
    for (int y = 0; y <= 4; ++y) {
      for (int z = 0; z <= 4; ++z) {
        if ((x + y + z) % 2 == 0) centres.push_back(Vec3(x, y, z));
      }
    }
  }
  const NodeProperties properties{std::vector<double>(centres.size(), 1.0),
                                  std::vector<double>(centres.size(), 0.4 * radius * radius),
                                  std::vector<Held>(centres.size(), Held::nothing)};
  for (const double ratio : {0.0, 0.3, 0.5, 1.0}) {
    ContactMatrix exact(centres.size());
    NodalStiffness expected(centres.size());
    for (std::size_t a = 0; a < centres.size(); ++a) {
      expected.add(geometry::id_at<NodeId>(a), dynamics::in_dense_packing(1.0, ratio, radius));
      for (std::size_t b = a + 1; b < centres.size(); ++b) {
        const Vec3 d = centres[b] - centres[a];
        if (d.squaredNorm() > 2.1) continue;
        exact.add(geometry::id_at<NodeId>(a), geometry::core_point(geometry::id_at<NodeId>(b)),
                  {d.normalized(), 1.0, ratio, radius, radius});
      }
    }

    const double limit = true_limit(exact.matrix(), properties);
    const double dt = expected.critical_step(properties).dt;

    EXPECT_LE(dt, limit * kRounding);
    EXPECT_GT(dt, 0.75 * limit);
  }
}

TEST(TimeStep, NamesTheNodeThatLimitsIt) {
  Scene scene = chain(3, 1.0, dynamics::circular_section(0.05, 1e8, 0.3));
  scene.properties.inertia[2] *= 0.1;

  const CriticalStep step = estimate(scene);

  EXPECT_EQ(step.node, NodeId{2});
  EXPECT_TRUE(step.rotation);
}

TEST(TimeStep, IsInfiniteWhereNothingIsStiffAndFree) {
  Scene scene = chain(1, 1.0, dynamics::circular_section(0.05, 1e8, 0.3));
  scene.properties.held = {Held::everything, Held::everything};

  const CriticalStep step = estimate(scene);

  EXPECT_TRUE(std::isinf(step.dt));
  EXPECT_EQ(step.node, NodeId{-1});
}

}  // namespace
}  // namespace plekton::test::nodal_stiffness_test
