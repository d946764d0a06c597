// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step/stiffest_motion.hpp"

#include "dynamics/model/scene.hpp"
#include "geometry/base/state_archive.hpp"
#include "tests/support/seeded_random.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace plekton::dynamics::stiffest_motion_test {
namespace {

using test::Random;

constexpr double kDifference = 1e-6;  // m
/// Of places of about 1 m, eps / 1e-6 m of the stiffness is left of rounding; what is left of other
/// motions after 32 products, of at most 0.6 of the stiffest, is (0.6)^64 of it.
constexpr double kTolerance = 1e-8;

/// Nodes with forces that are minus a matrix (N/m) times their displacements.
struct LinearForces {
  explicit LinearForces(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      scene.add_node(Vec3::Ones());
      scene.properties.mass.back() = 1.0;
    }
    matrix = Eigen::MatrixXd::Zero(size(), size());
  }
  Eigen::Index size() const { return static_cast<Eigen::Index>(3 * scene.state.size()); }

  void operator()(geometry::Positions x, NodeForces& forces) const {
    for (std::size_t i = 0; i < x.size(); ++i)
      for (std::size_t j = 0; j < x.size(); ++j)
        forces.force[i] -=
            matrix.block<3, 3>(static_cast<Eigen::Index>(3 * i), static_cast<Eigen::Index>(3 * j)) *
            (x[j] - scene.state.position[j]);
  }

  /// Takes as many products as the motion asks for. @returns how many
  int look(StiffestMotion& motion) const {
    const int products = motion.start(scene.properties);
    for (int i = 0; i < products; ++i) {
      const StiffestMotion::Places places{scene.state.position, kDifference};
      if (!motion.multiply(scene.properties, places, *this)) break;
      motion.follow(scene.properties);
    }
    return products;
  }

  Scene scene;
  Eigen::MatrixXd matrix;
};

/// Symmetric, with given eigenvalues of M^(-1/2) H M^(-1/2).
Eigen::MatrixXd random_matrix(Random& random, const Eigen::VectorXd& eigenvalues,
                              const std::vector<double>& masses) {
  const Eigen::Index size = eigenvalues.size();
  Eigen::MatrixXd matrix = eigenvalues.asDiagonal();
  for (Eigen::Index i = 0; i < size; ++i) {  // turned about by reflections
    Eigen::VectorXd v =
        Eigen::VectorXd::NullaryExpr(size, [&](Eigen::Index) { return random.uniform(-1.0, 1.0); });
    v.normalize();
    const Eigen::MatrixXd reflection =
        Eigen::MatrixXd::Identity(size, size) - 2.0 * v * v.transpose();
    matrix = reflection * matrix * reflection;
  }
  Eigen::VectorXd roots(size);
  for (Eigen::Index i = 0; i < size; ++i)
    roots[i] = std::sqrt(masses[static_cast<std::size_t>(i / 3)]);
  return roots.asDiagonal() * matrix * roots.asDiagonal();
}

Eigen::VectorXd eigenvalues_below(Random& random, Eigen::Index size, double largest) {
  Eigen::VectorXd eigenvalues = Eigen::VectorXd::NullaryExpr(
      size, [&](Eigen::Index) { return std::abs(largest) * random.uniform(-0.6, 0.6); });
  eigenvalues[0] = largest;
  return eigenvalues;
}

TEST(StiffestMotion, HasTheRateOfTheEigenvalueOfTheLargestMagnitude) {
  Random random(121);
  const RigidNodes rigid;
  for (const double largest : {500.0, -500.0}) {
    for (int trial = 0; trial < 20; ++trial) {
      LinearForces forces(4);
      for (double& mass : forces.scene.properties.mass)
        mass = std::abs(random.signed_power(-1.0, 1.0));
      forces.matrix = random_matrix(random, eigenvalues_below(random, 12, largest),
                                    forces.scene.properties.mass);
      StiffestMotion motion(rigid);
      motion.begin(4);
      for (std::size_t i = 0; i < 4; ++i) motion.add(i);

      forces.look(motion);

      EXPECT_NEAR(motion.rate(0), 500.0, kTolerance * 500.0);
    }
  }
}

TEST(StiffestMotion, HasARateForEachPartThatHasNothingToDoWithOthers) {
  Random random(122);
  const RigidNodes rigid;
  LinearForces forces(4);  // nodes 0 and 2, 1 and 3
  const std::vector<double> largest{80.0, -3000.0};
  for (std::size_t part = 0; part < 2; ++part) {
    const Eigen::MatrixXd own =
        random_matrix(random, eigenvalues_below(random, 6, largest[part]), {1.0, 1.0});
    for (const std::size_t i : {0U, 1U})
      for (const std::size_t j : {0U, 1U})
        forces.matrix.block<3, 3>(static_cast<Eigen::Index>(3 * (2 * i + part)),
                                  static_cast<Eigen::Index>(3 * (2 * j + part))) =
            own.block<3, 3>(static_cast<Eigen::Index>(3 * i), static_cast<Eigen::Index>(3 * j));
  }
  StiffestMotion motion(rigid);
  motion.begin(4);
  motion.set_part_count(2);
  for (std::size_t i = 0; i < 4; ++i) {
    motion.add(i);
    motion.set_part(i, static_cast<std::uint32_t>(i % 2));
  }

  forces.look(motion);

  for (std::size_t i = 0; i < 4; ++i) {
    const double expected = std::abs(largest[i % 2]);
    EXPECT_NEAR(motion.rate(i), expected, kTolerance * expected);
  }
}

