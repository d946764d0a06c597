// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law/restitution.hpp"

#include "contact/law/dashpot.hpp"
#include "contact/law/hertz_mindlin.hpp"
#include "contact/law/linear_frictional.hpp"
#include "contact/law/sum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plekton::contact::restitution_test {
namespace {

/// Schwager & Poeschel (2007), for a damping ratio below 1 / sqrt(2).
double of_linear_spring_that_never_pulls(double xi) {
  const double root = std::sqrt(1.0 - xi * xi);
  const double duration = std::numbers::pi - std::atan2(2.0 * xi * root, 1.0 - 2.0 * xi * xi);
  return std::exp(-xi / root * duration);
}

TEST(Restitution, IsThatOfTheoryForALinearSpring) {
  EXPECT_EQ(damping_ratio(SpringKind::linear, 1.0), 0.0);
  for (const double xi : {0.01, 0.1, 0.3, 0.6}) {
    EXPECT_NEAR(restitution(SpringKind::linear, xi), of_linear_spring_that_never_pulls(xi), 1e-5);
  }
}

TEST(Restitution, FallsWithTheDampingAndIsFoundBack) {
  for (const SpringKind kind : {SpringKind::linear, SpringKind::hertz}) {
    double last = 1.0;
    for (const double wanted : {0.95, 0.8, 0.5, 0.2, 0.05}) {
      const double xi = damping_ratio(kind, wanted);
      const double found = restitution(kind, xi);
      EXPECT_NEAR(found, wanted, 1e-9);
      EXPECT_LT(found, last);
      last = found;
    }
  }
}

/// Of a body of 1 kg that meets a wall, by the leapfrog.
template <class Law>
double rebound(double xi, SpringKind, double speed) {
  const Body body{{1e6, 0.0, 0.0, 0.3}, 0.1, 1.0};
  const Body wall{{1e6, 0.0, 0.0, 0.3}, 0.1};
  const auto p = Sum<Law, Dashpot>::combine({{}, {xi}}, body, wall);
  typename Sum<Law, Dashpot>::History history{};
  double gap = 0.0, rate = -speed;
  const double dt = 1e-6;
  for (int step = 0; step < 1'000'000; ++step) {
    gap += rate * dt;
    const double elastic = Law::elastic_normal_force(p.whole, gap);
    if (!(elastic > 0.0)) break;
    const RelativeMotion motion =
        relative_motion(Vec3::UnitZ(), gap, elastic, Vec3(0.0, 0.0, rate));
    const double force = Sum<Law, Dashpot>::force(p, motion, history, dt).force[2];
    EXPECT_GE(force, 0.0);  // never tensile
    rate += force * dt;
  }
  return rate / speed;
}

TEST(Dashpot, GivesTheRestitutionThatWasAskedForAtAnySpeed) {
  for (const double wanted : {0.9, 0.5, 0.2}) {
    for (const double speed : {0.1, 1.0, 5.0}) {
      EXPECT_NEAR(rebound<LinearFrictional>(damping_ratio(SpringKind::linear, wanted),
                                            SpringKind::linear, speed),
                  wanted, 2e-3);
      EXPECT_NEAR(
          rebound<HertzMindlin>(damping_ratio(SpringKind::hertz, wanted), SpringKind::hertz, speed),
          wanted, 2e-3);
    }
  }
}

}  // namespace
}  // namespace plekton::contact::restitution_test
