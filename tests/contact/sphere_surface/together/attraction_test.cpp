// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law/dmt_adhesion.hpp"
#include "tests/support/ball_on_surface.hpp"
#include "tests/support/named_laws.hpp"

#include <gtest/gtest.h>

#include <numbers>

/// Balls that stick to surfaces: the attraction counts as the elastic force does.
namespace plekton::test::attraction_test {
namespace {

using contact::DmtAdhesion;

constexpr double kRadius = 0.9;
/// J/m², so that the attraction of one contact is about what it pushes with at the overlaps below.
constexpr double kWork = 1e4;
/// N, of one contact: 2 pi w R, R that of the ball, as a facet is flat.
constexpr double kAttraction = 2.0 * std::numbers::pi * kWork * kRadius;
constexpr Material kSmooth{1e7, 0.3, 0.0};

contact::PairProperties<contact::AnyLaw> sticky(double work) {
  return {{{MaterialId{0}, MaterialId{0}}, with<DmtAdhesion>({work})}};
}

/// Its sides rise at 45 degrees from the y axis.
Complex groove() {
  Complex groove = centred(sheet(8), 8, 0.5);
  for (Vec3& x : groove.x) x.z() += std::abs(x.x());
  return groove;
}

TEST(Attraction, PullsOnceOnAFlatSheetWhereverTheBallLies) {
  SphereOnSurface with(centred(sheet(8), 8, 0.5), kRadius, kSmooth, sticky(kWork));
  SphereOnSurface without(centred(sheet(8), 8, 0.5), kRadius, kSmooth, sticky(0.0));
  for (const Vec3& place : {Vec3(0.1, 0.2, 0.97), Vec3(0.0, 0.2, 0.97), Vec3(0.0, 0.0, 0.97)}) {
    const Vec3 attraction = with.put(place) - without.put(place);
    EXPECT_NEAR((attraction + kAttraction * Vec3::UnitZ()).norm(), 0.0, 1e-9 * kAttraction);
    EXPECT_NEAR(with.contacts().elastic_energy() - without.contacts().elastic_energy(),
                -0.03 * kAttraction, 1e-9 * kAttraction);
  }
}

/// The ball touches both sides, and is far from where they meet.
TEST(Attraction, PullsToEachSideOfAGroove) {
  SphereOnSurface with(groove(), kRadius, kSmooth, sticky(kWork));
  SphereOnSurface without(groove(), kRadius, kSmooth, sticky(0.0));
  const Vec3 place(0.0, 0.1, std::numbers::sqrt2 * 0.97);
  const Vec3 attraction = with.put(place) - without.put(place);
  EXPECT_NEAR((attraction + std::numbers::sqrt2 * kAttraction * Vec3::UnitZ()).norm(), 0.0,
              1e-9 * kAttraction);
}

/// The same of a flat groove, where both are one contact, of bars of a net and of a dent, whose
/// rings close and are filled.
TEST(Attraction, PushesAgainstTheGradientOfItsEnergyWhereAContactHasManyFeatures) {
  Random random(17);
  const auto surface = [&](int trial) {
    if (trial % 3 == 0) return roughened(centred(net(4), 4, 1.5), 1.5, 0.05, random);
    Complex bent = roughened(centred(sheet(8), 8, 0.25), 0.25, 0.01, random);
    for (Vec3& x : bent.x)
      x.z() += trial % 3 == 1 ? 0.3 * std::abs(x.x()) : 0.6 * x.head<2>().squaredNorm();
    return bent;
  };
  int several = 0;
  for (int trial = 0; trial < 60; ++trial) {
    SphereOnSurface ball(surface(trial), kRadius, kSmooth, sticky(kWork));
    const Vec3 place(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3),
                     trial % 3 == 0 ? 0.7 : 0.93);
    const Vec3 way = random.in_cube(1.0);
    const auto energy = [&](double step) {
      ball.put(place + step * way);
      return ball.contacts().elastic_energy();
    };
    // The best of three steps: a feature may come into range within one.
    double error = std::numeric_limits<double>::infinity();
    for (const double step : {1e-6, 1e-7, 1e-8}) {
      const double slope = (energy(step) - energy(-step)) / (2.0 * step);
      error = std::min(error, std::abs(ball.put(place).dot(way) + slope));
    }
    EXPECT_LT(error, 2e-6 * kAttraction) << trial;
    int terms = 0;
    ball.contacts().for_each_touching([&](auto&&...) { ++terms; });
    several += terms > 1;
  }
  EXPECT_GT(several, 50);
}

}  // namespace
}  // namespace plekton::test::attraction_test
