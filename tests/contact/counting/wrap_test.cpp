// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/counting/wrap.hpp"

#include "tests/support/contact_surfaces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

/// What wires and nets that wrap a ball push with (S1 and S8 of the open points of contacts that
/// spread). The range is 1 m and springs have 1 N/m. That the energy is the one of its levels is
/// checked in patch_reference_test, that the force is its gradient in contact_energy_test.
namespace plekton::test::wrap_test {
namespace {

/// A wire around the ball's lower half, all its bars as deep.
Complex half_hoop(int bars, double overlap) {
  Complex hoop;
  const double radius = (1.0 - overlap) / std::cos(0.5 * std::numbers::pi / bars);
  for (int i = 0; i <= bars; ++i) {
    const double angle = std::numbers::pi * i / bars;
    hoop.node(radius * Vec3(std::cos(angle), 0.0, -std::sin(angle)));
  }
  for (int i = 0; i < bars; ++i) hoop.cylinder(i, i + 1);
  return hoop;
}

/// A square net of n x n meshes wrapped around some two thirds of the lower half, its bars about as
/// deep.
Complex wrapped_net(int n, double overlap) {
  Complex net = test::net(n);
  const double widest = 0.7 * 0.5 * std::numbers::pi;
  for (Vec3& x : net.x) {
    const double a = (2.0 * x.x() / n - 1.0) * widest;
    const double b = (2.0 * x.y() / n - 1.0) * widest;
    x = Vec3(0.9 * std::tan(a), 0.9 * std::tan(b), -1.0).normalized();
  }
  double middles = 0.0;
  for (const Cylinder& bar : net.cylinders)
    middles += 0.5 * (net.x[index_of(bar.nodes[0])] + net.x[index_of(bar.nodes[1])]).norm();
  const double scale = (1.0 - overlap) * static_cast<double>(net.cylinders.size()) / middles;
  for (Vec3& x : net.x) x *= scale;
  return net;
}

struct Push {
  double sum = 0.0;     ///< N, of what pushes nodes away from the centre
  double least = 0.0;   ///< N, of a node
  double energy = 0.0;  ///< J
};

Push push_of(const Complex& complex, const Vec3& centre = Vec3::Zero()) {
  const Surface surface = complex.surface();
  PatchFinder finder(surface);
  Push push;
  std::vector<Vec3> forces(complex.x.size(), Vec3::Zero());
  for (const Patch& patch : finder.find(centre, 1.0, all_cells(surface), complex.x)) {
    for (const PatchTerm& term : finder.terms(patch)) {
      const double overlap = 1.0 - term.distance;
      const double force = term.weight * overlap + term.slope;
      push.energy += 0.5 * term.weight * overlap * overlap + term.energy;
      for (int k = 0; k < 3; ++k) {
        forces[index_of(term.core.nodes[static_cast<std::size_t>(k)])] +=
            term.core.weights[k] * force * term.normal;
      }
    }
  }
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const double outwards = forces[i].dot((complex.x[i] - centre).normalized());
    push.sum += outwards;
    push.least = std::min(push.least, outwards);
  }
  return push;
}

TEST(SphereInAHoop, IsPushedByEachBarUntilTheyHangTogetherAndNeverLessTheDeeperItIs) {
  for (const int bars : {8, 20, 40}) {
    const double sagitta = 1.0 - std::cos(0.5 * std::numbers::pi / bars);
    const double outwards = std::cos(0.5 * std::numbers::pi / bars);  // of feet at their nodes
    EXPECT_NEAR(push_of(half_hoop(bars, 0.5 * sagitta)).sum, bars * 0.5 * sagitta * outwards,
                1e-12);
    double last = 0.0;
    for (double overlap = 0.25 * sagitta; overlap < 0.3; overlap *= 1.1) {
      const double sum = push_of(half_hoop(bars, overlap)).sum;
      EXPECT_GT(sum, last) << bars << " bars, " << overlap;
      last = sum;
    }
  }
}

TEST(SphereInAHoop, IsPushedTheSameByFinerBarsOnceTheyHangTogether) {
  // What is asked of belts (S2): within 20 % once overlaps exceed the sagitta of the coarsest.
  constexpr int kCoarsest = 12;
  const double sagitta = 1.0 - std::cos(0.5 * std::numbers::pi / kCoarsest);
  for (const double overlap : {1.5 * sagitta, 2.0 * sagitta, 4.0 * sagitta, 0.1}) {
    const double coarse = push_of(half_hoop(kCoarsest, overlap)).sum;
    for (const int bars : {16, 24, 32}) {
      const double fine = push_of(half_hoop(bars, overlap)).sum;
      EXPECT_NEAR(fine / coarse, 1.0, 0.2) << bars << " bars, " << overlap;
    }
  }
}

TEST(SphereInAHoop, IsPushedByWhatLevelsOfTheAdditiveRuleSay) {
  // At a level half a bar is seen from half the chord under an angle, and each node counts its two
  // angles over pi in the mean over the levels. 16 equal bars: 15 nodes, and the piece itself.
  constexpr int kBars = 16;
  constexpr double kOverlap = 0.05;
  constexpr double kTurn = contact::kTurn;
  const double foot = 1.0 - kOverlap;
  const double half_bar = foot * std::tan(0.5 * std::numbers::pi / kBars);
  const double node = std::hypot(foot, half_bar);
  double mean = 0.0;
  constexpr int kSteps = 200000;
  for (int i = 0; i < kSteps; ++i) {
    const double part = (i + 0.5) / kSteps;  // root of the depth below the node, over the deepest
    const double half_chord = std::sqrt(2.0 * node * (1.0 - node)) * part;
    mean += 2.0 / std::numbers::pi * std::atan(half_bar / half_chord) * 4.0 * part *
            (1.0 - part * part) / kSteps;
  }
  const double even_squared =
      1.0 / (1.0 + std::pow(0.375 * std::numbers::pi / half_bar, 2) * 0.5 * node * (1.0 - node));
  const double counts =
      (1.0 + kTurn * kTurn) * mean * mean * mean / (mean * mean + kTurn * kTurn * even_squared);
  const double apart = 0.5 * (kOverlap * kOverlap - (1.0 - node) * (1.0 - node));
  const double of_node = 0.5 * (1.0 - node) * (1.0 - node);
  const double expected = kBars * apart + of_node + (kBars - 1) * counts * of_node;
  EXPECT_NEAR(push_of(half_hoop(kBars, kOverlap)).energy, expected, 1e-5 * expected);
}

TEST(SphereInANet, IsPushedByEveryNodeOutwards) {
  for (const int meshes : {6, 10, 16}) {
    for (const double overlap : {0.003, 0.01, 0.03}) {
      const Push push = push_of(wrapped_net(meshes, overlap));
      EXPECT_GE(push.least, -1e-12) << meshes << ", " << overlap;
      EXPECT_GE(push.energy, 0.5 * overlap * overlap);
    }
  }
}

TEST(SphereInANet, IsPushedHarderTheDeeperItIs) {
  for (const int meshes : {6, 12}) {
    double last = 0.0;
    for (double overlap = 0.001; overlap < 0.1; overlap *= 1.15) {
      const double sum = push_of(wrapped_net(meshes, overlap)).sum;
      EXPECT_GT(sum, last) << meshes << ", " << overlap;
      last = sum;
    }
  }
}

TEST(SphereOnAWire, FeelsNothingOfNodesWhereItIsStraightOrBendsAway) {
  for (const double bend : {0.0, 0.01, 0.5}) {
    Complex wire;
    for (int i = -3; i <= 3; ++i) wire.node(Vec3(0.1 * i, 0.0, -0.1 * bend * std::abs(i)));
    for (int i = 0; i < 6; ++i) wire.cylinder(i, i + 1);
    for (const double x : {0.0, 0.03, 0.17}) {
      const Vec3 centre(x, 0.0, 0.97);
      const Surface surface = wire.surface();
      PatchFinder finder(surface);
      const TotalContact total = total_contact(finder, centre, 1.0, all_cells(surface), wire.x);
      const double overlap = 1.0 - total.nearest;
      EXPECT_NEAR(total.energy, 0.5 * overlap * overlap, 1e-15) << bend << ", " << x;
    }
  }
}

TEST(SphereOnAKnot, RollsOverItWithoutABump) {
  Complex knot;
  const int middle = knot.node(Vec3::Zero());
  for (const Vec3& end :
       {Vec3(1.0, 0.0, 0.0), Vec3(-1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.0, -1.0, 0.0)})
    knot.cylinder(middle, knot.node(end));
  const Surface surface = knot.surface();
  PatchFinder finder(surface);
  for (double x = -0.4; x < 0.4; x += 0.013) {
    const TotalContact total =
        total_contact(finder, Vec3(x, 0.0, 0.98), 1.0, all_cells(surface), knot.x);
    EXPECT_NEAR((total.force - Vec3(0.0, 0.0, 0.02)).norm(), 0.0, 1e-14) << x;
  }
}

TEST(SphereOnABend, FeelsForcesThatFollowWhereAWirePassesThroughStraight) {
  // The node between two bars moves through their line, below the ball's middle and beside it.
  const auto forces = [](double x, double height) {
    Complex wire;
    wire.node(Vec3(-0.2, 0.0, 0.0));
    wire.node(Vec3(0.0, 0.0, height));
    wire.node(Vec3(0.2, 0.0, 0.0));
    wire.cylinder(0, 1);
    wire.cylinder(1, 2);
    const Surface surface = wire.surface();
    PatchFinder finder(surface);
    double on_node = 0.0;
    for (const Patch& patch : finder.find(Vec3(x, 0.0, 0.97), 1.0, all_cells(surface), wire.x)) {
      for (const PatchTerm& term : finder.terms(patch)) {
        for (int k = 0; k < 3; ++k) {
          if (term.core.nodes[static_cast<std::size_t>(k)] == geometry::NodeId{1})
            on_node += term.core.weights[k] * term.normal.z() *
                       (term.weight * (1.0 - term.distance) + term.slope);
        }
      }
    }
    return on_node;
  };
  for (const double x : {0.0, 1e-6, 0.01, 0.1}) {
    double largest = 0.0;
    constexpr double kStep = 1e-7;
    for (double height = -1e-3; height < 1e-3; height += 1e-5)
      largest = std::max(largest, std::abs(forces(x, height + kStep) - forces(x, height)) / kStep);
    // That of a contact, and 0.53 / c (T / L)^2 sqrt(1 + (3 pi T / 8 L)^2) of it (wrap.hpp), with a
    // width of sqrt(2 * 0.03) and terms of the order of c beside it.
    constexpr double kTurn = contact::kTurn;
    const double squared = 2.0 * 0.03 / 0.04;
    const double of_turn =
        0.53 / kTurn * squared * std::sqrt(1.0 + std::pow(0.375 * std::numbers::pi, 2) * squared);
    EXPECT_LT(largest, 1.0 + (1.0 + kTurn) * of_turn) << x;
  }
}

}  // namespace
}  // namespace plekton::test::wrap_test
