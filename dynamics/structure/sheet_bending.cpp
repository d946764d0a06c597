// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/sheet_bending.hpp"

#include "dynamics/structure/sheet_kernel.hpp"

#include <Eigen/LU>

namespace plekton::dynamics {
namespace {

using Mat2 = Eigen::Matrix2d;
using Mat36 = Eigen::Matrix<double, 3, 6>;

/// Curvatures (k_11, k_22, 2 k_12) at a point from the slopes (two at each corner) against the
/// plane through the corners.
/// @param at  barycentric coordinates of the point
Mat36 curvatures(const std::array<Vec2, 3>& corners, const std::array<Vec2, 3>& gradients,
                 const Vec3& at) {
  std::array<std::array<Mat2, 3>, 2> slope_gradient;  // by component, by corner
  for (std::size_t r = 0; r < 2; ++r) {
    const Vec2 unit = Vec2::Unit(static_cast<Eigen::Index>(r));
    for (std::size_t a = 0; a < 3; ++a) {
      const double at_a = at[static_cast<Eigen::Index>(a)];
      Mat2 sum = unit * ((4.0 * at_a - 1.0) * gradients[a]).transpose();
      for (const std::size_t b : {(a + 1) % 3, (a + 2) % 3}) {
        // Between the ends of a side w is 0, and the slopes s_a, s_b along it give the middle -1/4
        // (s_a + s_b); across it is 1/2 (s_a + s_b).
        const Vec2 side = (corners[b] - corners[a]).normalized();
        const Vec2 middle = 0.5 * unit - (0.75 * side.dot(unit)) * side;
        const double at_b = at[static_cast<Eigen::Index>(b)];
        sum += middle * (4.0 * (at_a * gradients[b] + at_b * gradients[a])).transpose();
      }
      slope_gradient[r][a] = sum;
    }
  }
  Mat36 result;
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t r = 0; r < 2; ++r) {
      const Mat2& g = slope_gradient[r][a];
      result.col(static_cast<Eigen::Index>(2 * a + r)) << g(0, 0), g(1, 1), g(0, 1) + g(1, 0);
    }
  }
  return result;
}

/// Slopes against the plane from openings: q_ij = -s_i . e_ij.
Mat6 slopes_of_openings(const std::array<Vec2, 3>& corners) {
  Mat6 result = Mat6::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    Mat2 edges;
    edges << (corners[(i + 1) % 3] - corners[i]).transpose(),
        (corners[(i + 2) % 3] - corners[i]).transpose();
    const auto first = static_cast<Eigen::Index>(2 * i);
    result.block<2, 2>(first, first) = -edges.inverse();
  }
  return result;
}

}  // namespace

Mat6 plate_bending(const std::array<Vec2, 3>& corners, const SheetSection& section) noexcept {
  const double nu = section.poisson_ratio;
  Mat3 plate;
  plate << 1.0, nu, 0.0, nu, 1.0, 0.0, 0.0, 0.0, 0.5 * (1.0 - nu);
  const ShapeGradients shape = shape_gradients(corners);
  Mat6 stiffness = Mat6::Zero();
  // Curvatures are linear over the triangle: the middles of the sides integrate their squares.
  for (const Vec3& at : {Vec3(0.5, 0.5, 0.0), Vec3(0.0, 0.5, 0.5), Vec3(0.5, 0.0, 0.5)}) {
    const Mat36 b = curvatures(corners, shape.gradients, at);
    stiffness += (shape.area / 3.0 * section.bending_stiffness) * (b.transpose() * plate * b);
  }
  const Mat6 slopes = slopes_of_openings(corners);
  const Mat6 result = slopes.transpose() * stiffness * slopes;
  return 0.5 * (result + result.transpose());
}

}  // namespace plekton::dynamics