/// Springs of 30, 100 and 50 N/m along x between four nodes of 1 kg.
LinearForces row_of_four() {
  LinearForces row(4);
  const std::vector<double> springs{30.0, 100.0, 50.0};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto a = static_cast<Eigen::Index>(3 * i), b = a + 3;
    row.matrix(a, a) += springs[i];
    row.matrix(b, b) += springs[i];
    row.matrix(a, b) -= springs[i];
    row.matrix(b, a) -= springs[i];
  }
  return row;
}

TEST(StiffestMotion, LeavesOutWhatIsHeldAndTakesInWhatItMoves) {
  const RigidNodes rigid;
  LinearForces row = row_of_four();
  row.scene.properties.held[1] = row.scene.properties.held[3] = Held::translation;
  StiffestMotion held(rigid);
  held.begin(4);
  for (std::size_t i = 0; i < 4; ++i) held.add(i);
  row.look(held);
  EXPECT_NEAR(held.rate(0), 150.0, kTolerance * 150.0);  // node 2 between two that are held

  // Nodes 2 and 3 are none that were named, but node 1 moves them.
  const LinearForces free = row_of_four();
  StiffestMotion motion(rigid);
  motion.begin(4);
  motion.add(0);
  motion.add(1);
  free.look(motion);
  EXPECT_TRUE(motion.has(3));
  // An eigenvalue of the row, and there is no other above twice the stiffest spring.
  const double rate = motion.rate(0);
  Eigen::Matrix4d left = -rate * Eigen::Matrix4d::Identity();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) left(i, j) += free.matrix(3 * i, 3 * j);
  EXPECT_GT(rate, 200.0);
  EXPECT_NEAR(left.determinant(), 0.0, 1e-5 * std::pow(rate, 4.0));

  for (Held& one : row.scene.properties.held) one = Held::everything;
  held.start(row.scene.properties);
  EXPECT_FALSE(held.multiply(row.scene.properties, {row.scene.state.position, kDifference}, row));
}

TEST(StiffestMotion, GoesOnFromItsLastLookOrFromAStateToTheBit) {
  Random random(123);
  const RigidNodes rigid;
  LinearForces forces(4);
  forces.matrix =
      random_matrix(random, eigenvalues_below(random, 12, 500.0), forces.scene.properties.mass);
  const auto begun = [&](StiffestMotion& motion) -> StiffestMotion& {
    motion.begin(4);
    for (std::size_t i = 0; i < 4; ++i) motion.add(i);
    return motion;
  };
  StiffestMotion motion(rigid);
  EXPECT_GT(forces.look(begun(motion)), StiffestMotion::kProducts);
  geometry::StateTree tree;
  motion.exchange(geometry::StateArchive::writer(tree));

  forces.matrix *= 1.01;
  EXPECT_EQ(forces.look(begun(motion)), StiffestMotion::kProducts);
  // All got 0.1 of another motion: (0.1)² (0.6)^8 of the stiffest is left of it.
  EXPECT_NEAR(motion.rate(0), 505.0, 1e-3 * 505.0);

  StiffestMotion resumed(rigid);
  resumed.exchange(geometry::StateArchive::reader(tree));
  EXPECT_EQ(forces.look(begun(resumed)), StiffestMotion::kProducts);
  EXPECT_EQ(resumed.rate(0), motion.rate(0));

  motion.forget();
  EXPECT_GT(forces.look(begun(motion)), StiffestMotion::kProducts);
}

/// Two springs of 300 N/m along z on nodes of a body of 5 kg: it moves as one.
TEST(StiffestMotion, OfARigidBodyIsThatOfItsMass) {
  Scene scene;
  scene.add_node(Vec3(-1, 0, 0));
  scene.add_node(Vec3(1, 0, 0));
  scene.add_rigid_body(std::vector{NodeId{0}, NodeId{1}}, {5.0, Vec3::Zero(), Mat3::Identity()});
  const RigidNodes rigid(scene.rigid_bodies, scene.state, scene.properties);
  StiffestMotion motion(rigid);
  motion.begin(3);
  motion.add(2);

  for (int i = motion.start(scene.properties); i > 0; --i) {
    motion.multiply(scene.properties, {scene.state.position, kDifference},
                    [](geometry::Positions x, NodeForces& forces) {
                      for (const std::size_t node : {0U, 1U})
                        forces.force[node] -= 300.0 * x[node].z() * Vec3::UnitZ();
                    });
    motion.follow(scene.properties);
  }

  EXPECT_NEAR(motion.rate(2), 600.0 / 5.0, kTolerance * 120.0);
}

}  // namespace
}  // namespace plekton::dynamics::stiffest_motion_test
