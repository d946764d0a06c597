// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step/spread_stiffness.hpp"

#include "dynamics/model/scene.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace plekton::dynamics::spread_stiffness_test {
namespace {

using test::Random;

constexpr double kStiffness = 1000.0;  // N/m, of one contact
constexpr double kDifference = 1e-6;   // m
/// N/m: of places of 1 m, eps / 1e-6 m of some contacts is left of rounding.
constexpr double kRounding = 1e-5;

/// Two balls, nodes 0 and 1, and the corners of a facet, nodes 2 to 4; all free.
Scene two_balls_on_a_facet() {
  Scene scene;
  for (const Vec3& x :
       {Vec3(0.2, 0.2, 0.5), Vec3(0.5, 0.3, 0.5), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}) {
    scene.add_node(x);
    scene.properties.mass.back() = 1.0 + 0.5 * static_cast<double>(scene.state.size());
    scene.properties.inertia.back() = 1.0;
  }
  return scene;
}

/// A term of a ball on the facet. @param weight  of the force of one contact
struct Term {
  NodeId ball;
  double weight;
  geometry::CorePoint core;
  Vec3 normal;
};

Term term_of(Random& random, NodeId ball, double weight) {
  const double u = random.uniform(0.1, 0.4), v = random.uniform(0.1, 0.4);
  return {ball,
          weight,
          {{NodeId{2}, NodeId{3}, NodeId{4}},
           Vec3(u, v, 1.0 - u - v),
           geometry::Feature(geometry::FaceId{0})},
          random.direction()};
}

ContactSprings springs_of(const std::vector<Term>& terms) {
  ContactSprings springs;
  for (const Term& term : terms) {
    ContactStiffness contact{term.normal, kStiffness * std::max(1.0, std::abs(term.weight)), 0.0,
                             0.0, 0.0};
    contact.weight = term.weight;
    springs.add_on_surface(term.ball, term.core, contact, {5.0, 0.5, Vec3::Ones()});
  }
  return springs;
}

/// Adds the forces of the terms with their weights as they are: k weight along the normal.
void add_forces(const std::vector<Term>& terms, const Scene& scene, geometry::Positions x,
                NodeForces& forces) {
  for (const Term& term : terms) {
    const auto moved = [&](NodeId node) -> Vec3 {
      return x[index_of(node)] - scene.state.position[index_of(node)];
    };
    Vec3 way = -moved(term.ball);
    for (std::size_t k = 0; k < 3; ++k)
      way += term.core.weights[static_cast<Eigen::Index>(k)] * moved(term.core.nodes[k]);
    const Vec3 force = kStiffness * term.weight * term.normal.dot(way) * term.normal;
    forces.force[index_of(term.ball)] += force;
    for (std::size_t k = 0; k < 3; ++k)
      forces.force[index_of(term.core.nodes[k])] -=
          term.core.weights[static_cast<Eigen::Index>(k)] * force;
  }
}

struct Looked {
  bool is_any;
  NodalStiffness added;
};

/// What is added where the forces are those of all terms, and others (N) besides.
template <class Others>
Looked look(const std::vector<Term>& terms, const Scene& scene, const Others& others) {
  const geometry::Surface surface;
  const RigidNodes rigid;
  SpreadStiffness spread(surface, rigid);
  ContactSprings springs = springs_of(terms);
  Looked looked{spread.begin(springs, scene.state.size()), NodalStiffness(scene.state.size())};
  if (!looked.is_any) return looked;
  std::vector<Term> asked;
  for (const Term& term : terms)
    if (spread.is_spread(term.ball)) asked.push_back(term);
  spread.add_to(looked.added, springs, scene.properties, {scene.state.position, kDifference},
                [&](geometry::Positions x, NodeForces& forces, contact::PatchFinder&) {
                  add_forces(asked, scene, x, forces);
                  others(x, forces);
                });
  return looked;
}

constexpr auto kNothing = [](geometry::Positions, NodeForces&) {};

TEST(SpreadStiffness, IsOfBallsWithATermThatIsNotOneContact) {
  Random random(131);
  const Scene scene = two_balls_on_a_facet();
  const geometry::Surface surface;
  const RigidNodes rigid;
  SpreadStiffness spread(surface, rigid);
  // One contact, or a pass between two, but for rounding.
  ContactSprings whole =
      springs_of({term_of(random, NodeId{0}, 1.0), term_of(random, NodeId{0}, -1.0),
                  term_of(random, NodeId{1}, 1.0 - 1e-9)});
  EXPECT_FALSE(spread.begin(whole, scene.state.size()));

  for (const double weight : {0.999, 2.0, -0.5}) {
    ContactSprings parts =
        springs_of({term_of(random, NodeId{0}, 1.0), term_of(random, NodeId{1}, weight)});
    EXPECT_TRUE(spread.begin(parts, scene.state.size()));
    EXPECT_FALSE(spread.is_spread(NodeId{0}));
    EXPECT_TRUE(spread.is_spread(NodeId{1}));
    // Of the ball that is spread alone the springs against turning are left out.
    int turning = 0, left_out = 0;
    parts.for_each(
        [&](const ContactStiffness& contact, std::span<const SpringEnd> ends, std::size_t) {
          const bool is_on_surface = contact.elastic_stiffness() >= kStiffness;
          if (is_on_surface) return;
          ++turning;
          left_out += contact.normal_stiffness == 0.0 && ends[0].node == NodeId{1};
        });
    EXPECT_EQ(turning, 2);
    EXPECT_EQ(left_out, 1);
  }
}

/// Where the forces are those of the springs with their weights, nothing is left to be added.
TEST(SpreadStiffness, IsNothingWhereTheSpringsOfTheTermsAreAllThereIs) {
  Random random(132);
  const Scene scene = two_balls_on_a_facet();
  for (int trial = 0; trial < 20; ++trial) {
    const std::vector<Term> terms{term_of(random, NodeId{0}, 0.4), term_of(random, NodeId{0}, 1.7),
                                  term_of(random, NodeId{0}, -0.3),
                                  term_of(random, NodeId{1}, 1.0)};

    const Looked looked = look(terms, scene, kNothing);

    ASSERT_TRUE(looked.is_any);
    EXPECT_LT(looked.added.total().translation, 15.0 * kRounding);
    EXPECT_EQ(looked.added.total().rotation, 0.0);
  }
}

/// Beyond them each node gets its mass times the rate of what is left: of a spring K between ball 0
/// and node 2 along x K (1/m + 1/m), whichever sign it has.
TEST(SpreadStiffness, IsTheRateOfWhatIsLeftTimesTheMassOfEachNode) {
  Random random(133);
  const Scene scene = two_balls_on_a_facet();
  const std::vector<double>& mass = scene.properties.mass;
  for (const double spring : {200.0, -300.0}) {
    const std::vector<Term> terms{term_of(random, NodeId{0}, 0.4), term_of(random, NodeId{0}, 0.6)};

    const Looked looked = look(terms, scene, [&](geometry::Positions x, NodeForces& forces) {
      const Vec3 way = (x[2] - scene.state.position[2]) - (x[0] - scene.state.position[0]);
      const Vec3 force = spring * way.x() * Vec3::UnitX();
      forces.force[0] += force;
      forces.force[2] -= force;
    });

    const double rate = std::abs(spring) * (1.0 / mass[0] + 1.0 / mass[2]);
    // The same along all axes, for the ball and the corners: the other ball takes no part.
    const double masses = mass[0] + mass[2] + mass[3] + mass[4];
    EXPECT_NEAR(looked.added.total().translation, 3.0 * rate * masses, 1e-6 * rate * masses);
    EXPECT_NEAR(looked.added.critical_step(scene.properties).dt, 2.0 / std::sqrt(rate),
                1e-6 / std::sqrt(rate));
    EXPECT_EQ(looked.added.rate_of(NodeId{1}, scene.properties), 0.0);
  }
}

}  // namespace
}  // namespace plekton::dynamics::spread_stiffness_test
