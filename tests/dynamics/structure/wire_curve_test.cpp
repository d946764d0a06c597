// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/wire_curve.hpp"

#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/structure/yielding_bonds.hpp"
#include "tests/support/beam_structure.hpp"
#include "tests/support/seeded_random.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace plekton::test::wire_curve_test {
namespace {

using dynamics::BondLaw;
using dynamics::WireCurve;
using dynamics::YieldingBonds;
using testing::HasSubstr;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kLength = 0.1;
/// Steel wire of 2.7 mm: elastic to 1 kN, a plateau, hardening, softening, rupture at 8 %.
const WireCurve kCurve{{{0.002, 1000.0}, {0.01, 1500.0}, {0.06, 2200.0}, {0.08, 1900.0}}};

class PulledWire {
 public:
  explicit PulledWire(const WireCurve& curve)
      : scene_(chain(1, kLength, dynamics::wire_section(1.35e-3, curve))),
        bonds_(scene_.bonds, 2),
        yielding_({BondLaw{curve, {0}}}, scene_.bonds),
        state_(scene_.state) {}

  /// @returns N
  double at(double strain) {
    constexpr double kDrift = 1.0;  // s
    const double length = (1.0 + strain) * kLength;
    state_.velocity[1].x() = (length - state_.position[1].x()) / kDrift;
    state_.position[1].x() = length;
    geometry::ThreadPool pool;
    yielding_.advance(bonds_, state_, kDrift, pool);
    bonds_.advance(state_, pool);
    return bonds_.axial_force(0);
  }
  double stored() const { return bonds_.elastic_energy(); }
  double dissipated() const { return yielding_.dissipated(); }
  double plastic_strain() const { return yielding_.plastic_strain(0); }
  bool is_broken() const { return bonds_.is_broken(0); }

