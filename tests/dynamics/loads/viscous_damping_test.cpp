// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/viscous_damping.hpp"

#include "tests/support/beam_structure.hpp"
#include "tests/support/loaded_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace plekton::test::viscous_damping_test {
namespace {

using dynamics::BeamDamping;
using dynamics::Held;
using dynamics::MassDamping;
using testing::HasSubstr;

/// Two equal nodes on one beam that is stretched by 1e-4 of its length.
Scene stretched_beam(double ratio) {
  Scene scene = chain(1, 0.2, dynamics::circular_section(0.003, 1e7, 0.3));
  scene.state.position[1].x() += 2e-5;
  scene.loads.beam_damping.push_back({{0}, ratio});
  return scene;
}

double elongation(const LoadedSimulation& simulation) {
  return (simulation.state().position[1] - simulation.state().position[0]).norm() - 0.2;
}

TEST(BeamDamping, HasTheCoefficientOfTheRatioToCritical) {
  Scene scene = stretched_beam(0.3);
  const double stiffness = 1e7 * std::numbers::pi * 9e-6 / 0.2;
  const double mass = scene.properties.mass[0];

  EXPECT_DOUBLE_EQ(dashpot_of(scene.bonds[0], 0.3, scene.properties),
                   0.6 * std::sqrt(stiffness * mass / 2.0));
  scene.properties.held[0] = Held::translation;
  EXPECT_DOUBLE_EQ(dashpot_of(scene.bonds[0], 0.3, scene.properties),
                   0.6 * std::sqrt(stiffness * mass));
  scene.properties.held[1] = Held::everything;
  EXPECT_EQ(dashpot_of(scene.bonds[0], 0.3, scene.properties), 0.0);
}

// u = u0 e^(-beta w t) (cos w_d t + beta / sqrt(1 - beta²) sin w_d t), w_d = w sqrt(1 - beta²)
TEST(BeamDamping, LetsABeamSwingOutAsADampedOscillator) {
  constexpr double kRatio = 0.2;
  const Scene scene = stretched_beam(kRatio);
  const double frequency =
      std::sqrt(1e7 * std::numbers::pi * 9e-6 / 0.2 / (0.5 * scene.properties.mass[0]));
  const double dt = 0.002 / frequency;
  auto simulation = simulation_of(scene, dt);
  const double damped = frequency * std::sqrt(1.0 - kRatio * kRatio);

  for (int i = 0; i < 3000; ++i) {
    simulation.step();
    const double t = simulation.time();
    const double expected =
        2e-5 * std::exp(-kRatio * frequency * t) *
        (std::cos(damped * t) + kRatio / std::sqrt(1.0 - kRatio * kRatio) * std::sin(damped * t));
    // The damping sees a velocity that is half a step old: first order in w dt = 0.002.
    ASSERT_NEAR(elongation(simulation), expected, 0.002 * 2e-5);
  }
}

TEST(BeamDamping, LeavesBothMomentaAloneAndIsCountedInTheEnergy) {
  Scene scene = chain(6, 0.2, dynamics::circular_section(0.003, 1e7, 0.3));
  BeamDamping damping{{}, 0.1};
  for (std::size_t i = 0; i < scene.bonds.size(); ++i) {
    damping.bonds.push_back(i);
    scene.state.velocity[i] = Vec3(0.3 * static_cast<double>(i), 0.1, -0.2);
  }
  scene.loads.beam_damping.push_back(damping);
  const auto momentum = [](const LoadedSimulation& simulation) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < simulation.state().size(); ++i)
      sum += simulation.properties().mass[i] * simulation.state().velocity[i];
    return sum;
  };
  LoadedSimulation simulation(scene, {});
  const Vec3 before = momentum(simulation);

  const double error = closure_until(simulation, 0.02);

  EXPECT_LT((momentum(simulation) - before).norm(), 1e-12 * before.norm());
  EXPECT_GT(simulation.energy().damping, 0.1 * simulation.energy().turnover());
  EXPECT_EQ(simulation.energy().external_work, 0.0);
  EXPECT_LT(error, 1e-3);
}

/// A wire between a held and a free node that is stretched by 1 % of 0.2 m, so that its end flies
/// back.
Scene snapping_wire(double ratio) {
  Scene scene;
  scene.materials = {{1e6, 0.3, 0.3}};
  const dynamics::WireCurve curve{{{0.01, 100.0}, {0.1, 200.0}}};
  for (const double x : {0.0, 0.2})
    scene.add_node(Vec3(x, 0.0, 0.0), x == 0.0 ? Held::everything : Held::rotation);
  scene.add_beam(dynamics::NodeId{0}, dynamics::NodeId{1}, dynamics::wire_section(0.003, curve),
                 7800.0);
  scene.bond_laws.push_back({curve, {0}});
  scene.state.position[1].x() += 1e-3;
  scene.loads.beam_damping.push_back({{0}, ratio});
  return scene;
}

TEST(BeamDamping, OfAWireNeverPushesAndEndsWhereItIsSlack) {
  for (const double ratio : {0.1, 0.7}) {  // below 1: it gets slack
    auto simulation = simulation_of(snapping_wire(ratio), 1e-7);
    double last = 0.0;
    double slack_speed = 0.0;
    while (simulation.time() < 4e-3) {
      simulation.step();
      const double speed = simulation.state().velocity[1].x();
      EXPECT_LE(speed, last);  // the wire only pulls
      last = speed;
      if (elongation(simulation) > -1e-6) continue;
      if (slack_speed == 0.0) slack_speed = speed;
      EXPECT_EQ(speed, slack_speed);
    }
    EXPECT_LT(slack_speed, 0.0);
  }
}

