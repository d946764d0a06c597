// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/bond_yield.hpp"

#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/structure/yielding_bonds.hpp"
#include "tests/support/beam_structure.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>

namespace plekton::test::bond_yield_test {
namespace {

using dynamics::BondForces;
using dynamics::BondLaw;
using dynamics::BondStrength;
using dynamics::YieldingBonds;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kRadius = 0.05;
constexpr double kLength = 0.8;
constexpr double kModulus = 2e9;
constexpr double kYield = 4e6;
constexpr double kHardening = 3e8;
const BeamSection kSection = dynamics::circular_section(kRadius, kModulus, 0.25);
const double kModulusOfSection = kSection.second_moment / kRadius;  // W, m³

BondStrength steel() {
  BondStrength strength;
  strength.yield_stress = kYield;
  strength.hardening = kHardening;
  return strength;
}

/// A bond along x from the origin whose ends are moved by hand.
class Specimen {
 public:
  explicit Specimen(const BondStrength& strength, const BeamSection& section = kSection)
      : scene_(chain(1, kLength, section)),
        bonds_(scene_.bonds, 2),
        yielding_({BondLaw{strength, {0}}}, scene_.bonds),
        state_(scene_.state) {}

  /// Displacements from rest of both nodes, then a rigid motion of all.
  BondForces at(const Eigen::VectorXd& displacement, const Quat& turn = Quat::Identity(),
                const Vec3& shift = Vec3::Zero()) {
    state_ = displaced(scene_.state, displacement);
    for (Vec3& x : state_.position) x = turn * x + shift;
    for (Quat& q : state_.orientation) q = (turn * q).normalized();
    geometry::ThreadPool pool;
    yielding_.advance(bonds_, state_, 0.0, pool);
    bonds_.advance(state_, pool);
    return bonds_.forces_of(0, state_);
  }
  BondForces stretched(double strain) {
    return at(strain * kLength * Eigen::VectorXd::Unit(12, 6));
  }
  /// Both ends turned by half of an angle (rad), each in its sense, about z.
  BondForces bent(double angle) {
    return at(0.5 * angle * (Eigen::VectorXd::Unit(12, 11) - Eigen::VectorXd::Unit(12, 5)));
  }
  BondForces twisted(double angle) { return at(angle * Eigen::VectorXd::Unit(12, 9)); }

  double stored() const { return bonds_.elastic_energy(); }
  double dissipated() const { return yielding_.dissipated(); }
  bool is_broken() const { return bonds_.is_broken(0); }
  const YieldingBonds& yielding() const { return yielding_; }
  const NodeState& state() const { return state_; }
  /// Forces and torques on both nodes.
  Eigen::VectorXd felt() { return bond_forces(bonds_, state_); }

 private:
  Scene scene_;
  BeamBonds bonds_;
  YieldingBonds yielding_;
  NodeState state_;
};

/// The bilinear law with isotropic hardening, by hand: a stress-like force that follows a
/// strain-like change.
class Bilinear {
 public:
  Bilinear(double stiffness, double at_first, double hardening)
      : stiffness_(stiffness), limit_(at_first), hardening_(hardening) {}
  double at(double change) {
    const double trial = stiffness_ * (change - plastic_);
    if (std::abs(trial) <= limit_) return trial;
    const double flow = (std::abs(trial) - limit_) / (stiffness_ + hardening_);
    plastic_ += std::copysign(flow, trial);
    limit_ += hardening_ * flow;
    return std::copysign(limit_, trial);
  }
  double plastic() const { return plastic_; }

