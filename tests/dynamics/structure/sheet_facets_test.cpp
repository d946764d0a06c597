// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/sheet_facets.hpp"

#include "dynamics/scene_check.hpp"
#include "dynamics/structure/membrane_force.hpp"
#include "tests/support/linear_algebra.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/sheet_structure.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace plekton::test::sheet_facets_test {
namespace {

using dynamics::SheetSection;
using geometry::Mat3;
using geometry::Quat;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kModulus = 3e6;  // Pa
constexpr double kPoisson = 0.27;
constexpr double kThickness = 0.08;  // m
constexpr double kDensity = 900.0;   // kg/m³
constexpr double kSize = 1.0;        // m, about that of a facet
const SheetSection kSection = dynamics::solid_sheet(kThickness, kModulus, kPoisson);

/// A strip of n x n cells, their inner nodes moved at random, bent and turned before it is at rest.
Scene crumpled_sheet(int n, std::uint64_t seed, double bend = 0.3) {
  Random random(seed);
  Scene scene;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double x = i + random.uniform(-0.25, 0.25);
      const double y = j + random.uniform(-0.25, 0.25);
      scene.add_node(kSize * Vec3(x, y, bend * random.uniform(-1.0, 1.0)));
      scene.state.orientation.back() = Quat(random.rotation());
    }
  }
  const auto id = [&](int i, int j) { return NodeId{j * (n + 1) + i}; };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const bool other = random.coin();
      const NodeId a = id(i, j), b = id(i + 1, j), c = id(i + 1, j + 1), d = id(i, j + 1);
      scene.add_sheet_facet({a, b, other ? d : c}, kSection, kDensity);
      scene.add_sheet_facet({c, d, other ? b : a}, kSection, kDensity);
    }
  }
  return scene;
}

Eigen::VectorXd random_displacement(std::size_t nodes, double size, std::uint64_t seed) {
  Random random(seed);
  Eigen::VectorXd displacement(static_cast<Eigen::Index>(6 * nodes));
  for (double& entry : displacement) entry = random.uniform(-size, size);
  return displacement;
}

double energy_of(SheetFacets& sheets, const NodeState& state) {
  geometry::ThreadPool pool;
  sheets.advance(state, 0.0, pool);
  return sheets.elastic_energy();
}

/// N, of a facet that is stretched by its own length.
double force_scale() {
  return kSection.tensile_stiffness * kSize;
}

NodeState turned_and_moved(NodeState state, const Mat3& rotation, const Vec3& way) {
  for (Vec3& x : state.position) x = rotation * x + way;
  for (Quat& q : state.orientation) q = (Quat(rotation) * q).normalized();
  return state;
}

TEST(SheetFacets, AreAtRestAfterAnyRigidMotion) {
  const Scene scene = crumpled_sheet(3, 1);
  SheetFacets sheets(scene.sheet_facets, scene.state.size());
  Random random(2);
  for (int k = 0; k < 20; ++k) {
    const NodeState state = turned_and_moved(scene.state, random.rotation(), random.in_cube(5.0));

    // Positions up to 10 m are rounded by eps, and six facets pull at a node.
    EXPECT_LT(sheet_forces(sheets, state).lpNorm<Eigen::Infinity>(),
              500.0 * kEpsilon * force_scale());
  }
}

TEST(SheetFacets, PushWithTheGradientOfTheirEnergy) {
  const Scene scene = crumpled_sheet(3, 3);
  SheetFacets sheets(scene.sheet_facets, scene.state.size());
  for (const double size : {0.01, 0.3, 1.5}) {
    const NodeState state = moved(scene.state, random_displacement(scene.state.size(), size, 4));
    const Eigen::VectorXd forces = sheet_forces(sheets, state);
    const double energy = energy_of(sheets, state);

    constexpr double kStep = 1e-5;
    for (Eigen::Index k = 0; k < forces.size(); ++k) {
      const Eigen::VectorXd change = kStep * Eigen::VectorXd::Unit(forces.size(), k);
      const double slope =
          (energy_of(sheets, moved(state, change)) - energy_of(sheets, moved(state, -change))) /
          (2.0 * kStep);
      // The error of central differences is of second order, and the energy is rounded.
      const double tolerance = 20.0 * kStep * kStep * force_scale() * (1.0 + size * size) +
                               20.0 * kEpsilon * energy / kStep;
      EXPECT_NEAR(forces[k], -slope, tolerance) << "entry " << k << ", size " << size;
    }
  }
}

