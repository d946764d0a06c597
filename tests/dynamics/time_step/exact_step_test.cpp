// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step/exact_step.hpp"

#include "dynamics/loads/applied_loads.hpp"
#include "dynamics/simulation.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/structure/sheet_facets.hpp"
#include "dynamics/time_step/largest_eigenvalue.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "tests/support/linear_algebra.hpp"
#include "tests/support/loaded_scene.hpp"
#include "tests/support/sheet_structure.hpp"
#include "tests/support/stiffness_reference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plekton::test::exact_step_test {
namespace {

using dynamics::AppliedLoads;
using dynamics::ContactSprings;
using dynamics::ExactStep;

// What Lanczos' method leaves of the step, and what differences of forces leave of both sides.
constexpr double kTolerance = 1e-3;

ExactStep exact_step(const Scene& scene, const ContactSprings& contacts = {}) {
  const BeamBonds bonds(scene.bonds, scene.state.size());
  const dynamics::SheetFacets sheets(scene.sheet_facets, scene.state.size());
  const dynamics::Ties ties(scene);
  return dynamics::exact_critical_step(scene, {bonds, sheets, ties, 0.0}, AppliedLoads(scene),
                                       contacts, 0.0);
}

/// dt lies between (1 - error) of the reference and a little above it.
void expect_close(const ExactStep& step, double reference) {
  EXPECT_LE(step.error, 0.5e-5);
  EXPECT_NEAR(step.dt, reference, kTolerance * reference);
}

TEST(LargestEigenvalue, IsThatOfADenseMatrix) {
  Random random(1);
  for (const Eigen::Index size : {1, 2, 7, 60}) {
    const Eigen::MatrixXd half = Eigen::MatrixXd::NullaryExpr(
        size, size, [&](Eigen::Index, Eigen::Index) { return random.uniform(-1.0, 1.0); });
    const Eigen::MatrixXd matrix = half * half.transpose();
    const double largest = eigenvalues_of(matrix)[size - 1];

    const dynamics::LargestEigenvalue found = dynamics::largest_eigenvalue(
        {size, [&](const Eigen::VectorXd& x, Eigen::VectorXd& y) { y = matrix * x; }}, 1e-8, 100);

    EXPECT_NEAR(found.value, largest, 1e-8 * largest);
    EXPECT_LE(found.products, size);
  }
}

TEST(LargestEigenvalue, OfACrowdedSpectrumTakesFarFewerProductsThanThereAreEigenvalues) {
  // A chain of n equal springs and masses: 4 sin²(k pi / (2 n)), crowded at the upper end.
  constexpr Eigen::Index kSize = 20000;
  const auto multiply = [](const Eigen::VectorXd& x, Eigen::VectorXd& y) {
    y = 2.0 * x;
    y.head(kSize - 1) -= x.tail(kSize - 1);
    y.tail(kSize - 1) -= x.head(kSize - 1);
  };

  const auto found = dynamics::largest_eigenvalue({kSize, multiply}, 1e-3, 1000);

  EXPECT_LE(found.residual, 1e-3 * found.value);
  EXPECT_LT(found.products, 150);
  EXPECT_NEAR(found.value, 4.0, 4e-3);
}

TEST(LargestEigenvalue, OfNothingIsZero) {
  const auto zero = [](const Eigen::VectorXd&, Eigen::VectorXd& y) { y.setZero(); };

  EXPECT_EQ(dynamics::largest_eigenvalue({0, zero}, 1e-3, 10).value, 0.0);
  EXPECT_EQ(dynamics::largest_eigenvalue({5, zero}, 1e-3, 10).value, 0.0);
}

TEST(ExactStep, OfAnyFrameIsThatOfItsWholeMatrix) {
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    Scene scene = random_frame(random);
    if (i % 2 == 1) {
      for (Vec3& x : scene.state.position) x += random.in_cube(0.02);
    }

    expect_close(exact_step(scene), true_limit(scene));
  }
}

