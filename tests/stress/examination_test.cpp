// SPDX-License-Identifier: GPL-3.0-or-later
// A check that cannot fail is worth nothing: each kind of harm is done to a sound scene, and seen.
#include "tests/stress/examination.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <functional>
#include <limits>
#include <ostream>
#include <vector>

namespace plekton::stress::examination_test {
namespace {

using geometry::id_at;
using geometry::NodeId;
using geometry::Vec3;

/// Two grains that collide in free space, off their centres.
constexpr const char* kCollision = R"([simulation]
duration = 0.004
gravity = [0, 0, 0]
[materials.stone]
density = 2650
young_modulus = 1e7
friction_angle = 0.5
[[grains]]
name = "stones"
material = "stone"
radius = 0.01
centres = [[0, 0, 0], [0.021, 0.004, 0]]
velocity = [0, 0, 0]
[[grains]]
name = "shot"
material = "stone"
radius = 0.005
centres = [[-0.0155, 0.002, 0.001]]
velocity = [2, 0, 0]
)";

void push(dynamics::Simulation& simulation, double factor) {
  const auto node = id_at<NodeId>(2);
  const Vec3 velocity = simulation.state().velocity[2];
  simulation.set_velocity(node, velocity + factor * Vec3(0.0, 1.0, 0.0),
                          simulation.state().angular_velocity[2]);
}

struct Harm {
  const char* name;
  Fault fault;
  std::function<void(dynamics::Simulation&, Part)> harm;
};

std::ostream& operator<<(std::ostream& out, const Harm& harm) {
  return out << harm.name;
}

const std::vector<Harm>& harms() {
  static const auto at_step = [](dynamics::Simulation& simulation, std::int64_t step) {
    return simulation.steps() == step;
  };
  static const std::vector<Harm> all = {
      {"ASignal", Fault::crash,
       [](dynamics::Simulation& simulation, Part) {
         if (!at_step(simulation, 9)) return;
         std::signal(SIGSEGV, SIG_DFL);  // sanitizers have handlers of their own
         std::raise(SIGSEGV);
       }},
      {"AnEndlessLoop", Fault::hang,
       [](dynamics::Simulation& simulation, Part) {
         volatile bool forever = at_step(simulation, 9);
         while (forever) {
         }
       }},
      {"ARotationThatIsNoNumber", Fault::not_finite,
       [](dynamics::Simulation& simulation, Part) {
         constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
         // What nothing that is called lets in.
         auto& state = const_cast<dynamics::NodeState&>(simulation.state());
         if (at_step(simulation, 9)) state.angular_velocity[2].y() = kNoNumber;
       }},
      {"ASlowPush", Fault::momentum,
       [](dynamics::Simulation& simulation, Part) {
         if (at_step(simulation, 9)) push(simulation, 1e-6);
       }},
      {"ASlowSpin", Fault::angular_momentum,
       [](dynamics::Simulation& simulation, Part) {
         if (at_step(simulation, 9))
           simulation.set_velocity(id_at<NodeId>(2), simulation.state().velocity[2],
                                   simulation.state().angular_velocity[2] + Vec3(0.0, 1.0, 0.0));
       }},
      {"EnergyThatNobodyBooks", Fault::energy,
       [](dynamics::Simulation& simulation, Part) {
         if (at_step(simulation, 9)) push(simulation, 1.0);
       }},
      {"MuchMoreMotion", Fault::made_energy,
       [](dynamics::Simulation& simulation, Part) {
         if (at_step(simulation, 9)) push(simulation, 4.0);
       }},
      {"ALastBitOnTwoThreads", Fault::threads,
       [](dynamics::Simulation& simulation, Part part) {
         if (part == Part::two_threads && at_step(simulation, 9)) push(simulation, 1e-15);
       }},
      {"ALastBitOnThreeThreads", Fault::threads,
       [](dynamics::Simulation& simulation, Part part) {
         if (part == Part::three_threads && at_step(simulation, 9)) push(simulation, 1e-15);
       }},
      {"ALastBitAfterARestart", Fault::restart, [](dynamics::Simulation& simulation, Part part) {
         if (part == Part::restart && simulation.steps() % 7 == 0) push(simulation, 1e-15);
       }}};
  return all;
}

TEST(Examination, FindsNothingWrongWithACollision) {
  const Findings findings = examine(kCollision);

  for (const Finding& finding : findings.all) ADD_FAILURE() << finding.text;
  EXPECT_FALSE(findings.is_refused);
  EXPECT_TRUE(findings.knows_momentum);
  EXPECT_GT(findings.steps, 100);
}

class ExaminationOfHarm : public testing::TestWithParam<Harm> {};

TEST_P(ExaminationOfHarm, SeesIt) {
  ExaminationOptions options;
  options.disturb = GetParam().harm;
  options.processor_time = 2;
  const Findings findings = examine(kCollision, options);

  EXPECT_TRUE(findings.has(GetParam().fault));
}

INSTANTIATE_TEST_SUITE_P(, ExaminationOfHarm, testing::ValuesIn(harms()),
                         [](const auto& harm) { return std::string(harm.param.name); });

TEST(Examination, TakesWhatCheckAndRunRefuseAlikeForNoFailure) {
  const Findings findings = examine(std::string(kCollision) + "[[plane]]\n");

  EXPECT_TRUE(findings.is_refused);
  EXPECT_TRUE(findings.all.empty());
}

TEST(Examination, ShortensADurationToANumberOfSteps) {
  const auto shorter = shorter_duration(kCollision, 20);

  ASSERT_TRUE(shorter.has_value());
  EXPECT_LT(*shorter, 0.004);
  EXPECT_FALSE(shorter_duration(kCollision, 1000000).has_value());
}

}  // namespace
}  // namespace plekton::stress::examination_test
