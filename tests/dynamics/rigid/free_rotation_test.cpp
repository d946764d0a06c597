// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/rigid/free_rotation.hpp"

#include "dynamics/state/rigid_nodes.hpp"
#include "dynamics/state/rotation_step.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plekton::dynamics::free_rotation_test {
namespace {

double energy_of(const Vec3& momentum, const Vec3& moments, const Quat& orientation) {
  const Vec3 in_body = orientation.conjugate() * momentum;
  return 0.5 * in_body.dot(in_body.cwiseQuotient(moments));
}

/// kg m²/s, of a body that turns about its middle axis but for a small part.
Vec3 middle_axis_momentum(const Vec3& moments) {
  return moments.cwiseProduct(Vec3(1e-3, 10.0, 0.0));
}

// The middle axis turns over about every 2 / (n w) ln(4 / 1e-4) = 3.7 s, n = sqrt((I2 - I1) (I3 -
// I2) / (I1 I3)) = 0.58, w = 10 / s: five times in 20 s. Rounding of 1e5 turns, each of eps,
// adds up to 1e5 eps = 2e-11 at most.
TEST(FreeTurn, KeepsTheEnergyOverAHundredThousandStepsWhileTheMiddleAxisTurnsOver) {
  const Vec3 moments(1.0, 2.0, 3.0);
  const Vec3 momentum = middle_axis_momentum(moments);
  Quat orientation = Quat::Identity();
  const double start = energy_of(momentum, moments, orientation);
  constexpr double kStep = 2e-4;
  double worst = 0.0, lowest = 1.0;
  int flips = 0;
  bool is_up = true;

  for (int i = 0; i < 100000; ++i) {
    const Vec3 turn = free_turn(momentum, moments, orientation, kStep);
    orientation = turned(orientation, Vec3(turn / kStep), kStep);
    worst = std::max(worst, std::abs(energy_of(momentum, moments, orientation) / start - 1.0));
    const double up = (orientation.conjugate() * momentum).normalized().y();
    lowest = std::min(lowest, up);
    if ((up > 0.5) == is_up || std::abs(up) < 0.5) continue;
    is_up = !is_up;
    ++flips;
  }

  EXPECT_LT(worst, 1e-10);
  EXPECT_LT(lowest, -0.99);
  EXPECT_EQ(flips, 5);
}

TEST(FreeTurn, OfALongTimeIsThatOfManyShortOnes) {
  const Vec3 moments(0.5, 0.7, 1.1);
  const Vec3 momentum(0.3, -0.8, 1.2);
  const Quat start = Quat(0.5, 0.1, -0.7, 0.3).normalized();
  Quat slowly = start;

  for (int i = 0; i < 1000; ++i)
    slowly = turned(slowly, Vec3(free_turn(momentum, moments, slowly, 1e-3) / 1e-3), 1e-3);
  const Quat at_once = turned(start, free_turn(momentum, moments, start, 1.0), 1.0);

  EXPECT_LT(slowly.angularDistance(at_once), 1e-12);
}

// A symmetric top precesses about its momentum at L / I1 and spins about its axis at L cos(theta)
// (1 / I3 - 1 / I1).
TEST(FreeTurn, OfASymmetricTopIsItsPrecessionAndSpin) {
  const Vec3 moments(2.0, 2.0, 0.5);
  const Vec3 momentum = 3.0 * Vec3(0.6, 0.0, 0.8);
  constexpr double kTime = 0.4;

  const Vec3 turn = free_turn(momentum, moments, Quat::Identity(), kTime);

  const Quat precession(Eigen::AngleAxisd(kTime * 3.0 / 2.0, Vec3(0.6, 0.0, 0.8)));
  const Quat spin(
      Eigen::AngleAxisd(kTime * 3.0 * 0.8 * (1.0 / 0.5 - 1.0 / 2.0), Vec3(Vec3::UnitZ())));
  const Quat expected = precession * spin;
  EXPECT_LT(turned(Quat::Identity(), turn, 1.0).angularDistance(expected), 1e-14);
}

TEST(FreeTurn, OfWhatDoesNotSpinIsNothing) {
  EXPECT_EQ(free_turn(Vec3::Zero(), Vec3::Ones(), Quat::Identity(), 0.1), Vec3(Vec3::Zero()));
}

// About one axis of the world the moment of inertia stays.
TEST(PartlyHeldTurn, AboutOneAxisIsASpinAtMomentumOverInertia) {
  const Vec3 moments(1.0, 2.0, 3.0);
  const Quat orientation = Quat(0.9, 0.2, -0.3, 0.1).normalized();
  const double inertia = inertia_in_world(moments, orientation)(1, 1);
  const HeldTurning hinge{Vec3(0, 1, 0), Vec3::Zero()};

  const Vec3 turn = partly_held_turn(Vec3(5.0, 0.3, 7.0), moments, orientation, hinge, 0.5);

  EXPECT_NEAR(turn.y(), 0.5 * 0.3 / inertia, 1e-15);
  EXPECT_EQ(turn.x(), 0.0);
  EXPECT_EQ(turn.z(), 0.0);
}

// With L about both free axes constant the energy 1/2 w.L stays: what holds the body about z does
// no work. Of fourth order: steps of some 1e-2 rad are off by 1e-10 of it each, to and fro.
TEST(PartlyHeldTurn, AboutTwoAxesKeepsTheEnergy) {
  const Vec3 moments(1.0, 2.0, 3.0);
  const Vec3 momentum(1.0, 0.4, 0.0);
  const HeldTurning held{Vec3(1, 1, 0), Vec3::Zero()};
  Quat orientation = Quat(0.9, 0.2, -0.3, 0.1).normalized();
  const auto energy = [&] {
    return 0.5 * momentum.dot(partly_held_spin(momentum, moments, orientation, held));
  };
  const double start = energy();

  for (int i = 0; i < 1000; ++i)
    orientation =
        turned(orientation, partly_held_turn(momentum, moments, orientation, held, 0.01), 1.0);

  EXPECT_NEAR(energy() / start, 1.0, 1e-9);
}

}  // namespace
}  // namespace plekton::dynamics::free_rotation_test
