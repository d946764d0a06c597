// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/energy_ledger.hpp"

#include "geometry/base/state_archive.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace plekton::dynamics::energy_ledger_test {
namespace {

constexpr StepLengths kFirst{.kick = 0.5, .drift = 1.0};
constexpr StepLengths kLater{.kick = 1.0, .drift = 1.0};

StepWork work(double kinetic, double damped, double external) {
  return {.kinetic = kinetic, .damped = damped, .external = external};
}

TEST(EnergyLedger, CountsHalfOfAKickFromTheNextForcesOn) {
  EnergyLedger ledger;
  ledger.start(0.0, 3.0);
  ledger.book(work(0.0, 0.25, 1.0), kFirst, {}, true);
  EXPECT_EQ(ledger.energy().external_work, 0.0) << "the first kick comes after its forces";
  EXPECT_EQ(ledger.energy().damping, 0.0);
  ledger.book(work(1.0, 0.5, 2.0), kLater, {}, false);
  EXPECT_EQ(ledger.energy().external_work, 1.0 + 0.5 * 2.0);
  EXPECT_EQ(ledger.energy().damping, 0.25 + 0.5 * 0.5);
  EXPECT_EQ(ledger.energy().kinetic, 1.0);
  EXPECT_EQ(ledger.energy().initial, 3.0);
}

TEST(EnergyLedger, CountsWhatLoadsDoInTheDriftAheadFromTheNextForcesOn) {
  EnergyLedger ledger;
  ledger.start(0.0, 0.0);
  ledger.book(work(0.0, 0.0, 0.0), kLater, {.external = 4.0, .damped = 2.0}, false);
  EXPECT_EQ(ledger.energy().external_work, 0.0);
  EXPECT_EQ(ledger.energy().damping, 0.0);
  ledger.book(work(0.0, 0.0, 0.0), kLater, {}, false);
  EXPECT_EQ(ledger.energy().external_work, 4.0);
  EXPECT_EQ(ledger.energy().damping, 2.0);
}

TEST(EnergyLedger, TakesTheStartForWhatTheLeapfrogHasAtItsFirstKick) {
  EnergyLedger ledger;
  ledger.start(2.0, 5.0);
  ledger.book(work(1.5, 0.0, 0.0), kFirst, {}, true);
  EXPECT_EQ(ledger.energy().initial, 4.5);
}

TEST(EnergyLedger, KeepsWhatBrokeAndWhatWasTakenOutApart) {
  EnergyLedger ledger;
  ledger.start(0.0, 0.0);
  ledger.add_broken(0.5);
  ledger.add_taken_out(0.25);
  EXPECT_EQ(ledger.energy().bond_dissipated, 0.5);
  EXPECT_EQ(ledger.energy().tracking, -0.25);
}

TEST(EnergyLedger, IsLookedAtWhenTheKineticEnergyHasDoubledOrIsNoNumber) {
  EnergyLedger ledger;
  ledger.start(1.0, 1.0);
  EXPECT_FALSE(ledger.has_doubled());
  ledger.book(work(2.0, 0.0, 0.0), kLater, {}, false);
  EXPECT_FALSE(ledger.has_doubled());
  ledger.book(work(2.5, 0.0, 0.0), kLater, {}, false);
  EXPECT_TRUE(ledger.has_doubled());
  ledger.look(ledger.energy());
  EXPECT_FALSE(ledger.has_doubled());
  ledger.book(work(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0), kLater, {}, false);
  EXPECT_TRUE(ledger.has_doubled());
}

TEST(EnergyLedger, GoesOnFromItsStateToTheLastBit) {
  EnergyLedger ledger;
  ledger.start(1.0, 2.0);
  ledger.book(work(0.1, 0.2, 0.3), kLater, {.external = 0.7, .damped = 0.9}, false);
  ledger.add_broken(0.11);
  ledger.set_suspect("bond 7");
  geometry::StateTree tree;
  ledger.exchange(geometry::StateArchive::writer(tree));
  EnergyLedger other;
  other.exchange(geometry::StateArchive::reader(tree));
  EXPECT_EQ(other.energy().closure_error(), ledger.energy().closure_error());
  EXPECT_EQ(other.energy().external_work, ledger.energy().external_work);
  EXPECT_EQ(other.suspect(), "bond 7");
}

}  // namespace
}  // namespace plekton::dynamics::energy_ledger_test