TEST(MassDamping, SlowsDownByItsRate) {
  Scene scene;
  MassDamping damping{{add_lump(scene, Vec3::Zero())}, 3.0};
  scene.state.velocity[0] = Vec3(1.0, 2.0, 0.0);
  scene.state.angular_velocity[0] = Vec3(0.0, 0.0, 5.0);
  scene.loads.mass_damping.push_back(damping);
  auto simulation = simulation_of(scene, 1e-4);

  for (int i = 0; i < 10000; ++i) simulation.step();

  const double expected = std::exp(-3.0);
  EXPECT_NEAR(simulation.state().velocity[0].y(), 2.0 * expected, 1e-3 * expected);
  EXPECT_NEAR(simulation.state().angular_velocity[0].z(), 5.0 * expected, 2e-3 * expected);
  EXPECT_LT(simulation.energy().closure(), 1e-12);
  EXPECT_NEAR(simulation.energy().damping, simulation.energy().initial, 3e-3 * 6.25);
}

// The step at the limit of stability, 1 % below and above it.
TEST(ViscousDamping, ShortensTheCriticalStepToWhereItIsStable) {
  for (const double ratio : {0.05, 0.5, 2.0}) {
    for (const double rate : {0.0, 1e4}) {
      Scene scene = stretched_beam(ratio);
      scene.loads.mass_damping.push_back({{NodeId{0}, NodeId{1}}, rate});
      const double stiffness = 1e7 * std::numbers::pi * 9e-6 / 0.2;
      const double undamped = 2.0 / std::sqrt(2.0 * stiffness / scene.properties.mass[0]);
      const double relaxation = dashpot_of(scene.bonds[0], ratio, scene.properties) / stiffness;
      const double limit = dynamics::damped_step(undamped, undamped, relaxation, rate);
      EXPECT_LE(LoadedSimulation(scene, {}).critical_step().dt, limit * (1.0 + 1e-12));

      // The same oscillator by hand, in units of its mass.
      for (const double part : {0.99, 1.01}) {
        const double dt = part * limit;
        const double k = 4.0 / (undamped * undamped);
        double x = 1.0, v = 0.0;
        for (int i = 0; i < 20000 && std::abs(x) < 1e10; ++i) {
          v -= dt * (k * x + (relaxation * k + rate) * v);
          x += dt * v;
        }
        EXPECT_EQ(std::abs(x) < 1e3, part < 1.0) << ratio << ' ' << rate << ' ' << part;
      }
    }
  }
  constexpr double kNever = std::numeric_limits<double>::infinity();
  EXPECT_DOUBLE_EQ(dynamics::damped_step(kNever, kNever, 0.0, 4.0), 0.5);
  EXPECT_DOUBLE_EQ(dynamics::damped_step(3.0, 3.0, 0.0, 0.0), 3.0);
}

// Two equal masses that a spring and a dashpot join, one of them on a stiff spring that has none, as
// where a contact holds it: 1 % below and above the step at which the leapfrog is stable, by powers
// of its matrix. The bound by the damping of each motion by itself is never above that, and it does
// not go with the square of the stiff frequency, as where all stiffness is damped.
TEST(ViscousDamping, OfStructuresDoesNotGrowWithTheStiffnessOfContacts) {
  constexpr double kSpring = 1.0;      // 1/s², over the mass
  constexpr double kRelaxation = 0.5;  // s
  for (const double contact : {1e2, 1e4, 1e6}) {
    const double trace = 2.0 * kSpring + contact;
    const double largest = 0.5 * (trace + std::sqrt(trace * trace - 4.0 * kSpring * contact));
    const double undamped = 2.0 / std::sqrt(largest);
    const double of_damped = 2.0 / std::sqrt(2.0 * kSpring);
    const double bound = dynamics::damped_step(undamped, of_damped, kRelaxation, 0.0);
    const auto is_stable = [&](double dt) {
      Eigen::Vector2d x(1.0, 0.3), v(0.0, 0.0);
      const Eigen::Matrix2d spring = (Eigen::Matrix2d() << 1.0, -1.0, -1.0, 1.0).finished();
      Eigen::Matrix2d stiffness = kSpring * spring;
      stiffness(0, 0) += contact;
      for (int i = 0; i < 20000 && x.norm() < 1e10; ++i) {
        v -= dt * (stiffness * x + kRelaxation * kSpring * spring * v);
        x += dt * v;
      }
      return x.norm() < 1e3;
    };

    EXPECT_TRUE(is_stable(0.999 * bound)) << contact;
    EXPECT_GT(bound, (contact < 1e3 ? 0.9 : 0.99) * undamped) << contact;
    EXPECT_FALSE(is_stable(1.01 * undamped)) << contact;
    EXPECT_LT(dynamics::damped_step(undamped, undamped, kRelaxation, 0.0), 0.2 * undamped);
  }
}

TEST(ViscousDamping, IsRefusedOutOfRange) {
  Scene scene = stretched_beam(-0.1);
  scene.loads.beam_damping[0].bonds.push_back(9);
  scene.loads.mass_damping.push_back({{NodeId{0}}, -2.0});

  EXPECT_THAT(problems_of(scene), HasSubstr("beam damping 0: its ratio must be finite"));
  EXPECT_THAT(problems_of(scene), HasSubstr("beam damping 0: there is no bond 9, only 1 bonds"));
  EXPECT_THAT(problems_of(scene), HasSubstr("mass damping 0: its rate must be finite"));
}

}  // namespace
}  // namespace plekton::test::viscous_damping_test
