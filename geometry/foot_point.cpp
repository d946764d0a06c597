// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foot_point.hpp"

#include <algorithm>
#include <cmath>

namespace plekton::geometry {
namespace {

/// The part of v that is perpendicular to u. Done twice, because the first pass leaves a rest of the size of the
/// rounding error of v, which may exceed the result.
Vec3 perpendicular_part(const Vec3& v, const Vec3& u, double u_squared) noexcept {
  const Vec3 first = v - (v.dot(u) / u_squared) * u;
  return first - (first.dot(u) / u_squared) * u;
}

/// First corner of the longest side; side k joins corners k and k + 1.
std::size_t longest_side(const std::array<Vec3, 3>& x) noexcept {
  const double s0 = (x[1] - x[0]).squaredNorm();
  const double s1 = (x[2] - x[1]).squaredNorm();
  const double s2 = (x[0] - x[2]).squaredNorm();
  if (s0 >= s1 && s0 >= s2) return 0;
  return s1 >= s2 ? 1 : 2;
}

}  // namespace

FootPoint foot_on_node(const Vec3& point, const Vec3& x) noexcept {
  const Vec3 separation = x - point;
  const double distance = separation.norm();
  return {Vec3(1.0, 0.0, 0.0), distance > 0.0 ? Vec3(separation / distance) : Vec3::UnitZ(), distance};
}

FootPoint foot_on_edge(const Vec3& point, const std::array<Vec3, 2>& x) noexcept {
  const Vec3 u = x[1] - x[0];
  const double u_squared = u.squaredNorm();
  const Vec3 from_start = point - x[0];
  const Vec3 from_end = point - x[1];
  const bool near_end = from_end.squaredNorm() < from_start.squaredNorm();
  const double t = near_end ? 1.0 + from_end.dot(u) / u_squared : from_start.dot(u) / u_squared;
  const double weight = std::clamp(t, 0.0, 1.0);

  const Vec3 separation = -perpendicular_part(near_end ? from_end : from_start, u, u_squared);
  const double distance = separation.norm();
  const Vec3 direction = distance > 0.0 ? Vec3(separation / distance) : u.unitOrthogonal();
  return {Vec3(1.0 - weight, weight, 0.0), direction, distance};
}

FootPoint foot_on_face(const Vec3& point, const std::array<Vec3, 3>& x) noexcept {
  const std::size_t i = longest_side(x);
  const std::size_t j = (i + 1) % 3;
  const std::size_t k = (i + 2) % 3;
  const Vec3 e = x[j] - x[i];
  const double e_squared = e.squaredNorm();
  const Vec3 side = x[k] - x[i];
  const Vec3 v = perpendicular_part(side, e, e_squared);
  const Vec3 normal = e.cross(v).normalized();

  const Vec3 from_i = point - x[i];
  const Vec3 from_j = point - x[j];
  const Vec3& nearest = from_i.squaredNorm() <= from_j.squaredNorm() ? from_i : from_j;
  const double height = normal.dot(nearest);

  // point - x_i = alpha e + beta v + height normal, and x_k - x_i = tau e + v.
  const double beta = std::clamp(from_i.dot(v) / v.squaredNorm(), 0.0, 1.0);
  const double tau = side.dot(e) / e_squared;
  const double weight_j = std::clamp(from_i.dot(e) / e_squared - beta * tau, 0.0, 1.0 - beta);
  FootPoint foot{Vec3::Zero(), height < 0.0 ? normal : Vec3(-normal), std::abs(height)};
  if (height == 0.0) foot.direction = normal;
  foot.weights[static_cast<int>(k)] = beta;
  foot.weights[static_cast<int>(j)] = weight_j;
  foot.weights[static_cast<int>(i)] = 1.0 - beta - weight_j;
  return foot;
}

}  // namespace plekton::geometry
