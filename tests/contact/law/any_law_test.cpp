// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law_table.hpp"

#include "contact/law/hertz_mindlin.hpp"
#include "contact/law/linear_frictional.hpp"
#include "contact/law/material_pairs.hpp"

#include <gtest/gtest.h>

namespace plekton::contact::any_law_test {
namespace {

using Law = AnyLaw;
const std::vector<Material> kMaterials{{1e6, 0.5, 0.4, 0.2}, {2e6, 0.3, 0.3, 0.3}};

TEST(AnyLaw, HasTheLawOfEachPairOfMaterialsInAnyOrder) {
  const MaterialPairs pairs(kMaterials,
                                 {{{MaterialId{1}, MaterialId{0}}, Law::of<HertzMindlin>()}});
  const auto force = [&](int a, int b) {
    return Law::elastic_normal_force(pairs.combine({MaterialId{a}, 0.1}, {MaterialId{b}, 0.1}),
                                     -1e-4);
  };
  const Body first{kMaterials[0], 0.1}, second{kMaterials[1], 0.1};

  EXPECT_EQ(force(0, 1),
            HertzMindlin::elastic_normal_force(HertzMindlin::combine(first, second), -1e-4));
  EXPECT_EQ(force(1, 0), force(0, 1));
  EXPECT_EQ(force(0, 0),
            LinearFrictional::elastic_normal_force(LinearFrictional::combine(first, first), -1e-4));
}

TEST(AnyLaw, AnswersWithTheBitsOfTheLawItIs) {
  const Body body{kMaterials[0], 0.1};
  const auto p = HertzMindlin::combine(body, body);
  const Law::Parameters chosen = Law::combine(Law::of<HertzMindlin>(), body, body);
  HertzMindlin::History history{};
  Law::History of_chosen{};
  for (int step = 0; step < 20; ++step) {
    const double gap = -1e-4 * (1.0 + 0.1 * step);
    const RelativeMotion motion = relative_motion(
        Vec3::UnitZ(), gap, HertzMindlin::elastic_normal_force(p, gap), Vec3(0.1, 0.2, 0.3));

    const ContactForce alone = HertzMindlin::force(p, motion, history, 1e-5);
    const ContactForce answer = Law::force(chosen, motion, of_chosen, 1e-5);

    ASSERT_EQ(answer.force, alone.force);
    ASSERT_EQ(answer.dissipated, alone.dissipated);
    ASSERT_EQ(Law::history_energy(chosen, of_chosen), HertzMindlin::history_energy(p, history));
  }
}

TEST(AnyLaw, TakesANewHistoryForOneOfWhicheverLawAsks) {
  const Body body{kMaterials[0], 0.1};
  const Law::Parameters parameters = Law::combine(Law::of<HertzMindlin>(), body, body);
  Law::History history{};

  EXPECT_EQ(Law::history_energy(parameters, history), 0.0);
  EXPECT_EQ(Law::moment(history, Vec3::UnitZ()), Vec3(Vec3::Zero()));
  EXPECT_FALSE(Law::holds(history));
  EXPECT_GT(Law::tangential_limit(parameters, 1.0, history), 1e300);
}

}  // namespace
}  // namespace plekton::contact::any_law_test
