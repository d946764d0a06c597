// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/closest/certificate.hpp"

#include <array>
#include <limits>

/// Which features of two cores probably carry the nearest points, in plain double: right wherever
/// rounding does not matter, and certified or refuted afterwards.
namespace plekton::geometry::closest {

/// Feature of a segment or triangle that carries the foot of a point, and the squared distance
/// (m²).
struct Foot {
  double squared;
  unsigned witness_features;
};

inline Foot guess_foot(const Vec3& p, const std::array<Vec3, 2>& x) noexcept {
  const Vec3 u = x[1] - x[0];
  const Vec3 w = p - x[0];
  const double along = w.dot(u);
  const double length = u.squaredNorm();
  if (!(along > 0.0)) return {w.squaredNorm(), 1U};
  if (!(along < length)) return {(p - x[1]).squaredNorm(), 2U};
  return {(w - (along / length) * u).squaredNorm(), 3U};
}

/// Regions of a triangle as in Ericson, Real-Time Collision Detection (2005), 5.1.5.
inline Foot guess_foot(const Vec3& p, const std::array<Vec3, 3>& x) noexcept {
  const Vec3 u = x[1] - x[0];
  const Vec3 v = x[2] - x[0];
  const Vec3 w = p - x[0];
  const double uw = u.dot(w);
  const double vw = v.dot(w);
  if (uw <= 0.0 && vw <= 0.0) return {w.squaredNorm(), 1U};
  const double uu = u.squaredNorm();
  const double uv = u.dot(v);
  const double vv = v.squaredNorm();
  const double past_1 = uw - uu;
  const double past_2 = vw - vv;
  const double from_1 = vw - uv;  // v.(p - x1)
  const double from_2 = uw - uv;  // u.(p - x2)
  if (past_1 >= 0.0 && from_1 <= past_1) return {(p - x[1]).squaredNorm(), 2U};
  if (past_2 >= 0.0 && from_2 <= past_2) return {(p - x[2]).squaredNorm(), 4U};
  const double weight_2 = uu * vw - uv * uw;
  if (weight_2 <= 0.0 && uw >= 0.0 && past_1 <= 0.0) return {(w - (uw / uu) * u).squaredNorm(), 3U};
  const double weight_1 = vv * uw - uv * vw;
  if (weight_1 <= 0.0 && vw >= 0.0 && past_2 <= 0.0) return {(w - (vw / vv) * v).squaredNorm(), 5U};
  const double area = uu * vv - uv * uv;
  if (weight_1 + weight_2 >= area) {
    const Vec3 e = x[2] - x[1];
    const double share = (from_1 - past_1) / e.squaredNorm();
    return {(p - x[1] - share * e).squaredNorm(), 6U};
  }
  return {(w - (weight_1 / area) * u - (weight_2 / area) * v).squaredNorm(), 7U};
}

/// Squared distance (m²) of two lines, or infinity if their common perpendicular does not end
/// inside both segments.
inline double guess_lines(const Vec3& u, const Vec3& v, const Vec3& w) noexcept {
  const double uu = u.squaredNorm();
  const double vv = v.squaredNorm();
  const double uv = u.dot(v);
  const double uw = u.dot(w);
  const double vw = v.dot(w);
  const double area = uu * vv - uv * uv;
  const double s = uw * vv - vw * uv;
  const double t = uw * uv - vw * uu;
  if (!(s > 0.0 && s < area && t > 0.0 && t < area)) return std::numeric_limits<double>::infinity();
  return (w - (s / area) * u + (t / area) * v).squaredNorm();
}

constexpr std::array<unsigned, 3> kSides{3U, 6U, 5U};  ///< side k joins corners k and k + 1

template <std::size_t kCountA, std::size_t kCountB>
WitnessFeatures guess(const std::array<Vec3, kCountA>& a,
                      const std::array<Vec3, kCountB>& b) noexcept {
  double least = std::numeric_limits<double>::infinity();
  WitnessFeatures best{1U, 1U};
  const auto offer = [&](double squared, WitnessFeatures witness_features) {
    if (!(squared < least)) return;
    least = squared;
    best = witness_features;
  };
  for (std::size_t i = 0; i < kCountA; ++i) {
    const Foot foot = guess_foot(a[i], b);
    offer(foot.squared, {1U << i, foot.witness_features});
  }
  for (std::size_t i = 0; i < kCountB; ++i) {
    const Foot foot = guess_foot(b[i], a);
    offer(foot.squared, {foot.witness_features, 1U << i});
  }
  for (std::size_t i = 0; i < (kCountA == 2 ? 1 : 3); ++i) {
    const Vec3 u = a[(i + 1) % kCountA] - a[i];
    for (std::size_t k = 0; k < (kCountB == 2 ? 1 : 3); ++k) {
      const Vec3 v = b[(k + 1) % kCountB] - b[k];
      offer(guess_lines(u, v, b[k] - a[i]), {kSides[i], kSides[k]});
    }
  }
  return best;
}

}  // namespace plekton::geometry::closest
