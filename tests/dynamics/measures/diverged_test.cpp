// SPDX-License-Identifier: GPL-3.0-or-later
// What a simulation says that has become meaningless, and that it does.
#include "dynamics/measures/diverged.hpp"

#include "contact/models.hpp"
#include "dynamics/simulation.hpp"
#include "tests/support/weakening_slider.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

namespace plekton::test {

/// Pushes harder while bodies part than while they come, and does not account for it: each bounce
/// makes energy from nothing.
struct Pump : WeakeningSlider {
  static constexpr std::string_view name = "pump";

  template <class Real>
  PLEKTON_INLINE static contact::ContactForceOf<Real> force(
      const ParametersOf<Real>& p, const contact::RelativeMotionOf<Real>& motion,
      HistoryOf<Real>& history, double dt) noexcept {
    auto answer = WeakeningSlider::force(p, motion, history, dt);
    const Real push = geometry::select(motion.gap_rate > Real(0.0),
                                       Real(0.7) * motion.elastic_normal_force, Real(0.0));
    answer.force = answer.force + push * motion.normal;
    return answer;
  }
};
static_assert(contact::ContactLaw<Pump>);

}  // namespace plekton::test

namespace plekton::dynamics::diverged_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr contact::MaterialId kMaterial{0};

/// Steps until it diverges, at most as often as given.
std::optional<Diverged> divergence_of(Simulation& simulation, int steps) {
  try {
    for (int i = 0; i < steps; ++i) simulation.step();
  } catch (const Diverged& error) {
    return error;
  }
  return std::nullopt;
}

SimulationOptions without_gravity(double time_step) {
  return {.time_step = time_step, .motion = {.gravity = Vec3::Zero()}};
}

/// A bar of 0.2 m between a held node and one that swings along it.
Scene swinging_bar(double speed) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.4}};
  scene.add_node(Vec3::Zero(), Held::everything);
  scene.add_node(Vec3(0.2, 0.0, 0.0), Held::rotation | Held::along_y | Held::along_z);
  scene.add_beam(NodeId{0}, NodeId{1}, bar_section(0.01, 1e8), 1000.0);
  scene.add_cylinder(NodeId{0}, NodeId{1}, 0.01, kMaterial);
  scene.state.velocity[1] = Vec3(speed, 0.0, 0.0);
  return scene;
}

TEST(Diverged, NamesABondWhoseNodeSwingsAboveTheTrueCriticalStep) {
  // Amplitudes of micrometres: no node moves far in a step for long, but the energy grows by
  // (1.05 + sqrt(1.05² - 1))⁴ = 3.5 in each step.
  const double critical =
      Simulation(swinging_bar(1e-3), without_gravity(0.0)).exact_critical_step().dt;
  Simulation simulation(swinging_bar(1e-3), without_gravity(0.0));
  simulation.set_time_step(1.05 * critical);

  const auto error = divergence_of(simulation, 20);

  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->divergence().sign, Divergence::Sign::energy);
  EXPECT_EQ(error->node(), NodeId{1});
  EXPECT_THAT(error->what(), AllOf(HasSubstr("have come from nowhere"),
                                   HasSubstr("bond 0 (nodes 0, 1) acts on it with"),
                                   HasSubstr("use a smaller time step")));
}

TEST(Diverged, IsNothingAStableSwingDoesAtTheLargestStep) {
  Simulation simulation(swinging_bar(1e-3), without_gravity(0.0));
  simulation.set_time_step(kLargestStep * simulation.exact_critical_step().dt);

  EXPECT_FALSE(divergence_of(simulation, 5000).has_value());
  EXPECT_NO_THROW(simulation.check_energy());
}

TEST(Diverged, NamesTheContactThatMakesEnergyAndSaysThatTheStepIsNotTheCause) {
  // A ball between two planes, each of which returns 1.7 times the energy.
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.0}};
  scene.add_sphere(Vec3(0.0, 0.0, 0.06), 0.05, 1000.0, kMaterial);
  scene.state.velocity[0] = Vec3(0.0, 0.0, -0.01);
  scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), kMaterial});
  scene.planes.push_back({Vec3(0, 0, 0.12), -Vec3::UnitZ(), Vec3::Zero(), kMaterial});
  Simulation simulation(scene, without_gravity(0.0), contact::model_of<test::Pump>());

  const auto error = divergence_of(simulation, 10000000);

  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->divergence().sign, Divergence::Sign::energy);
  EXPECT_GT(error->divergence().made, kFarMore * error->divergence().there);
  EXPECT_THAT(error->what(), AllOf(HasSubstr("the contact of sphere 0 (node 0) with plane"),
                                   HasSubstr("m deep, acts on it with"), HasSubstr("not the cause"),
                                   Not(HasSubstr("smaller time step"))));
}

