// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/wrapped_joints.hpp"

#include "contact/law/hertz_mindlin.hpp"
#include "contact/law/linear_frictional.hpp"
#include "tests/support/bodies_of_cells.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

/// Chains of bars that wrap around a body.
namespace plekton::test::wrapped_joints_test {
namespace {

using std::numbers::pi;

constexpr double kRange = 1.0;

/// A chain over half of a drum along z whose links' middles are so much nearer than the range.
Body belt(int links, double overlap, double turn = 0.0) {
  Body body;
  const double r = (kRange - overlap) / std::cos(0.5 * pi / links);
  for (int i = 0; i <= links; ++i) {
    const double angle = pi * i / links + turn;
    body.x.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
    if (i > 0) body.cylinders.push_back({i - 1, i});
  }
  return body;
}

Body drum(int parts) {
  Body body;
  for (int i = 0; i <= parts; ++i) body.x.emplace_back(0.0, 0.0, 4.0 * i / parts - 1.7);
  for (int i = 0; i < parts; ++i) body.cylinders.push_back({i, i + 1});
  return body;
}

/// N, sum of all forces away from the axis.
template <class Law>
double push(const StructurePairUnder<Law>& structure_pair) {
  double sum = 0.0;
  for (std::size_t i = structure_pair.first_node_of_b(); i < structure_pair.positions().size();
       ++i) {
    const Vec3& x = structure_pair.positions()[i];
    sum += structure_pair.forces()[i].dot(Vec3(x.x(), x.y(), 0.0).normalized());
  }
  return sum;
}

double push_of_belt(int links, double overlap, int parts = 1) {
  StructurePair structure_pair(drum(parts), belt(links, overlap), kRange);
  structure_pair.place(belt(links, overlap));
  return push(structure_pair);
}

/// J. Integral of w1 over a bar at a distance h from the axis, from its foot to a distance t along
/// it, w1(d) = (s0 arccosh(s0 / d) - sqrt(s0² - d²)) / pi with s0 = 1: Abel's inversion of a linear
/// spring, so that a straight bar has (s0 - h)² / 2.
double additive_energy(double h, double t) {
  const double square = 1.0 - h * h - t * t;
  if (square <= 0.0) return 0.25 * (1.0 - h) * (1.0 - h);
  const double q = std::sqrt(square);
  return (t * std::acosh(1.0 / std::hypot(h, t)) - 0.5 * t * q +
          0.5 * (h * h + 1.0) * std::atan(t / q) - h * std::atan(t / (h * q))) /
         pi;
}

/// N, of a belt under the additive rule, whose two end bars go on: an end counts as one contact.
double additive_push(int links, double overlap) {
  const double half = 0.5 * pi / links;
  const auto energy = [&](double h) {
    return 2.0 * (links - 1) * additive_energy(h, h * std::tan(half)) + 0.5 * (1.0 - h) * (1.0 - h);
  };
  const double h = 1.0 - overlap, step = 1e-6;
  return std::cos(half) * (energy(h - step) - energy(h + step)) / (2.0 * step);
}

// In an even wrap all is given back but for terms of the order of c², and levels have the width of
// a parabola, which leaves out terms of the order of the overlap over the distance, a tenth of it.
TEST(Wrap, IsAsStiffAsTheIntegralOverTheChain) {
  for (const int links : {20, 40, 80, 160, 320}) {
    for (const double overlap : {5e-3, 2e-2, 5e-2}) {
      const double expected = additive_push(links, overlap);
      EXPECT_NEAR(push_of_belt(links, overlap), expected, 0.01 * expected)
          << links << " links at " << overlap;
    }
  }
}

// S2. The sagitta of 20 links is 3.1e-3.
TEST(Wrap, HasTheSameStiffnessForAnyLinksOnceOverlapsExceedTheirSagitta) {
  for (const double overlap : {5e-3, 2e-2, 5e-2}) {
    double least = INFINITY, most = 0.0;
    for (const int links : {20, 30, 40, 60, 80, 120, 160}) {
      const double found = push_of_belt(links, overlap);
      least = std::min(least, found);
      most = std::max(most, found);
    }
    EXPECT_LT(most, 1.2 * least) << "at " << overlap;
  }
}

TEST(Wrap, DoesNotDependOnTheDrumsParts) {
  for (const double overlap : {1e-3, 2e-2}) {
    const double expected = push_of_belt(40, overlap, 1);
    for (const int parts : {2, 5, 13})
      EXPECT_NEAR(push_of_belt(40, overlap, parts), expected, 1e-10 * expected);
  }
}

TEST(Wrap, IsNothingWhereAChainIsStraightOrBendsAway) {
  for (const double bend : {0.0, -1e-3, -0.3}) {
    std::array<contact::WrapArm, 2> arms;
    arms[0].bar = Vec3(0.3, 0.1, -bend);
    arms[1].bar = Vec3(-0.6, -0.2, -2.0 * bend);
    const auto wrap = contact::wrap_share(Vec3(0.0, 0.0, 0.9), kRange, arms);
    EXPECT_EQ(wrap.contacts, 0.0) << bend;
    EXPECT_TRUE(wrap.by_separation.isZero(0.0));
  }
}

/// Largest difference of the forces from the gradient of the energy by central differences, over
/// the largest force.
template <class Law>
double gradient_error(const Body& a, const Body& b, double range, double step) {
  StructurePairUnder<Law> at(a, b, range);
  at.place(b);
  double largest = 0.0, error = 0.0;
  for (const Vec3& force : at.forces()) largest = std::max(largest, force.norm());
  const auto energy = [&](bool of_a, std::size_t node, int axis, double way) {
    Body moved_a = a, moved_b = b;
    (of_a ? moved_a : moved_b).x[node][axis] += way;
    StructurePairUnder<Law> there(moved_a, moved_b, range);
    there.place(moved_b);
    return there.energy();
  };
  for (const bool of_a : {true, false}) {
    for (std::size_t node = 0; node < (of_a ? a : b).x.size(); ++node) {
      for (int axis = 0; axis < 3; ++axis) {
        // Richardson: the error falls with the fourth power of the step.
        const auto slope = [&](double way) {
          return (energy(of_a, node, axis, way) - energy(of_a, node, axis, -way)) / (2.0 * way);
        };
        const double by = (4.0 * slope(0.5 * step) - slope(step)) / 3.0;
        const Vec3& force = at.forces()[node + (of_a ? 0 : at.first_node_of_b())];
        error = std::max(error, std::abs(force[axis] + by));
      }
    }
  }
  return error / largest;
}

/// A belt with bends and unequal bars in space.
Body crooked(Body body, unsigned seed, double by) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-by, by);
  for (Vec3& x : body.x) x += Vec3(shift(random), shift(random), shift(random));
  return body;
}

