// SPDX-License-Identifier: GPL-3.0-or-later
// Sums and products of vectors have one order of additions, on every processor.
#include "geometry/base/types.hpp"

#include "geometry/base/bit_hash.hpp"
#include "geometry/base/pack.hpp"
#include "geometry/base/rotation_about.hpp"
#include "tests/support/seeded_random.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace plekton::geometry::types_test {
namespace {

/// The order in which the library adds three numbers everywhere, in packs too.
double sum(double x, double y, double z) {
  return x + (y + z);
}

Vec3 any_vector(test::Random& random) {
  return random.in_cube(1.0);
}

TEST(Vec3, AddsTheTermsOfAScalarProductInOneOrder) {
  test::Random random(3);
  int differ = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 u = any_vector(random), v = any_vector(random);
    const double expected = sum(u[0] * v[0], u[1] * v[1], u[2] * v[2]);
    differ += expected != (u[0] * v[0] + u[1] * v[1]) + u[2] * v[2] ? 1 : 0;

    EXPECT_EQ(u.dot(v), expected);
    EXPECT_EQ((u - v).squaredNorm(),
              sum((u[0] - v[0]) * (u[0] - v[0]), (u[1] - v[1]) * (u[1] - v[1]),
                  (u[2] - v[2]) * (u[2] - v[2])));
    EXPECT_EQ(u.norm(), std::sqrt(sum(u[0] * u[0], u[1] * u[1], u[2] * u[2])));
  }
  EXPECT_GT(differ, 100);  // another order would have been seen
}

TEST(Vec3, AddsAsPacksDo) {
  test::Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 u = any_vector(random), v = any_vector(random);
    const PackVec3<Pack<2>> pu{u[0], u[1], u[2]}, pv{v[0], v[1], v[2]};

    EXPECT_EQ(pu.dot(pv).lanes[1], u.dot(v));
    EXPECT_EQ((pu - pv).squaredNorm().lanes[0], (u - v).squaredNorm());
  }
}

// What else the library asks of Eigen: products of matrices and quaternions, eigenvalues, sums of
// many. The number is that of a build for SSE2 with GCC 12; with fused or wider operations it is
// another one.
TEST(Eigen, HasTheBitsThatItHasElsewhere) {
  test::Random random(5);
  BitHash hash;
  for (int i = 0; i < 300; ++i) {
    const Vec3 u = any_vector(random), v = any_vector(random);
    const Mat3 turn = rotation_about(u.normalized(), v[0]);
    const Mat3 product = turn * (v * u.transpose()) * turn.transpose();
    for (const double entry : product.reshaped()) hash.add(entry);
    const Quat q(u[0], v[0], v[1], u[2]), p(v[2], u[0], u[1], v[0]);
    const Quat both = q.normalized() * p;
    hash.add(Vec3(both * u));
    hash.add(both.w());
    Eigen::Matrix<double, 6, 6> symmetric;
    for (double& entry : symmetric.reshaped()) entry = random.uniform(-1.0, 1.0);
    symmetric = (symmetric * symmetric.transpose()).eval();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(symmetric);
    for (const double value : solver.eigenvalues()) hash.add(value);
    const Eigen::VectorXd many = Eigen::VectorXd::NullaryExpr(37, [&] { return random.unit(); });
    hash.add(many.squaredNorm());
  }

  EXPECT_EQ(hash.value(), 7028217514983210115U);
}

}  // namespace
}  // namespace plekton::geometry::types_test
