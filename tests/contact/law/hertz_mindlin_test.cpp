// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law/hertz_mindlin.hpp"

#include <gtest/gtest.h>

namespace plekton::contact::hertz_mindlin_test {
namespace {

/// Glass on steel, as in any table of Hertz' formula.
const Body kGlass{{70e9, 0.0, 0.3, 0.22}, 5e-3};
const Body kSteel{{210e9, 0.0, 0.5, 0.30}, 20e-3};

TEST(HertzMindlin, HasTheForceAndEnergyOfTwoElasticSpheres) {
  const auto p = HertzMindlin::combine(kGlass, kSteel);

  const double modulus = 1.0 / ((1.0 - 0.22 * 0.22) / 70e9 + (1.0 - 0.3 * 0.3) / 210e9);
  EXPECT_NEAR(p.modulus, modulus, 1e-14 * modulus);
  EXPECT_DOUBLE_EQ(p.radius, 4e-3);
  const double d = 1e-6;
  const double force = 4.0 / 3.0 * modulus * std::sqrt(4e-3) * std::pow(d, 1.5);
  EXPECT_NEAR(HertzMindlin::elastic_normal_force(p, -d), force, 1e-14 * force);
  EXPECT_NEAR(HertzMindlin::elastic_normal_energy(p, -d), 0.4 * force * d, 1e-14 * force * d);
  EXPECT_NEAR(HertzMindlin::normal_stiffness(p, -d), 1.5 * force / d, 1e-13 * force / d);
}

/// Mindlin (1949): of equal materials the ratio is 2 (1 - nu) / (2 - nu).
TEST(HertzMindlin, IsSofterAcrossThanAlongTheNormal) {
  const auto p = HertzMindlin::combine(kGlass, kGlass);

  const double ratio =
      HertzMindlin::tangential_stiffness(p, -1e-6) / HertzMindlin::normal_stiffness(p, -1e-6);

  EXPECT_NEAR(ratio, 2.0 * (1.0 - 0.22) / (2.0 - 0.22), 1e-14);
}

TEST(HertzMindlin, GivesUpTangentialForceAsItIsUnloaded) {
  const auto p = HertzMindlin::combine({{1e7, 0.0, 0.9, 0.3}, 0.1}, {{1e7, 0.0, 0.9, 0.3}, 0.1});
  HertzMindlin::History history{};
  const auto at = [&](double gap, const Vec3& slip) {
    return HertzMindlin::force(
        p, relative_motion(Vec3::UnitZ(), gap, HertzMindlin::elastic_normal_force(p, gap), slip),
        history, 1.0);
  };
  at(-4e-4, Vec3::Zero());
  const double before = at(-4e-4, Vec3(1e-6, 0.0, 0.0)).force[0];

  const double softer = at(-1e-4, Vec3::Zero()).force[0];
  const double stiffer = at(-4e-4, Vec3::Zero()).force[0];

  EXPECT_LT(before, 0.0);
  EXPECT_NEAR(softer, 0.5 * before, 1e-12 * std::abs(before));  // stiffness goes with the root
  EXPECT_EQ(stiffer, softer);
}

}  // namespace
}  // namespace plekton::contact::hertz_mindlin_test