TEST(Wrap, PushesAllNodesByTheGradientOfItsEnergy) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const Body around = crooked(belt(12, 0.03), seed, 0.01);
    const Body along = crooked(drum(3), seed + 10, 0.01);
    EXPECT_LT(gradient_error<contact::LinearFrictional>(along, around, kRange, 2e-5), 1e-7) << seed;
    EXPECT_LT(gradient_error<contact::HertzMindlin>(along, around, kRange, 2e-5), 1e-7) << seed;
  }
}

/// A prism around z whose inner radius is so large.
Body prism(int sides, double radius) {
  Body body;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * pi * (i + 0.3) / sides;
    const double r = radius / std::cos(pi / sides);
    for (const double z : {-0.53, 0.41})
      body.x.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  for (int i = 0; i < sides; ++i) {
    const int p = 2 * i, q = 2 * ((i + 1) % sides);
    body.facets.push_back({p, q, q + 1});
    body.facets.push_back({p, q + 1, p + 1});
  }
  return body;
}

TEST(Wrap, PushesAllNodesOfFacetsToo) {
  constexpr double kThin = 0.2;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Body inside = crooked(prism(9, kRange - kThin), seed + 20, 0.01);
    const Body around = crooked(belt(12, 0.03), seed, 0.01);
    EXPECT_LT(gradient_error<contact::LinearFrictional>(inside, around, kThin, 2e-6), 1e-7) << seed;
  }
}

TEST(Wrap, KeepsBothMomenta) {
  const Body around = crooked(belt(30, 0.02), 5, 0.01);
  const Body along = crooked(drum(3), 15, 0.01);
  StructurePair structure_pair(along, around, kRange);
  structure_pair.place(around);
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double size = 0.0;
  for (std::size_t i = 0; i < structure_pair.positions().size(); ++i) {
    force += structure_pair.forces()[i];
    moment += structure_pair.positions()[i].cross(structure_pair.forces()[i]);
    size += structure_pair.forces()[i].norm();
  }
  EXPECT_LT(force.norm(), 1e-12 * size);
  EXPECT_LT(moment.norm(), 1e-12 * size);
}

// A joint that passes from one side of straight to the other: the force changes in proportion to
// the way, ten times for ten times.
TEST(Wrap, SetsInWithoutAJump) {
  const auto bent = [](double height) {
    Body body;
    body.x = {{-0.3, 0.0, 0.95}, {0.02, 0.0, 0.95 + height}, {0.34, 0.0, 0.95}};
    body.cylinders = {{0, 1}, {1, 2}};
    return body;
  };
  Body across;
  across.x = {{0.0, -2.0, 0.0}, {0.0, 2.0, 0.0}};
  across.cylinders = {{0, 1}};
  StructurePair structure_pair(across, bent(0.0), kRange);
  const auto largest_change = [&](double step) {
    double largest = 0.0;
    std::vector<Vec3> last;
    for (int i = -20; i <= 20; ++i) {
      structure_pair.place(bent(step * i));
      for (std::size_t k = 0; k < last.size(); ++k)
        largest = std::max(largest, (structure_pair.forces()[k] - last[k]).norm());
      last = structure_pair.forces();
    }
    return largest;
  };
  const double fine = largest_change(1e-7), coarse = largest_change(1e-6);
  EXPECT_LT(coarse, 1e-3 * 0.05);
  EXPECT_LT(fine, 0.11 * coarse);
}

// A belt that is turned on its drum slips everywhere at once: torque mu N R about the axis, whether
// its bars touch one by one or all are one region of contact.
TEST(Wrap, ResistsSlipByAllThatPresses) {
  constexpr double kFriction = 0.3;
  for (const int links : {20, 60, 160}) {
    for (const double overlap : {1e-3, 5e-3, 2e-2}) {
      StructurePairUnder<contact::LinearFrictional> structure_pair(drum(1), belt(links, overlap),
                                                                   kRange, {}, 1.0, kFriction);
      structure_pair.place(belt(links, overlap));
      for (int i = 1; i <= 100; ++i) structure_pair.slide(belt(links, overlap, 4e-4 * i));
      const double torque = -structure_pair.moment_on_b(Vec3::Zero()).z();
      // Forces act on the middle between both axes' surfaces; pushes and arms are less by the
      // overlap there.
      EXPECT_NEAR(torque, kFriction * push(structure_pair), 0.02 * torque)
          << links << " at " << overlap;
    }
  }
}

}  // namespace
}  // namespace plekton::test::wrapped_joints_test