TEST(SheetFacets, BalanceMomentumAndAngularMomentumInAnyConfiguration) {
  const Scene scene = crumpled_sheet(4, 5);
  SheetFacets sheets(scene.sheet_facets, scene.state.size());
  for (const double size : {0.01, 1.0}) {
    const NodeState state = moved(scene.state, random_displacement(scene.state.size(), size, 6));
    const Eigen::VectorXd forces = sheet_forces(sheets, state);

    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
    double force_sum = 0.0, moment_sum = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i) {
      const Vec3 force = forces.segment<3>(static_cast<Eigen::Index>(6 * i));
      const Vec3 torque = forces.segment<3>(static_cast<Eigen::Index>(6 * i + 3));
      sum += force;
      moment += state.position[i].cross(force) + torque;
      force_sum += force.norm();
      moment_sum += state.position[i].norm() * force.norm() + torque.norm();
    }
    EXPECT_LT(sum.norm(), 1e-13 * force_sum);
    EXPECT_LT(moment.norm(), 1e-13 * moment_sum);
  }
}

TEST(SheetFacets, ForcesTurnWithTheSheet) {
  const Scene scene = crumpled_sheet(3, 7);
  SheetFacets sheets(scene.sheet_facets, scene.state.size());
  const NodeState state = moved(scene.state, random_displacement(scene.state.size(), 0.3, 8));
  const Eigen::VectorXd before = sheet_forces(sheets, state);
  Random random(9);
  const Mat3 rotation = random.rotation();

  const Eigen::VectorXd after =
      sheet_forces(sheets, turned_and_moved(state, rotation, Vec3(1.0, 2.0, 3.0)));

  for (Eigen::Index k = 0; k < before.size(); k += 3)
    EXPECT_LT((after.segment<3>(k) - rotation * before.segment<3>(k)).norm(),
              500.0 * kEpsilon * force_scale());
}

// A patch of any triangles under a linear displacement has the same strain everywhere: N = E t / (1
// - nu²) (E + nu (tr E I - E)), and nodes inside feel nothing.
TEST(SheetFacets, AreUnderUniformStressWhenStretchedUniformly) {
  constexpr int kCells = 4;
  Scene scene = crumpled_sheet(kCells, 11, 0.0);
  SheetFacets sheets(scene.sheet_facets, scene.state.size());
  Mat3 gradient = Mat3::Identity();
  gradient.topLeftCorner<2, 2>() << 1.03, 0.02, 0.02, 0.96;  // symmetric: nodes need not turn
  for (Vec3& x : scene.state.position) x = gradient * x;

  const Eigen::VectorXd forces = sheet_forces(sheets, scene.state);

  const Eigen::Matrix2d f = gradient.topLeftCorner<2, 2>();
  const Eigen::Matrix2d strain = 0.5 * (f.transpose() * f - Eigen::Matrix2d::Identity());
  const Eigen::Matrix2d stress =
      kSection.tensile_stiffness / (1.0 - kPoisson * kPoisson) *
      ((1.0 - kPoisson) * strain + kPoisson * strain.trace() * Eigen::Matrix2d::Identity());
  const Eigen::Matrix2d cauchy = f * stress * f.transpose() / f.determinant();
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    const Mat3 seen = sheets.membrane_force(i, scene.state.position);
    EXPECT_LT((seen.topLeftCorner<2, 2>() - cauchy).norm(), 1e-13 * kSection.tensile_stiffness);
    EXPECT_LT(seen.col(2).norm() + seen.row(2).norm(), 1e-15 * kSection.tensile_stiffness);
  }
  for (int j = 1; j < kCells; ++j) {
    for (int i = 1; i < kCells; ++i) {
      const auto k = static_cast<Eigen::Index>(6 * (j * (kCells + 1) + i));
      EXPECT_LT(forces.segment<6>(k).norm(), 100.0 * kEpsilon * force_scale());
    }
  }
}

