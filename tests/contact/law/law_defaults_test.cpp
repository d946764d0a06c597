// SPDX-License-Identifier: GPL-3.0-or-later
// A law that says no more than it has to.
#include "contact/law/contact_law.hpp"
#include "contact/law/lane_law.hpp"
#include "contact/law_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace plekton::contact::law_defaults_test {
namespace {

/// Only pushes.
struct Push : LawDefaults {
  static constexpr std::string_view name = "push";
  struct Parameters {
    double stiffness;  // N/m
  };
  struct History {
    double deepest = 0.0;  // m
  };
  static Parameters combine(const Body&, const Body&) { return {1e5}; }
  static Parameters scaled(const Parameters& p, double count) { return {count * p.stiffness}; }
  static double elastic_normal_force(const Parameters& p, double gap) {
    return p.stiffness * std::max(0.0, -gap);
  }
  static double elastic_normal_energy(const Parameters& p, double gap) {
    return 0.5 * p.stiffness * std::max(0.0, -gap) * std::max(0.0, -gap);
  }
  static ContactForce force(const Parameters&, const RelativeMotion& motion, History& history,
                            double) {
    history.deepest = std::max(history.deepest, -motion.gap);
    return {motion.elastic_normal_force * motion.normal, 0.0};
  }
  static double history_energy(const Parameters&, const History&) { return 0.0; }
  static double normal_stiffness(const Parameters& p, double) { return p.stiffness; }
  static double tangential_stiffness(const Parameters&, double) { return 0.0; }
  static void rotate(History&, const FrameRotation&) {}
  static void accumulate_history(History& history, const History& other, double) {
    history.deepest = std::max(history.deepest, other.deepest);
  }
};
static_assert(ContactLaw<Push> && !LaneLaw<Push>);
static_assert(!HasMoments<Push> && !TellsForce<Push> && !HasInteractionRange<Push>);

struct LawDefaultsOf : testing::Test {
  AnyLaw::Properties properties = AnyLaw::of<Push>();
  AnyLaw::Parameters parameters{};
  AnyLaw::History history{};

  void SetUp() override {
    const Material stone{5e6, 0.3, 0.5};
    const Body ball{stone, 0.01, 1.0, Shape::sphere};
    parameters = AnyLaw::combine(properties, ball, ball);
    const RelativeMotion motion = relative_motion<double>(
        Vec3::UnitZ(), -1e-4, AnyLaw::elastic_normal_force(parameters, -1e-4), Vec3(0.1, 0.0, -0.2),
        Vec3::Zero());
    AnyLaw::force(parameters, motion, history, 1e-5);
  }
};

TEST_F(LawDefaultsOf, NeitherDampNorAttractNorGlue) {
  EXPECT_EQ(AnyLaw::normal_damping(parameters, -1e-4), 0.0);
  EXPECT_EQ(AnyLaw::attraction(parameters), 0.0);
  EXPECT_EQ(AnyLaw::interaction_range(parameters), 0.0);
  EXPECT_FALSE(AnyLaw::cements(parameters));
  EXPECT_FALSE(AnyLaw::end_start(properties));
  AnyLaw::cement(parameters, history);
  EXPECT_FALSE(AnyLaw::holds(history));
}

TEST_F(LawDefaultsOf, LeaveParametersAndHistoryAsTheyAre) {
  const auto stiffness = [](const AnyLaw::Parameters& p) {
    return AnyLaw::normal_stiffness(p, -1e-4);
  };
  EXPECT_EQ(stiffness(AnyLaw::without_attraction(parameters)), 1e5);
  EXPECT_EQ(stiffness(AnyLaw::of_bond(parameters)), 1e5);
  EXPECT_EQ(stiffness(AnyLaw::unbonded_part(parameters, 0.25)), 1e5);
  AnyLaw::scale_history(history, 3.0);
  EXPECT_EQ(history.as<Push::History>().deepest, 1e-4);
}

TEST_F(LawDefaultsOf, TellNoForceNoMomentAndNoLimit) {
  EXPECT_EQ(AnyLaw::other_force(parameters, Vec3::UnitZ(), history), Vec3(Vec3::Zero()));
  EXPECT_EQ(AnyLaw::moment(history, Vec3::UnitZ()), Vec3(Vec3::Zero()));
  EXPECT_TRUE(std::isinf(AnyLaw::tangential_limit(parameters, 1.0, history)));
}

TEST_F(LawDefaultsOf, FindNothingWrong) {
  std::ostringstream problems;
  AnyLaw::list_problems(properties, problems);
  EXPECT_EQ(problems.str(), "");
}

}  // namespace
}  // namespace plekton::contact::law_defaults_test