 private:
  double stiffness_, limit_, hardening_;
  double plastic_ = 0.0;
};

/// Pulled beyond yield, unloaded, pulled further, pushed, pulled: as multiples of the first yield.
constexpr std::array kPath = {0.5, 1.0, 1.5, 3.0, 1.0, 0.2, 2.0, 5.0, 2.0, -3.0, -9.0, -2.0, 12.0};

TEST(BondYield, StretchesABarByTheBilinearLaw) {
  Specimen bar(steel());
  Bilinear law(kModulus, kYield, kHardening);

  for (const double multiple : kPath) {
    const double strain = multiple * kYield / kModulus;
    const double stress = bar.stretched(strain).tension / kSection.area;

    // Lengths are rounded to eps L0, worth eps E in stress, in each of the steps.
    EXPECT_NEAR(stress, law.at(strain), 8.0 * kPath.size() * kEpsilon * kModulus) << multiple;
  }
}

TEST(BondYield, LosesWhatTheBilinearLawLoses) {
  BondStrength strength = steel();
  strength.hardening = 0.0;
  Specimen bar(strength);
  const double strain = kYield / kModulus;
  bar.stretched(strain);

  bar.stretched(4.0 * strain);
  bar.stretched(3.5 * strain);

  // sigma_y times 3 yield strains, and a quarter of the largest elastic energy is left.
  const double volume = kSection.area * kLength;
  EXPECT_NEAR(bar.dissipated(), kYield * 3.0 * strain * volume, 1e-12 * kYield * volume);
  EXPECT_NEAR(bar.stored(), 0.125 * kYield * strain * volume, 1e-12 * kYield * strain * volume);
}

TEST(BondYield, BendsABeamByTheBilinearLaw) {
  Specimen beam(steel());
  const double inertia = kSection.second_moment;
  Bilinear law(kModulus * inertia, kYield * kModulusOfSection, kHardening * inertia);
  const double first = kYield / (kModulus * kRadius);  // 1/m, curvature at first yield

  for (const double multiple : kPath) {
    const double angle = multiple * first * kLength;
    const BondForces forces = beam.bent(angle);

    const double moment = law.at(multiple * first);
    // The bond is linear in pure bending (beam_bonds.hpp). The turns of both ends are solved for to
    // 1e-13 of the moments without yielding, each at its own axis.
    const double tolerance = 1e-12 * kModulus * inertia * 12.0 * first;
    EXPECT_NEAR(forces.moment_a.z(), moment, tolerance) << multiple;
    EXPECT_NEAR(forces.moment_b.z(), -moment, tolerance) << multiple;
    EXPECT_LT(forces.shear.norm(), tolerance / kLength);
  }
  // Released, it keeps the curvature by which the law has flown.
  const BondForces released = beam.bent(law.plastic() * kLength);
  EXPECT_LT(released.moment_a.norm(), 1e-3 * kYield * kModulusOfSection);
}

TEST(BondYield, BendsABeamThatDoesNotResistTwisting) {
  BeamSection section = kSection;
  section.torsion_constant = 0.0;
  Specimen whole(steel()), beam(steel(), section);
  const double first = kYield * kModulusOfSection * kLength / (kModulus * kSection.second_moment);

  const Vec3 moment = beam.bent(3.0 * first).moment_b;

  EXPECT_LT((moment - whole.bent(3.0 * first).moment_b).norm(), 1e-12 * moment.norm());
  EXPECT_GT(moment.norm(), kYield * kModulusOfSection);
  EXPECT_LT(std::abs(beam.twisted(0.1).torque), 1e-12 * moment.norm());
}

TEST(BondYield, TwistsAShaftByTheBilinearLaw) {
  Specimen shaft(steel());
  const double inertia = kSection.torsion_constant;
  const double shear_yield = kYield / std::numbers::sqrt3;
  Bilinear law(kSection.shear_modulus * inertia, shear_yield * inertia / kRadius,
               kHardening / 3.0 * inertia);
  const double first = shear_yield / (kSection.shear_modulus * kRadius);  // rad/m

  for (const double multiple : kPath) {
    const double torque = shaft.twisted(multiple * first * kLength).torque;

    const double tolerance =
        std::pow(12.0 * first * kLength, 4) * kSection.shear_modulus * inertia * 12.0 * first;
    EXPECT_NEAR(torque, law.at(multiple * first), tolerance) << multiple;
  }
}

/// Each end moved and turned at random, far beyond yield.
Eigen::VectorXd deep(Random& random) {
  Eigen::VectorXd displacement(12);
  for (Eigen::Index i = 0; i < 12; i += 6) {
    displacement.segment<3>(i) = random.in_cube(0.02 * kLength);
    displacement.segment<3>(i + 3) = random.in_cube(0.2);
  }
  return displacement;
}

TEST(BondYield, EndsAtTheLimitsInAnyDirection) {
  Random random(7);
  BondStrength strength = steel();
  strength.hardening = 0.0;
  const double moment = kYield * kModulusOfSection;
  const double torque = kYield / std::numbers::sqrt3 * kSection.torsion_constant / kRadius;
  for (int i = 0; i < 200; ++i) {
    Specimen beam(strength);
    const Eigen::VectorXd place = deep(random);

    const BondForces forces = beam.at(place);

    // The search for the flow ends with a change of no more than 1e-13 of the elastic moments at
    // which it begins, and each change leaves an error of at most a quarter.
    const BondForces elastic = Specimen(BondStrength{}).at(place);
    const double error =
        0.25e-13 * (elastic.moment_a.norm() + elastic.moment_b.norm() + std::abs(elastic.torque));
    EXPECT_LE(forces.moment_a.norm(), moment + error);
    EXPECT_LE(forces.moment_b.norm(), moment + error);
    EXPECT_LE(std::abs(forces.torque), torque + error);
    EXPECT_LE(std::abs(forces.tension), kYield * kSection.area * (1.0 + 1e-12));
    EXPECT_GT(std::max(forces.moment_a.norm(), forces.moment_b.norm()), moment - error);
  }
}

TEST(BondYield, DoesNotDependOnTheFrame) {
  Random random(11);
  Specimen still(steel());
  Specimen moving(steel());
  for (int i = 0; i < 200; ++i) {
    const Eigen::VectorXd displacement = deep(random);
    const Quat turn(random.rotation());

    const BondForces here = still.at(displacement);
    const BondForces there = moving.at(displacement, turn, random.in_cube(3.0));

    // Positions 3 m from the origin are rounded to eps 3 m, worth eps E A 3 m / L0 in a force; the
    // rounding of all steps so far is in the plastic changes.
    const double tolerance = 20.0 * (i + 1) * kEpsilon * kModulus * kSection.area;
    EXPECT_NEAR(here.tension, there.tension, tolerance);
    EXPECT_LT((turn * here.shear - there.shear).norm(), tolerance);
    EXPECT_LT((turn * here.moment_a - there.moment_a).norm(), tolerance * kLength);
    EXPECT_LT((turn * here.moment_b - there.moment_b).norm(), tolerance * kLength);
    EXPECT_NEAR(here.torque, there.torque, tolerance * kLength);
    EXPECT_NEAR(still.dissipated(), moving.dissipated(), tolerance * kLength);
  }
}

/// Work (J) that the bond does on its nodes from one state to the next, by the mean of the forces.
double work(const Eigen::VectorXd& before, const Eigen::VectorXd& after, const NodeState& from,
            const NodeState& to) {
  const Eigen::VectorXd mean = 0.5 * (before + after);
  double sum = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    const Eigen::Index k = first_entry(i);
    sum += mean.segment<3>(k).dot(to.position[i] - from.position[i]);
    sum += mean.segment<3>(k + 3).dot(
        rotation_vector(to.orientation[i] * from.orientation[i].conjugate()));
  }
  return sum;
}

TEST(BondYield, GivesNoEnergyBackInAnyCycle) {
  Random random(5);
  constexpr int kSteps = 400;
  for (int cycle = 0; cycle < 60; ++cycle) {
    BondStrength strength = steel();
    strength.hardening = cycle % 3 == 0 ? 0.0 : kHardening;
    Specimen beam(strength);
    const Eigen::VectorXd first = deep(random);
    const Eigen::VectorXd second = deep(random);
    double taken = 0.0;  // J, by the bond from what moves it
    double lost = 0.0;
    beam.at(Eigen::VectorXd::Zero(12));
    for (int i = 1; i <= 2 * kSteps; ++i) {
      const double phase = 2.0 * std::numbers::pi * i / kSteps;
      const NodeState from = beam.state();
      const Eigen::VectorXd before = beam.felt();
      beam.at(std::sin(phase) * first + (1.0 - std::cos(phase)) * second);
      taken -= work(before, beam.felt(), from, beam.state());
      EXPECT_GE(beam.dissipated(), lost);
      lost = beam.dissipated();
    }

    EXPECT_GT(taken, 0.0);
    // The sums are those of the midpoint rule, of second order in the size of a step.
    EXPECT_NEAR(taken, beam.stored() + lost, 1e-3 * lost);
  }
}

TEST(BondYield, BreaksAtTheStressOfItsOutermostFibre) {
  BondStrength strength;
  strength.strength = kYield;
  const double tension = 0.4 * kYield / kModulus;
  const double curvature = 0.6 * kYield / (kModulus * kRadius);
  const auto pulled_and_bent = [&](double factor) {
    Specimen beam(strength);
    Eigen::VectorXd displacement = tension * kLength * Eigen::VectorXd::Unit(12, 6);
    displacement[11] = 0.5 * factor * curvature * kLength;
    displacement[5] = -displacement[11];
    beam.at(displacement);
    return beam.is_broken();
  };

  // The moment is linear in the angle.
  EXPECT_FALSE(pulled_and_bent(1.0 - 1e-6));
  EXPECT_TRUE(pulled_and_bent(1.0 + 1e-6));
}

TEST(BondYield, BreaksInTorsionAtItsShearStrength) {
  BondStrength strength;
  strength.strength = 1e9;
  strength.shear_strength = 1e6;
  const double angle = 1e6 / (kSection.shear_modulus * kRadius) * kLength;
  Specimen held(strength), torn(strength);

  held.twisted((1.0 - 1e-6) * angle);
  torn.twisted((1.0 + 1e-6) * angle);

  EXPECT_FALSE(held.is_broken());
  EXPECT_TRUE(torn.is_broken());
}

TEST(BondYield, BreaksAtItsPlasticStrain) {
  BondStrength strength = steel();
  strength.hardening = 0.0;
  strength.rupture_strain = 0.01;
  Specimen bar(strength);
  const double elastic = kYield / kModulus;

  bar.stretched(elastic);
  bar.stretched(elastic + 0.01 - 1e-9);
  EXPECT_FALSE(bar.is_broken());
  EXPECT_TRUE(bar.yielding().broken().empty());
  const double stored = bar.stored();
  bar.stretched(elastic + 0.01 + 1e-9);

  EXPECT_TRUE(bar.is_broken());
  ASSERT_EQ(bar.yielding().broken().size(), 1U);
  EXPECT_EQ(bar.felt().norm(), 0.0);
  EXPECT_EQ(bar.stored(), 0.0);
  const double volume = kSection.area * kLength;
  EXPECT_NEAR(bar.dissipated(), stored + 0.01 * kYield * volume, 1e-6 * kYield * 0.01 * volume);
  bar.stretched(0.2);
  EXPECT_TRUE(bar.yielding().broken().empty());
}

TEST(BondStrength, ListsEveryProblem) {
  BondStrength strength;
  strength.yield_stress = 0.0;
  strength.shear_yield_stress = -1.0;
  strength.hardening = -2.0;
  strength.strength = std::nan("");
  strength.rupture_strain = 0.0;
  std::ostringstream problems;

  dynamics::list_problems(strength, "bond law 3", problems);

  for (const char* what : {"bond law 3: yield stress is 0 Pa", "shear yield stress is -1 Pa",
                           "hardening is -2 Pa", "strength is nan Pa", "rupture strain is 0"})
    EXPECT_NE(problems.str().find(what), std::string::npos) << what << '\n' << problems.str();
}

}  // namespace
}  // namespace plekton::test::bond_yield_test