// A patch of any triangles bent into a constant curvature: w = 1/2 x . H x, nodes turned with it.
// Nodes inside feel nothing, and the energy is that of the plate, D/2 ((1 - nu) H : H + nu (tr
// H)²) for each area.
TEST(SheetFacets, MeetAConstantCurvatureExactlyWhateverTheMesh) {
  constexpr int kCells = 4;
  constexpr double kSmall = 1e-6;  // so that second-order terms are below the tolerance
  const Scene scene = crumpled_sheet(kCells, 12, 0.0);
  SheetFacets sheets(scene.sheet_facets, scene.state.size());
  double area = 0.0;
  for (const auto& facet : scene.sheet_facets) area += dynamics::area_of(facet);
  Random random(13);
  for (int trial = 0; trial < 5; ++trial) {
    Eigen::Matrix2d h;
    const double twist = random.uniform(-1.0, 1.0);
    h << random.uniform(-1.0, 1.0), twist, twist, random.uniform(-1.0, 1.0);
    h *= kSmall;
    Eigen::VectorXd displacement =
        Eigen::VectorXd::Zero(static_cast<Eigen::Index>(6 * scene.state.size()));
    for (std::size_t i = 0; i < scene.state.size(); ++i) {
      const Eigen::Vector2d x = scene.state.position[i].head<2>();
      const Eigen::Vector2d slope = h * x;
      const auto k = static_cast<Eigen::Index>(6 * i);
      displacement[k + 2] = 0.5 * x.dot(slope);
      displacement[k + 3] = slope.y();
      displacement[k + 4] = -slope.x();
    }

    const NodeState state = moved(scene.state, displacement);
    const Eigen::VectorXd forces = sheet_forces(sheets, state);

    const double d = kSection.bending_stiffness;
    const double expected =
        0.5 * d * area * ((1.0 - kPoisson) * h.squaredNorm() + kPoisson * h.trace() * h.trace());
    EXPECT_NEAR(energy_of(sheets, state) / expected, 1.0, 1e-6);
    for (int j = 1; j < kCells; ++j) {
      for (int i = 1; i < kCells; ++i) {
        const auto k = static_cast<Eigen::Index>(6 * (j * (kCells + 1) + i));
        // Openings are known to eps of a length, 1e-10 of their size. In the plane the stretch of
        // second order pulls, about E t (slope)².
        EXPECT_LT(forces.segment<3>(k + 2).norm(), 1e-7 * d * h.norm());
      }
    }
  }
}

Scene flat_sheet(int n, double thickness) {
  Scene scene;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) scene.add_node(kSize * Vec3(i, j, 0.0));
  const SheetSection section = dynamics::solid_sheet(thickness, kModulus, kPoisson);
  const auto id = [&](int i, int j) { return NodeId{j * (n + 1) + i}; };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      scene.add_sheet_facet({id(i, j), id(i + 1, j), id(i + 1, j + 1)}, section, kDensity);
      scene.add_sheet_facet({id(i, j), id(i + 1, j + 1), id(i, j + 1)}, section, kDensity);
    }
  }
  return scene;
}

/// s, 2 / omega of the fastest mode, from the forces.
double exact_critical_step(const Scene& scene, const NodeState& state) {
  SheetFacets sheets(scene.sheet_facets, scene.state.size());
  const auto size = static_cast<Eigen::Index>(6 * state.size());
  Eigen::MatrixXd matrix(size, size);
  Eigen::VectorXd root(size);
  constexpr double kStep = 1e-6;
  for (Eigen::Index k = 0; k < size; ++k) {
    const Eigen::VectorXd change = kStep * Eigen::VectorXd::Unit(size, k);
    matrix.col(k) =
        (sheet_forces(sheets, moved(state, -change)) - sheet_forces(sheets, moved(state, change))) /
        (2.0 * kStep);
    const auto node = static_cast<std::size_t>(k / 6);
    root[k] =
        1.0 / std::sqrt(k % 6 < 3 ? scene.properties.mass[node] : scene.properties.inertia[node]);
  }
  const Eigen::MatrixXd scaled = root.asDiagonal() * matrix * root.asDiagonal();
  return 2.0 / std::sqrt(eigenvalues_of(0.5 * (scaled + scaled.transpose()))[size - 1]);
}

