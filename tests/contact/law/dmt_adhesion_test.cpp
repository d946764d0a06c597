// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law/dmt_adhesion.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace plekton::contact::dmt_adhesion_test {
namespace {

const Body kGrain{{1e9, 0.0, 0.5, 0.25}, 1e-4};
const DmtAdhesion::Parameters kPair = DmtAdhesion::combine({0.05}, kGrain, kGrain);

double normal_force(double gap) {
  DmtAdhesion::History history{};
  const RelativeMotion rest = relative_motion(
      Vec3::UnitZ(), gap, DmtAdhesion::elastic_normal_force(kPair, gap), Vec3::Zero());
  return DmtAdhesion::force(kPair, rest, history, 1e-6).force[2];
}

/// Derjaguin, Muller & Toporov (1975): 2 pi w R.
TEST(DmtAdhesion, HoldsAsMuchAsItsPullOffForce) {
  double least = 0.0;
  for (double overlap = 1e-12; overlap < 1e-6; overlap *= 1.01)
    least = std::min(least, normal_force(-overlap));

  const double pull_off = 2.0 * std::numbers::pi * 0.05 * 0.5e-4;
  EXPECT_NEAR(least, -pull_off, 1e-6 * pull_off);
  EXPECT_EQ(normal_force(1e-12), 0.0);
}

TEST(DmtAdhesion, RestsWhereHertzCarriesTheAttraction) {
  const double attraction = kPair.attraction;
  const double overlap = std::pow(
      0.75 * attraction / (kPair.elastic.modulus * std::sqrt(kPair.elastic.radius)), 2.0 / 3.0);

  EXPECT_NEAR(normal_force(-overlap), 0.0, 1e-12 * attraction);
}

TEST(DmtAdhesion, HasFrictionWithoutLoad) {
  DmtAdhesion::History history{};
  const double overlap =
      std::pow(0.75 * kPair.attraction / (kPair.elastic.modulus * std::sqrt(kPair.elastic.radius)),
               2.0 / 3.0);
  const RelativeMotion slides = relative_motion(
      Vec3::UnitZ(), -overlap, DmtAdhesion::elastic_normal_force(kPair, -overlap), Vec3::UnitX());

  const ContactForce answer = DmtAdhesion::force(kPair, slides, history, 1.0);

  EXPECT_NEAR(answer.force[0], -0.5 * kPair.attraction, 1e-12 * kPair.attraction);
}

}  // namespace
}  // namespace plekton::contact::dmt_adhesion_test
