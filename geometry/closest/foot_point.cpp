// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/closest/foot_point.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plekton::geometry {
namespace {

/// The part of v that is perpendicular to u. Done twice, because the first pass leaves a rest of
/// the size of the rounding error of v, which may exceed the result.
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

/// From the nearer of two points to p, and 0 if that is the first, 1 if the second.
std::pair<Vec3, double> from_nearer_end(const Vec3& p, const Vec3& first,
                                        const Vec3& second) noexcept {
  const Vec3 from_first = p - first;
  const Vec3 from_second = p - second;
  if (from_second.squaredNorm() < from_first.squaredNorm()) return {from_second, 1.0};
  return {from_first, 0.0};
}

/// Direction and distance to a face, in the plane perpendicular to its longest side e: q leads to
/// the point, across is the unit vector towards the opposite corner at this height (m), or zero,
/// and step is the part of q along it.
///
/// For a sliver across is inaccurate, by the rounding error of a coordinate over the height. Far
/// above the face (many heights) the true step is at most the height, so that error times the
/// height is all that reaches the distance; near the face the perpendicular of e and across gives a
/// direction without cancellation.
FootPoint separation_from_face(const Vec3& q, const Vec3& e, const Vec3& across, double step,
                               double height) noexcept {
  if (q.squaredNorm() > 4.0 * height * height) {
    const Vec3 separation = step * across - q;
    const double distance = separation.norm();
    return {Vec3::Zero(), separation / distance, distance};
  }
  const Vec3 normal = height > 0.0 ? Vec3(e.cross(across).normalized()) : Vec3(e.unitOrthogonal());
  const double above = normal.dot(q);
  return {Vec3::Zero(), above > 0.0 ? Vec3(-normal) : normal, std::abs(above)};
}

}  // namespace

FootPoint foot_on_node(const Vec3& point, const Vec3& x) noexcept {
  const Vec3 separation = x - point;
  const double distance = separation.norm();
  return {Vec3(1.0, 0.0, 0.0), distance > 0.0 ? Vec3(separation / distance) : Vec3::UnitZ(),
          distance};
}

FootPoint foot_on_edge(const Vec3& point, const std::array<Vec3, 2>& x) noexcept {
  const Vec3 u = x[1] - x[0];
  const double u_squared = u.squaredNorm();
  const auto [to_point, start] = from_nearer_end(point, x[0], x[1]);
  const double weight = std::clamp(start + to_point.dot(u) / u_squared, 0.0, 1.0);

  const Vec3 separation = -perpendicular_part(to_point, u, u_squared);
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

  // x_k = x_i + tau e + v, and the foot point is x_i + alpha e + beta v; each from the nearer end
  // of e.
  const auto [side, side_start] = from_nearer_end(x[k], x[i], x[j]);
  const auto [to_point, point_start] = from_nearer_end(point, x[i], x[j]);
  const double tau = std::clamp(side_start + side.dot(e) / e_squared, 0.0, 1.0);
  const double alpha = std::clamp(point_start + to_point.dot(e) / e_squared, 0.0, 1.0);
  const Vec3 v = perpendicular_part(side, e, e_squared);
  const Vec3 q = perpendicular_part(to_point, e, e_squared);
  const double height = v.norm();
  const Vec3 across = height > 0.0 ? Vec3(v / height) : Vec3::Zero();

  // alpha is accurate whatever the shape; with it, beta ends where the triangle does.
  double end = 1.0;
  if (alpha < tau) end = alpha / tau;
  if (alpha > tau) end = (1.0 - alpha) / (1.0 - tau);
  const double step = std::clamp(q.dot(across), 0.0, end * height);
  const double beta = height > 0.0 ? std::min(step / height, end) : 0.0;
  const double weight_j = std::clamp(alpha - beta * tau, 0.0, 1.0 - beta);
  FootPoint foot = separation_from_face(q, e, across, step, height);
  foot.weights[static_cast<int>(k)] = beta;
  foot.weights[static_cast<int>(j)] = weight_j;
  foot.weights[static_cast<int>(i)] = 1.0 - beta - weight_j;
  return foot;
}

}  // namespace plekton::geometry