 private:
  Scene scene_;
  BeamBonds bonds_;
  YieldingBonds yielding_;
  NodeState state_;
};

/// N: a length is rounded to eps L0, worth eps times the first slope; a few times in each step.
constexpr double kTolerance = 16.0 * kEpsilon * 1000.0 / 0.002;

TEST(WireCurve, IsStraightBetweenItsPoints) {
  EXPECT_EQ(kCurve.force_at(0.0), 0.0);
  EXPECT_DOUBLE_EQ(kCurve.force_at(0.001), 500.0);
  for (const WireCurve::Point& point : kCurve.points)
    EXPECT_DOUBLE_EQ(kCurve.force_at(point.strain), point.force);
  EXPECT_DOUBLE_EQ(kCurve.force_at(0.035), 1850.0);
  EXPECT_EQ(kCurve.force_at(1.0), 1900.0);
}

TEST(WireCurve, TellsTheSmallestStrainWithAForce) {
  EXPECT_EQ(kCurve.strain_at(0.0), 0.0);
  EXPECT_NEAR(*kCurve.strain_at(500.0), 0.001, 4.0 * kEpsilon);
  EXPECT_NEAR(*kCurve.strain_at(1250.0), 0.006, 4.0 * kEpsilon);
  EXPECT_NEAR(*kCurve.strain_at(2200.0), 0.06, 4.0 * kEpsilon);
  EXPECT_FALSE(kCurve.strain_at(2201.0));
}

TEST(Wire, FollowsItsCurvePointByPoint) {
  PulledWire wire(kCurve);
  for (int i = 0; i < 800; ++i) {
    const double strain = 1e-4 * i;
    EXPECT_NEAR(wire.at(strain), kCurve.force_at(strain), kTolerance) << strain;
  }
  EXPECT_FALSE(wire.is_broken());
}

TEST(Wire, IsSlackWhereItIsShorterThanAtRest) {
  PulledWire wire(kCurve);
  EXPECT_EQ(wire.at(-0.01), 0.0);
  EXPECT_EQ(wire.at(-0.5), 0.0);
  EXPECT_EQ(wire.stored(), 0.0);
  EXPECT_NEAR(wire.at(0.001), 500.0, kTolerance);
}

TEST(Wire, UnloadsAndReloadsAlongTheFirstSlope) {
  PulledWire wire(kCurve);
  wire.at(0.035);
  const double slope = kCurve.first_slope();

  EXPECT_NEAR(wire.at(0.034), 1850.0 - 0.001 * slope, kTolerance);
  const double rest = 0.035 - 1850.0 / slope;
  EXPECT_NEAR(wire.plastic_strain(), rest, 8.0 * kEpsilon);
  EXPECT_EQ(wire.at(rest - 1e-6), 0.0);
  EXPECT_EQ(wire.at(-0.02), 0.0);
  EXPECT_NEAR(wire.at(rest + 0.002), 1000.0, kTolerance);
  EXPECT_NEAR(wire.at(0.035), 1850.0, kTolerance);
  EXPECT_NEAR(wire.at(0.07), 2050.0, kTolerance);
  EXPECT_NEAR(wire.at(0.069), 2050.0 - 0.001 * slope, kTolerance);
}

TEST(Wire, BreaksAtItsLastPoint) {
  PulledWire wire(kCurve);
  wire.at(0.05);

  EXPECT_NEAR(wire.at(0.08 - 4.0 * kEpsilon), 1900.0, kTolerance);
  EXPECT_FALSE(wire.is_broken());
  EXPECT_EQ(wire.at(0.08 + 1e-12), 0.0);
  EXPECT_TRUE(wire.is_broken());
  EXPECT_EQ(wire.at(0.05), 0.0);
  EXPECT_EQ(wire.stored(), 0.0);
}

TEST(Wire, LosesTheAreaUnderItsCurve) {
  PulledWire wire(kCurve);
  constexpr int kSteps = 8000;
  for (int i = 0; i <= kSteps + 1; ++i) wire.at(0.08 * i / kSteps + 1e-9);

  double area = 0.0;
  WireCurve::Point before{0.0, 0.0};
  for (const WireCurve::Point& point : kCurve.points) {
    area += 0.5 * (before.force + point.force) * (point.strain - before.strain);
    before = point;
  }
  EXPECT_TRUE(wire.is_broken());
  // The last step, 1e-5 of strain, goes beyond the end of the curve, to half of it.
  EXPECT_NEAR(wire.dissipated(), area * kLength, 2.0 * 1e-5 * 1900.0 * kLength);
}

TEST(Wire, GivesNoEnergyBackOnAnyPath) {
  Random random(2);
  constexpr int kSteps = 200;  // from one turning point to the next
  for (int path = 0; path < 50; ++path) {
    PulledWire wire(kCurve);
    double strain = 0.0;
    double force = 0.0;
    double taken = 0.0;
    double largest = 0.0;  // J, of the error of a step that ends or begins slack
    for (int turn = 0; turn < 20; ++turn) {
      const double change = (random.uniform(-0.01, 0.0799) - strain) / kSteps;
      for (int i = 0; i < kSteps; ++i) {
        const double lost = wire.dissipated();
        const double next = wire.at(strain += change);
        taken += 0.5 * (force + next) * change * kLength;
        if (force == 0.0 || next == 0.0)
          largest += 0.5 * std::max(force, next) * std::abs(change) * kLength;
        force = next;
        EXPECT_GE(wire.dissipated(), lost);
        EXPECT_GE(taken, -largest);
      }
    }
    EXPECT_NEAR(taken, wire.stored() + wire.dissipated(), largest + 1e-3 * taken);
  }
}

TEST(WireCurve, ListsWhatIsWrong) {
  const auto problems_of = [](const WireCurve& curve) {
    std::ostringstream problems;
    dynamics::list_problems(curve, "wire", problems);
    return problems.str();
  };
  EXPECT_EQ(problems_of(kCurve), "");
  EXPECT_THAT(problems_of({}), HasSubstr("has no points"));
  EXPECT_THAT(problems_of({{{0.0, 1.0}}}), HasSubstr("point 1: the strain is 0 after 0"));
  EXPECT_THAT(problems_of({{{0.1, 0.0}}}), HasSubstr("the first force must be positive"));
  EXPECT_THAT(problems_of({{{0.1, 1.0}, {0.05, 2.0}}}), HasSubstr("strains must rise"));
  EXPECT_THAT(problems_of({{{0.1, 1.0}, {0.2, -2.0}}}), HasSubstr("a wire does not push"));
  EXPECT_THAT(problems_of({{{0.1, 1.0}, {0.2, 3.0}}}), HasSubstr("make the first piece"));
  EXPECT_THAT(problems_of({{{0.1, 1.0}, {0.2, std::nan("")}}}), HasSubstr("must be finite"));
  EXPECT_EQ(problems_of({{{0.1, 1.0}, {0.2, 2.0}, {0.3, 3.0}}}), "");
}

TEST(BondLaws, ListWhatDoesNotFitTheirBonds) {
  const Scene scene = chain(3, 1.0, dynamics::circular_section(0.01, 1e9, 0.3));
  const std::vector<BondLaw> laws{{kCurve, {0, 7}}, {dynamics::BondStrength{}, {0}}};
  std::ostringstream problems;

  dynamics::list_problems(laws, scene.bonds, problems);

  for (const char* what : {"bond law 0: bond 0: follows the curve of a wire", "E A is",
                           "bond law 0: bond 7 does not exist", "bond law 1: bond 0 has a law"})
    EXPECT_THAT(problems.str(), HasSubstr(what));
}

TEST(WireCurve, WithoutPointsMakesNoSection) {
  EXPECT_THROW(dynamics::wire_section(0.01, WireCurve{}), std::invalid_argument);
}

}  // namespace
}  // namespace plekton::test::wire_curve_test
