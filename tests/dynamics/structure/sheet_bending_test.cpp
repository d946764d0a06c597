// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/sheet_bending.hpp"

#include "tests/support/linear_algebra.hpp"
#include "tests/support/seeded_random.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace plekton::test::sheet_bending_test {
namespace {

using dynamics::Mat6;
using dynamics::SheetSection;
using dynamics::Vec2;
using Corners = std::array<Vec2, 3>;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Vec9 = Eigen::Matrix<double, 9, 1>;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
/// Of the energy: a sum of some hundred products, with corners that are not flat.
constexpr double kTolerance = 1000.0 * kEpsilon;

/// Sides of about 1 m, angles of more than about 20 degrees.
Corners random_corners(Random& random) {
  const auto around = [&](double x, double y) {
    return Vec2(x + random.uniform(-0.2, 0.2), y + random.uniform(-0.2, 0.2));
  };
  return {around(0.0, 0.0), around(1.0, 0.0), around(0.4, 0.9)};
}

SheetSection random_section(Random& random) {
  return {1.0, random.uniform(-0.9, 0.9), random.uniform(0.5, 2.0), 0.01};
}

/// N m, of curvatures (k_11, k_22, 2 k_12).
Mat3 plate_matrix(const SheetSection& section) {
  const double nu = section.poisson_ratio;
  Mat3 matrix;
  matrix << 1.0, nu, 0.0, nu, 1.0, 0.0, 0.0, 0.0, 0.5 * (1.0 - nu);
  return section.bending_stiffness * matrix;
}

double area_of(const Corners& x) {
  const Vec2 a = x[1] - x[0], b = x[2] - x[0];
  return 0.5 * (a.x() * b.y() - a.y() * b.x());
}

/// The nodes' deflections and slopes.
struct Deflection {
  std::array<double, 3> w;    ///< m
  std::array<Vec2, 3> slope;  ///< grad w
};

Vec6 openings_of(const Deflection& plate, const Corners& x) {
  Vec6 openings;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 1; k < 3; ++k) {
      const std::size_t j = (i + k) % 3;
      openings[static_cast<Eigen::Index>(2 * i + k - 1)] =
          plate.w[j] - plate.w[i] - plate.slope[i].dot(x[j] - x[i]);
    }
  }
  return openings;
}

/// The element as it was published: Batoz, Bathe & Ho (1980), slopes beta_x = -w,x and beta_y = -w,y
/// as H . U, U = (w_i, w,y_i, -w,x_i) corner by corner, with their functions and constants of the
/// sides 23, 31 and 12.
double published_energy(const Deflection& plate, const Corners& x, const SheetSection& section) {
  Vec9 u;
  for (std::size_t i = 0; i < 3; ++i)
    u.segment<3>(static_cast<Eigen::Index>(3 * i)) << plate.w[i], plate.slope[i].y(),
        -plate.slope[i].x();
  std::array<double, 3> a{}, b{}, c{}, d{}, e{};  // of the sides opposite to corners 1, 2 and 3
  std::array<Vec2, 3> gradient;                   // 1/m, of the barycentric coordinates
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 side = x[(k + 1) % 3] - x[(k + 2) % 3];
    const double squared = side.squaredNorm();
    a[k] = -side.x() / squared;
    b[k] = 0.75 * side.x() * side.y() / squared;
    c[k] = (0.25 * side.x() * side.x() - 0.5 * side.y() * side.y()) / squared;
    d[k] = -side.y() / squared;
    e[k] = (0.25 * side.y() * side.y() - 0.5 * side.x() * side.x()) / squared;
    gradient[k] = Vec2(side.y(), -side.x()) / (2.0 * area_of(x));
  }
  double energy = 0.0;
  // Curvatures are linear, and the middles of the sides integrate their squares exactly.
  for (std::size_t side = 0; side < 3; ++side) {
    Vec3 at = Vec3::Constant(0.5);
    at[static_cast<Eigen::Index>(side)] = 0.0;
    const auto l = [&](std::size_t k) { return at[static_cast<Eigen::Index>(k)]; };
    std::array<Vec2, 3> corner, middle;  // 1/m, gradients of the quadratic shape functions
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      corner[k] = (4.0 * l(k) - 1.0) * gradient[k];
      middle[k] = 4.0 * (l(i) * gradient[j] + l(j) * gradient[i]);
    }
    Eigen::Matrix<double, 2, 9> beta_x, beta_y;  // columns: gradients
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t p = (i + 2) % 3, q = (i + 1) % 3;  // of corner 1 the sides 6 and 5
      const auto k = static_cast<Eigen::Index>(3 * i);
      // p is the side to the next corner, q that from the one before.
      beta_x.col(k) = 1.5 * (a[p] * middle[p] - a[q] * middle[q]);
      beta_x.col(k + 1) = b[q] * middle[q] + b[p] * middle[p];
      beta_x.col(k + 2) = corner[i] - c[q] * middle[q] - c[p] * middle[p];
      beta_y.col(k) = 1.5 * (d[p] * middle[p] - d[q] * middle[q]);
      beta_y.col(k + 1) = -corner[i] + e[q] * middle[q] + e[p] * middle[p];
      beta_y.col(k + 2) = -beta_x.col(k + 1);
    }
    const Vec2 of_x = beta_x * u, of_y = beta_y * u;
    const Vec3 curvature(of_x.x(), of_y.y(), of_x.y() + of_y.x());
    energy += area_of(x) / 3.0 * 0.5 * curvature.dot(plate_matrix(section) * curvature);
  }
  return energy;
}

