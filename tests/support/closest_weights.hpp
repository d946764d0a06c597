// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <algorithm>
#include <array>
#include <vector>

/// Where a ball should touch a triangle, and places to ask about it.
namespace plekton::test {

using geometry::Vec3;

/// Weights of the closest point of a triangle, the best of the foot in the plane, those on the
/// three lines clamped to the sides: nothing in common with the kernel, and in longer numbers.
inline Vec3 closest_weights(const std::array<Vec3, 3>& corners, const Vec3& point) {
  using Exact = Eigen::Matrix<long double, 3, 1>;
  const auto corner = [&](int i) {
    return Exact(corners[static_cast<std::size_t>(i)].cast<long double>());
  };
  std::vector<Exact> candidates;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Exact side = corner(j) - corner(i);
    const Exact to_point = point.cast<long double>() - corner(i);
    const long double t = std::clamp(to_point.dot(side) / side.squaredNorm(), 0.0L, 1.0L);
    Exact weights = Exact::Zero();
    weights[i] = 1.0L - t;
    weights[j] = t;
    candidates.push_back(weights);
  }
  const Exact u = corner(1) - corner(0);
  const Exact v = corner(2) - corner(0);
  const Exact p = point.cast<long double>() - corner(0);
  const long double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v);
  const long double s = (vv * p.dot(u) - uv * p.dot(v)) / (uu * vv - uv * uv);
  const long double t = (uu * p.dot(v) - uv * p.dot(u)) / (uu * vv - uv * uv);
  if (s >= 0.0L && t >= 0.0L && s + t <= 1.0L) candidates.push_back(Exact(1.0L - s - t, s, t));
  const auto distance = [&](const Exact& w) {
    return (point.cast<long double>() - w[0] * corner(0) - w[1] * corner(1) - w[2] * corner(2))
        .norm();
  };
  const Exact best =
      *std::min_element(candidates.begin(), candidates.end(),
                        [&](const Exact& a, const Exact& b) { return distance(a) < distance(b); });
  return best.cast<double>();
}

/// The point of a triangle with these weights.
inline Vec3 at_weights(const std::array<Vec3, 3>& corners, const Vec3& weights) {
  return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
}

/// Where a place lies beside a triangle in the plane z = 0.
struct Beside {
  double out;     ///< m, from the side, in the plane
  double height;  ///< m, over the plane
};

/// Three places beside each side of a triangle in the plane z = 0.
inline std::vector<Vec3> places_beside_edges(const std::array<Vec3, 3>& corners,
                                             const Beside& beside) {
  const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 side = corners[(i + 1) % 3] - corners[i];
    const Vec3 from_middle = corners[i] + 0.5 * side - middle;
    const Vec3 outward = from_middle - from_middle.dot(side) / side.squaredNorm() * side;
    for (const double t : {0.3, 0.5, 0.7})
      places.push_back(corners[i] + t * side + beside.out * outward.normalized() +
                       Vec3(0, 0, beside.height));
  }
  return places;
}

}  // namespace plekton::test
