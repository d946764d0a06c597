// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law/hertz_mindlin.hpp"
#include "contact/law/linear_frictional.hpp"
#include "contact/law/material_pairs.hpp"
#include "contact/law_table.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <new>

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

/// Properties in memory that was full of something.
Law::Properties kept_from_dirty_memory(unsigned char dirt) {
  using Of = LinearFrictional::Properties;
  static_assert(sizeof(Of) > 2 * sizeof(double) + sizeof(Of::radius), "it has bytes of no member");
  alignas(Of) std::array<unsigned char, sizeof(Of)> memory;
  memory.fill(dirt);
  Of& properties = *new (memory.data()) Of;
  properties.normal_stiffness = 1.0;
  properties.tangential_stiffness = 2.0;
  properties.radius = LinearFrictional::StiffnessRadius::curvature;
  return Law::of<LinearFrictional>(properties);
}

TEST(AnyLaw, KeepsNothingOfBytesThatBelongToNoMember) {
#if !__has_builtin(__builtin_clear_padding)
  GTEST_SKIP() << "this compiler cannot tell them";
#endif
  const auto bits = [](const Law::Properties& kept) {
    return std::bit_cast<std::array<std::uint64_t, 16>>(kept.numbers);
  };

  EXPECT_EQ(bits(kept_from_dirty_memory(0x00)), bits(kept_from_dirty_memory(0xff)));
  EXPECT_EQ(bits(kept_from_dirty_memory(0x00)), bits(kept_from_dirty_memory(0x5a)));
}

}  // namespace
}  // namespace plekton::contact::any_law_test