TEST(Diverged, NamesWhatSpinsANodeByHalfATurnInAStep) {
  // The free end of a beam is twisted, and the step is too long for its torsion alone.
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.4}};
  scene.add_node(Vec3::Zero(), Held::everything);
  scene.add_node(Vec3(0.2, 0.0, 0.0), Held::translation);
  scene.add_beam(NodeId{0}, NodeId{1}, circular_section(0.01, 1e8, 0.3), 1000.0);
  scene.add_cylinder(NodeId{0}, NodeId{1}, 0.01, kMaterial);
  scene.state.orientation[1] = Quat(Eigen::AngleAxisd(1.0, Vec3::UnitX()));
  Simulation simulation(scene, without_gravity(0.0));
  simulation.set_time_step(50.0 * simulation.exact_critical_step().dt);

  const auto error = divergence_of(simulation, 1);

  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->divergence().sign, Divergence::Sign::spin);
  EXPECT_GE(simulation.state().angular_velocity[1].norm() * simulation.time_step(),
            std::numbers::pi);
  EXPECT_THAT(error->what(), AllOf(HasSubstr("node 1 at (0.2   0   0) m spins at"),
                                   HasSubstr("bond 0 (nodes 0, 1) acts on it with"),
                                   HasSubstr("N m"), HasSubstr("use a smaller time step")));
}

TEST(Diverged, SaysThatASpinWasGiven) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.4}};
  scene.add_sphere(Vec3::Zero(), 0.05, 1000.0, kMaterial);
  scene.state.angular_velocity[0] = Vec3(0.0, 4e5, 0.0);
  Simulation simulation(scene, without_gravity(1e-5));

  const auto error = divergence_of(simulation, 1);

  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->divergence().sign, Divergence::Sign::spin);
  EXPECT_THAT(error->what(), AllOf(HasSubstr("400000 rad/s"), HasSubstr("given or is prescribed")));
}

TEST(Diverged, NamesTheContactThatThrowsARigidBody) {
  // Two balls in one body, one of them half in the floor.
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.4}};
  scene.add_sphere(Vec3(0.0, 0.0, 0.025), 0.05, 1000.0, kMaterial);
  scene.add_sphere(Vec3(0.0, 0.0, 0.1), 0.05, 1000.0, kMaterial);
  scene.add_rigid_body(std::vector{NodeId{0}, NodeId{1}},
                       {1.0, Vec3(0.0, 0.0, 0.0625), 1e-3 * geometry::Mat3::Identity()});
  scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), kMaterial});
  Simulation simulation(scene, without_gravity(0.0));
  simulation.set_time_step(20.0 * simulation.exact_critical_step().dt);

  const auto error = divergence_of(simulation, 1);

  ASSERT_TRUE(error.has_value());
  EXPECT_THAT(error->what(),
              AllOf(HasSubstr("the contact of sphere 0"), HasSubstr("plane 0"),
                    HasSubstr("use a smaller time step"), Not(HasSubstr("prescribed"))));
}

TEST(Diverged, IsNothingASphereDoesThatFallsFromRestAndBounces) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.4}};
  scene.add_sphere(Vec3(0.0, 0.0, 0.0501), 0.05, 1000.0, kMaterial);
  scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), kMaterial});
  Simulation simulation(scene, {.motion = {.gravity = Vec3(0.0, 0.0, -9.81)}});

  EXPECT_FALSE(divergence_of(simulation, 5000).has_value());
  EXPECT_NO_THROW(simulation.check_energy());
}

TEST(Diverged, IsNothingALoadDoesThatIsThereAtOnce) {
  Simulation simulation(swinging_bar(0.0), {.motion = {.gravity = Vec3(1000.0, 0.0, 0.0)}});

  EXPECT_FALSE(divergence_of(simulation, 5000).has_value());
}

TEST(Diverged, IsNothingAPlaneThatArrivesFastDoes) {
  // All there is at the first touch is what the plane brings.
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.4}};
  scene.add_sphere(Vec3(0.0, 0.0, 0.0501), 0.05, 1000.0, kMaterial);
  scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3(0.0, 0.0, 20.0), kMaterial});
  Simulation simulation(scene, without_gravity(0.0));

  EXPECT_FALSE(divergence_of(simulation, 2000).has_value());
}

}  // namespace
}  // namespace plekton::dynamics::diverged_test