TEST(PlateBending, IsThatOfThePublishedElementForAnyDeflectionsAndSlopes) {
  Random random(21);
  for (int trial = 0; trial < 200; ++trial) {
    const Corners corners = random_corners(random);
    const SheetSection section = random_section(random);
    Deflection plate;
    for (std::size_t i = 0; i < 3; ++i) {
      plate.w[i] = random.uniform(-1.0, 1.0);
      plate.slope[i] = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    }
    const double expected = published_energy(plate, corners, section);

    const Mat6 stiffness = dynamics::plate_bending(corners, section);

    const Vec6 openings = openings_of(plate, corners);
    EXPECT_NEAR(0.5 * openings.dot(stiffness * openings), expected, kTolerance * expected);
  }
}

/// Of w = 1/2 x . H x it is D/2 ((1 - nu) H : H + nu (tr H)²) for each area, by Kirchhoff.
TEST(PlateBending, OfAConstantCurvatureIsThatOfThePlate) {
  Random random(22);
  for (int trial = 0; trial < 200; ++trial) {
    const Corners corners = random_corners(random);
    const SheetSection section = random_section(random);
    const Vec3 curvature(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                         random.uniform(-1.0, 1.0));
    Eigen::Matrix2d h;
    h << curvature[0], 0.5 * curvature[2], 0.5 * curvature[2], curvature[1];
    Deflection plate;
    for (std::size_t i = 0; i < 3; ++i) {
      plate.w[i] = 0.5 * corners[i].dot(h * corners[i]);
      plate.slope[i] = h * corners[i];
    }
    const double nu = section.poisson_ratio;
    const double expected = 0.5 * section.bending_stiffness * area_of(corners) *
                            ((1.0 - nu) * h.squaredNorm() + nu * h.trace() * h.trace());

    const Vec6 openings = openings_of(plate, corners);
    const Mat6 stiffness = dynamics::plate_bending(corners, section);

    const double scale = 0.5 * openings.squaredNorm() * stiffness.norm();
    EXPECT_NEAR(0.5 * openings.dot(stiffness * openings), expected, kTolerance * scale);
  }
}

TEST(PlateBending, TakesEnergyForAnyOpenings) {
  Random random(23);
  for (int trial = 0; trial < 200; ++trial) {
    const Mat6 stiffness = dynamics::plate_bending(random_corners(random), random_section(random));

    EXPECT_EQ(stiffness, stiffness.transpose());
    const Eigen::VectorXd eigenvalues = eigenvalues_of(stiffness);
    EXPECT_GT(eigenvalues[0], 1e-4 * eigenvalues[5]);  // no mode without energy
  }
}

/// The energy of a plate is D times curvatures squared times area, and curvatures go with openings
/// over the size squared.
TEST(PlateBending, DoesNotDependOnTheFrameAndFallsWithTheSquareOfTheSize) {
  Random random(24);
  for (int trial = 0; trial < 50; ++trial) {
    const Corners corners = random_corners(random);
    const SheetSection section = random_section(random);
    const double size = random.uniform(0.1, 10.0);
    const Eigen::Rotation2Dd turn(random.uniform(0.0, 6.28));
    const Vec2 shift(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    Corners moved;
    for (std::size_t i = 0; i < 3; ++i) moved[i] = size * (turn * corners[i] + shift);

    const Mat6 here = dynamics::plate_bending(corners, section);
    const Mat6 there = dynamics::plate_bending(moved, section);

    EXPECT_LT((size * size * there - here).norm(), kTolerance * here.norm());
  }
}

}  // namespace
}  // namespace plekton::test::sheet_bending_test