TEST(SheetFacets, GiveACriticalTimeStepBelowTheTrueOneButNotByHalf) {
  for (const double thickness : {0.01, 0.1, 0.5}) {
    const Scene scene = flat_sheet(4, thickness);
    for (const double stretch : {1.0, 1.1, 0.9}) {
      NodeState state = scene.state;
      for (Vec3& x : state.position) x *= stretch;
      SheetFacets sheets(scene.sheet_facets, scene.state.size());
      dynamics::NodalStiffness stiffness(scene.state.size());

      sheets.add_to(stiffness, state);

      const double ratio =
          stiffness.critical_step(scene.properties).dt / exact_critical_step(scene, state);
      EXPECT_LE(ratio, 1.0) << "thickness " << thickness << ", stretch " << stretch;
      EXPECT_GT(ratio, 0.5) << "thickness " << thickness << ", stretch " << stretch;
    }
  }
}

TEST(SheetFacets, GiveTheSameBitsForAnyNumberOfThreads) {
  const Scene scene = crumpled_sheet(12, 14);
  const NodeState state = moved(scene.state, random_displacement(scene.state.size(), 0.2, 15));
  SheetFacets sheets(scene.sheet_facets, scene.state.size());
  const Eigen::VectorXd one = sheet_forces(sheets, state, 1);
  for (const int threads : {2, 4}) EXPECT_EQ(sheet_forces(sheets, state, threads), one);
}

TEST(SheetFacets, TellPrincipalForcesOfAMembraneForce) {
  const Mat3 rotation = Random(16).rotation();
  const auto [largest, smallest] = dynamics::principal_forces(
      rotation * Vec3(-3.0, 5.0, 0.0).asDiagonal() * rotation.transpose());

  EXPECT_NEAR(largest, 5.0, 1e-14);
  EXPECT_NEAR(smallest, -3.0, 1e-14);
}

TEST(SheetFacets, StayFiniteWithoutArea) {
  Scene scene = flat_sheet(1, kThickness);
  SheetFacets sheets(scene.sheet_facets, scene.state.size());
  for (Vec3& x : scene.state.position) x = Vec3(1.0, 2.0, 3.0);
  dynamics::NodalStiffness stiffness(scene.state.size());

  sheets.add_to(stiffness, scene.state);

  EXPECT_TRUE(sheet_forces(sheets, scene.state).allFinite());
  EXPECT_EQ(sheets.membrane_force(0, scene.state.position), Mat3::Zero());
  EXPECT_TRUE(std::isfinite(stiffness.critical_step(scene.properties).dt));
}

TEST(SheetFacets, GiveTheirMassToTheirNodes) {
  const Scene scene = flat_sheet(3, kThickness);
  double mass = 0.0;
  for (const double m : scene.properties.mass) mass += m;

  EXPECT_NEAR(mass, kDensity * kThickness * 9.0 * kSize * kSize, 1e-12 * mass);
  for (std::size_t i = 0; i < scene.state.size(); ++i)
    EXPECT_NEAR(scene.properties.inertia[i],
                0.1 * kThickness * kThickness * scene.properties.mass[i], 1e-15);
}

TEST(SheetFacets, ListEveryProblem) {
  Scene scene = flat_sheet(1, kThickness);
  scene.sheet_facets[0].nodes = {NodeId{0}, NodeId{0}, NodeId{7}};
  scene.sheet_facets[1].section = {0.0, 1.0, -1.0, 0.0};
  scene.sheet_facets[1].corners.fill({1.0, 1.0});

  try {
    dynamics::check(scene);
    FAIL() << "no problem found";
  } catch (const std::invalid_argument& problems) {
    const std::string text = problems.what();
    for (const char* expected :
         {"sheet facet 0 (nodes 0, 0, 7): there is no node 7, only 4 nodes", "it repeats a node",
          "sheet facet 1 (nodes 0, 3, 2): tensile stiffness (N/m) is 0", "Poisson's ratio is 1",
          "bending stiffness (N m) is -1", "thickness (m) is 0", "its area at rest is 0"})
      EXPECT_NE(text.find(expected), std::string::npos) << expected << " in\n" << text;
  }
}

TEST(SheetFacets, RefuseAFacetWithoutArea) {
  Scene scene;
  for (int i = 0; i < 3; ++i) scene.add_node(Vec3(i, 2.0 * i, 0.0));
  EXPECT_THROW(scene.add_sheet_facet({NodeId{0}, NodeId{1}, NodeId{2}}, kSection, 1.0),
               std::invalid_argument);
}

}  // namespace
}  // namespace plekton::test::sheet_facets_test
