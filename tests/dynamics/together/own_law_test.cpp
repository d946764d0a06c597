// SPDX-License-Identifier: GPL-3.0-or-later
// A user's own contact law in a simulation: one file, and the model that is made of it.
#include "contact/models.hpp"
#include "dynamics/simulation.hpp"
#include "tests/support/weakening_slider.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace plekton::dynamics::own_law_test {
namespace {

/// Spheres that slide down between two planes.
Scene slide() {
  Scene scene;
  scene.materials = {{5e6, 0.3, 0.5}};
  const contact::MaterialId stone{0};
  for (int k = 0; k < 40; ++k) {
    const Vec3 centre(0.021 * (k % 8) + 0.003 * (k / 8), 0.0205 * (k / 8), 0.0101);
    scene.add_sphere(centre, 0.01, 2500.0, stone);
  }
  scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), stone});
  scene.planes.push_back({Vec3(0.18, 0, 0), -Vec3::UnitX(), Vec3::Zero(), stone});
  return scene;
}

Simulation slid_for_a_while(int threads) {
  SimulationOptions options;
  options.motion.gravity = Vec3(7.0, 0.3, -7.0);
  options.threads = threads;
  options.time_step = 1e-5;
  return {slide(), options, contact::model_of<test::WeakeningSlider>()};
}

TEST(OwnLaw, KeepsTheBalanceOfEnergy) {
  auto simulation = slid_for_a_while(1);
  for (int step = 0; step < 10000; ++step) simulation.step();

  const Energy energy = simulation.energy();
  EXPECT_GT(energy.friction, 0.0);
  EXPECT_GT(simulation.contacts().counts().sphere_sphere, 0U);
  // With frequencies w of some sqrt(4 k / m) = 4400 / s the leapfrog keeps elastic energy to
  // (w dt)^2 / 4.
  EXPECT_LT(energy.closure(), 1e-3);
}

TEST(OwnLaw, HasTheSameBitsForAnyNumberOfThreads) {
  auto one = slid_for_a_while(1);
  auto two = slid_for_a_while(2);
  for (int step = 0; step < 3000; ++step) {
    one.step();
    two.step();
  }

  EXPECT_EQ(one.state().position, two.state().position);
  EXPECT_EQ(one.state().angular_velocity, two.state().angular_velocity);
}

/// Pushes, and keeps how it has pushed in members of different sizes, with bytes between them.
struct Flagged : contact::LawDefaults {
  static constexpr std::string_view name = "flagged";
  struct Parameters {
    double stiffness;  // N/m
    bool is_large;
  };
  struct History {
    double deepest = 0.0;  // m
    bool is_loading = false;
    int steps = 0;
    char seen = 0;
  };

  static Parameters combine(const contact::Body& a, const contact::Body&) {
    Parameters p;
    p.stiffness = 1e5;
    p.is_large = a.radius > 1.0;
    return p;
  }
  static Parameters scaled(const Parameters& p, double count) {
    Parameters all;
    all.stiffness = count * p.stiffness;
    all.is_large = p.is_large;
    return all;
  }
  static double elastic_normal_force(const Parameters& p, double gap) {
    return p.stiffness * std::max(0.0, -gap);
  }
  static double elastic_normal_energy(const Parameters& p, double gap) {
    return 0.5 * p.stiffness * std::max(0.0, -gap) * std::max(0.0, -gap);
  }
  static contact::ContactForce force(const Parameters&, const contact::RelativeMotion& motion,
                                     History& history, double) {
    History next;
    next.deepest = std::max(history.deepest, -motion.gap);
    next.is_loading = motion.gap_rate < 0.0;
    next.steps = history.steps + 1;
    next.seen = 1;
    history = next;
    return {motion.elastic_normal_force * motion.normal, 0.0};
  }
  static double history_energy(const Parameters&, const History&) { return 0.0; }
  static double normal_stiffness(const Parameters& p, double) { return p.stiffness; }
  static double tangential_stiffness(const Parameters&, double) { return 0.0; }
  static void rotate(History&, const contact::FrameRotation&) {}
  static void accumulate_history(History& history, const History& other, double) {
    history.deepest = std::max(history.deepest, other.deepest);
    history.steps += other.steps;
  }
};

/// Leaves something where the next calls have their variables.
__attribute__((noinline)) void fill_stack(unsigned char dirt) {
  std::array<volatile unsigned char, 16384> bytes;
  for (volatile unsigned char& byte : bytes) byte = dirt;
}

/// Spheres side by side on a plane, pressed into each other and into it.
Scene pressed_row() {
  Scene scene;
  scene.materials = {{5e6, 0.3, 0.5}};
  const contact::MaterialId stone{0};
  for (int k = 0; k < 20; ++k)
    scene.add_sphere(Vec3(0.01999 * k, 0.0, 0.00999), 0.01, 2500.0, stone);
  scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), stone});
  return scene;
}

geometry::StateTree flagged_state(unsigned char dirt) {
  SimulationOptions options;
  options.time_step = 1e-6;
  fill_stack(dirt);
  Simulation simulation(pressed_row(), options, contact::model_of<Flagged>());
  for (int step = 0; step < 20; ++step) {
    fill_stack(dirt);
    simulation.step();
  }
  EXPECT_GT(simulation.contacts().counts().sphere_sphere, 0U);
  EXPECT_GT(simulation.contacts().counts().with_planes, 0U);
  return simulation.snapshot();
}

TEST(OwnLaw, HasTheSameStateWhateverIsBetweenItsMembers) {
#if !__has_builtin(__builtin_clear_padding)
  GTEST_SKIP() << "this compiler cannot tell bytes between members";
#endif
  const geometry::StateTree state = flagged_state(0x00);
  EXPECT_EQ(state.hash(), flagged_state(0xff).hash());
  EXPECT_EQ(state.hash(), flagged_state(0x5a).hash());

  SimulationOptions options;
  options.time_step = 1e-6;
  fill_stack(0x77);
  Simulation resumed(pressed_row(), options, contact::model_of<Flagged>());
  EXPECT_NO_THROW(resumed.restore(state));
  EXPECT_EQ(resumed.snapshot().hash(), state.hash());
}

}  // namespace
}  // namespace plekton::dynamics::own_law_test
