// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/bond_strength.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace plekton::dynamics::bond_strength_test {
namespace {

using std::numbers::pi;
using testing::IsEmpty;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kRadius = 0.003, kLength = 0.2;  // m
constexpr double kYield = 2e8, kHardening = 5e9;  // Pa

BeamBond bond_of(const BeamSection& section) {
  return {{NodeId{0}, NodeId{1}}, kLength, section, Quat::Identity(), Quat::Identity()};
}

BeamBond round_beam() {
  return bond_of(circular_section(kRadius, 2e11, 0.3));
}

void expect_close(double value, double expected) {
  EXPECT_NEAR(value, expected, 8.0 * kEpsilon * std::abs(expected));
}

TEST(BondLimits, OfARoundBeamAreReachedWithTheYieldStressInItsOutermostFibre) {
  BondStrength strength;
  strength.yield_stress = kYield;
  strength.shear_yield_stress = 1.1e8;

  const BondLimits limits = limits_of(strength, round_beam());

  // Stresses N / (pi r²), 4 M / (pi r³) and 2 T / (pi r³).
  const double cubed = kRadius * kRadius * kRadius;
  expect_close(limits.tension.at_first / (pi * kRadius * kRadius), kYield);
  expect_close(limits.moment.at_first * 4.0 / (pi * cubed), kYield);
  expect_close(limits.torque.at_first * 2.0 / (pi * cubed), 1.1e8);
  expect_close(limits.radius, kRadius);
  expect_close(1.0 / limits.section_modulus, 4.0 / (pi * cubed));
  expect_close(1.0 / limits.torsion_modulus, 2.0 / (pi * cubed));
}

/// By the plastic strain of the outermost fibre: stretch / L0, r 2 turn / L0 and r twist / L0.
TEST(BondLimits, GrowByTheHardeningTimesThePlasticStrain) {
  BondStrength strength;
  strength.yield_stress = kYield;
  strength.hardening = kHardening;

  const BondLimits limits = limits_of(strength, round_beam());

  constexpr double kStrain = 0.02;
  const double stretch = kStrain * kLength, turn = kStrain * kLength / (2.0 * kRadius),
               twist = kStrain * kLength / kRadius;
  expect_close(limits.tension.after(stretch), limits.area * (kYield + kHardening * kStrain));
  expect_close(limits.moment.after(turn), limits.section_modulus * (kYield + kHardening * kStrain));
  expect_close(limits.torque.after(twist), limits.torsion_modulus * (kYield / std::numbers::sqrt3 +
                                                                     kHardening / 3.0 * kStrain));
}

/// Under sigma_y all through, half of a circle each way: 4/3 r³ sigma_y.
TEST(BondLimits, OfAFullyPlasticMomentAreThoseOfACircleThatYieldsAllThrough) {
  BondStrength strength;
  strength.yield_stress = kYield;
  strength.moment_ratio = BondStrength::kFullyPlastic;

  expect_close(limits_of(strength, round_beam()).moment.at_first,
               4.0 / 3.0 * kRadius * kRadius * kRadius * kYield);
}

TEST(BondLimits, AreNeverReachedInWhatABarDoesNotResist) {
  BondStrength strength;
  strength.yield_stress = kYield;
  strength.hardening = kHardening;
  strength.strength = 3e8;

  const BondLimits bar = limits_of(strength, bond_of(bar_section(kRadius, 2e11)));

  expect_close(bar.tension.at_first, pi * kRadius * kRadius * kYield);
  EXPECT_EQ(bar.moment.after(1.0), BondStrength::kNever);
  EXPECT_EQ(bar.torque.after(1.0), BondStrength::kNever);
  EXPECT_EQ(bar.radius, 0.0);
  EXPECT_EQ(bar.strength, 3e8);
  expect_close(bar.shear_strength, 3e8 / std::numbers::sqrt3);

  // One that bends but does not twist.
  BeamSection section = circular_section(kRadius, 2e11, 0.3);
  section.torsion_constant = 0.0;
  const BondLimits beam = limits_of(strength, bond_of(section));
  EXPECT_LT(beam.moment.at_first, 1e3);
  EXPECT_EQ(beam.torque.after(1.0), BondStrength::kNever);
}

TEST(BondStrength, IsToldTheLineOfWhatIsWrongAndNoOther) {
  const auto problems_of = [](const BondStrength& strength) {
    std::ostringstream text;
    list_problems(strength, "law", text);
    return text.str();
  };
  EXPECT_THAT(problems_of({}), IsEmpty());

  struct Case {
    std::function<void(BondStrength&)> spoil;
    const char* line;
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Case> cases = {
      {[](BondStrength& s) { s.yield_stress = kNan; },
       "law: yield stress is nan Pa; it must be positive\n"},
      {[](BondStrength& s) { s.shear_yield_stress = 0.0; },
       "law: shear yield stress is 0 Pa; it must be positive\n"},
      {[](BondStrength& s) { s.moment_ratio = 0.0; },
       "law: moment ratio is 0; it must be positive\n"},
      {[](BondStrength& s) { s.shear_strength = -1.0; },
       "law: shear strength is -1 Pa; it must be positive\n"},
      {[](BondStrength& s) { s.hardening = BondStrength::kNever; },
       "law: hardening is inf Pa; it must be zero or positive, and finite: a bond that gets weaker "
       "as it yields would fail in one place, however small the bonds are\n"}};
  for (const Case& one : cases) {
    BondStrength strength;
    one.spoil(strength);
    EXPECT_EQ(problems_of(strength), one.line);
  }
}

}  // namespace
}  // namespace plekton::dynamics::bond_strength_test