/// - d force / d displacement of sheets by central differences.
Eigen::MatrixXd sheet_matrix(const Scene& scene, double step) {
  SheetFacets sheets(scene.sheet_facets, scene.state.size());
  const Eigen::Index size = first_entry(scene.state.size());
  Eigen::MatrixXd stiffness(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const Eigen::VectorXd change = step * Eigen::VectorXd::Unit(size, i);
    stiffness.col(i) = (sheet_forces(sheets, moved(scene.state, -change)) -
                        sheet_forces(sheets, moved(scene.state, change))) /
                       (2.0 * step);
  }
  return stiffness;
}

TEST(ExactStep, OfASheetThatIsStretchedAndCurvedIsThatOfItsWholeMatrix) {
  Random random(6);
  for (int i = 0; i < 10; ++i) {
    const geometry::Mesh mesh = geometry::plane_sheet({0.3, 0.2, 3, 2});
    Scene scene;
    for (const Vec3& point : mesh.points) scene.add_node(point + random.in_cube(0.02));
    for (const auto& facet : mesh.facets)
      scene.add_sheet_facet(facet, dynamics::solid_sheet(0.004, 1e7, 0.3), 1000.0);
    for (Vec3& x : scene.state.position) x = 1.02 * x + random.in_cube(0.001);
    const double reference = true_limit(sheet_matrix(scene, 1e-6), scene.properties);

    expect_close(exact_step(scene), reference);
  }
}

TEST(ExactStep, OfContactsIsThatOfTheirSprings) {
  Random random(7);
  for (int i = 0; i < 100; ++i) {
    constexpr std::size_t kNodes = 6;
    Scene scene;
    for (std::size_t n = 0; n < kNodes; ++n) {
      scene.add_node(random.in_cube(1.0), n == 5 ? Held::everything : Held::nothing);
      scene.properties.mass[n] = std::abs(random.signed_power(-1.0, 1.0));
      scene.properties.inertia[n] = scene.properties.mass[n] * random.uniform(0.05, 0.5);
    }
    ContactMatrix matrix(kNodes);
    ContactSprings springs;
    const auto node = [](std::size_t n) { return geometry::id_at<NodeId>(n); };
    for (std::size_t k = 0; k < 9; ++k) {
      const ContactStiffness contact{random.direction(), std::abs(random.signed_power(-1.0, 1.0)),
                                     std::abs(random.signed_power(-2.0, 1.0)),
                                     random.uniform(0.1, 1.0), random.uniform(0.1, 1.0)};
      const double w = random.unit();
      const geometry::CorePoint core{{node(2), node(3), node(4 + random.index(2))},
                                     Vec3(w, 0.5 * (1.0 - w), 0.5 * (1.0 - w)),
                                     geometry::Feature(geometry::FaceId{0})};
      if (k % 3 == 0) {
        matrix.add(node(0), geometry::core_point(node(1)), contact);
        springs.add_pair(node(0), node(1), contact);
      } else if (k % 3 == 1) {
        matrix.add(node(k % 2), core, contact);
        springs.add_on_surface(node(k % 2), core, contact);
      } else {
        matrix.add_wall(node(k % 5), contact);
        springs.add_to_wall(node(k % 5), contact);
      }
    }

    const ExactStep step = exact_step(scene, springs);

    EXPECT_EQ(step.contacts, 9U);
    expect_close(step, true_limit(matrix.matrix(), scene.properties));
  }
}

TEST(ExactStep, CountsSpringsToGroundGasAndDamping) {
  Scene lump;
  add_lump(lump, Vec3::Zero());  // 2 kg
  lump.loads.ground_springs = {{{NodeId{0}}, Vec3(0.0, 50.0, 200.0)}};
  expect_close(exact_step(lump), 2.0 / std::sqrt(200.0 / 2.0));

  // With v' = -rate v the leapfrog is stable for (rate + 4 / (rate dt0²) ...) less than without:
  // dt²/dt0² + rate dt / 2 = 1.
  lump.loads.mass_damping = {{{NodeId{0}}, 30.0}};
  const double damped = exact_step(lump).dt;
  EXPECT_NEAR(damped * damped / 0.04 + 0.5 * 30.0 * damped, 1.0, 1e-3);

  Scene ball;
  const auto facets = add_membrane(ball, geometry::icosphere(0.1, 1));
  const double without = exact_step(ball).dt;
  ball.loads.pressures = {{facets, 0.0, {}, dynamics::Gas{1e8, 1.4}}};
  const AppliedLoads gas(ball);
  const double with = exact_step(ball).dt;
  EXPECT_LT(with, 0.8 * without);
  EXPECT_GE(with, (1.0 - kTolerance) * gas.critical_step(without, without, ball));
}

TEST(ExactStep, IsInfiniteWhereNothingIsStiffAndFree) {
  Scene scene;
  add_lump(scene, Vec3::Zero());

  EXPECT_TRUE(std::isinf(exact_step(scene).dt));
  EXPECT_TRUE(std::isinf(exact_step({}).dt));
}

/// Balls in a row that overlap, between two planes.
Scene row_of_balls(std::size_t count) {
  Scene scene;
  scene.materials = {{1e7, 0.3, 0.5}};
  for (std::size_t i = 0; i < count; ++i)
    scene.add_sphere(Vec3(0.0099 * static_cast<double>(i), 0.0, 0.0), 0.005, 2500.0, {});
  return scene;
}

TEST(ExactStep, OfASimulationCountsTheContactsThatTouch) {
  constexpr std::size_t kBalls = 12;
  const Scene scene = row_of_balls(kBalls);
  const double mass = scene.properties.mass[0];
  const double normal = 1e7 * 0.005;
  const double tangential = 0.3 * normal;
  ContactMatrix matrix(kBalls);
  for (std::size_t i = 1; i < kBalls; ++i)
    matrix.add(geometry::id_at<NodeId>(i - 1), geometry::core_point(geometry::id_at<NodeId>(i)),
               {Vec3::UnitX(), normal, tangential, 0.005, 0.005});

  const ExactStep step = simulation_of(scene, 0.0).exact_critical_step();

  EXPECT_EQ(step.contacts, kBalls - 1);
  expect_close(step, true_limit(matrix.matrix(), scene.properties));
  EXPECT_LT(step.dt, 2.0 / std::sqrt(normal / mass));
}

TEST(ExactStep, LeavesOutBondsThatAreBroken) {
  Scene scene;
  add_lump(scene, Vec3::Zero());
  add_lump(scene, Vec3::UnitX());
  scene.add_beam(NodeId{0}, NodeId{1}, dynamics::bar_section(0.01, 1e6), 0.0);
  dynamics::BondStrength strength;
  strength.strength = 1e4;  // Pa, at a strain of 1 percent
  scene.bond_laws = {{strength, {0}}};
  scene.state.velocity[1] = Vec3::UnitX();
  LoadedSimulation simulation = simulation_of(scene, 1e-3);
  const double stiffness = 1e6 * 1e-4 * std::numbers::pi;  // N/m; 2 kg at either end

  expect_close(simulation.exact_critical_step(), 2.0 / std::sqrt(stiffness));
  EXPECT_EQ(simulation.critical_cause().part.kind, dynamics::StepPart::Kind::bond);
  while (simulation.time() < 0.05) simulation.step();

  EXPECT_TRUE(std::isinf(simulation.exact_critical_step().dt));
  EXPECT_EQ(simulation.critical_cause().part.kind, dynamics::StepPart::Kind::nothing);
}

TEST(ExactStep, IsTheSameEveryTime) {
  const LoadedSimulation simulation = simulation_of(row_of_balls(40), 0.0);

  EXPECT_EQ(simulation.exact_critical_step().dt, simulation.exact_critical_step().dt);
}

}  // namespace
}  // namespace plekton::test::exact_step_test
