// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/predicates.hpp"
#include "geometry/closest/corner_mask.hpp"
#include "geometry/closest/decide.hpp"
#include "geometry/closest/foot_point.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace plekton::geometry::closest {
namespace {

/// Distances below this share of the size of what they are computed from come from exact
/// arithmetic. The double results below are within 1e-15 of the size (foot_point_test.cpp,
/// side_side()), which is 2.6e-13 of a distance of this share. So do the foot points on faces whose
/// height is below this share of their size: the error of their normal is that of the height.
constexpr double kShortest = 0x1p-8;

/// Weights of both sides, and the separation from a to b (m).
struct Points {
  Vec3 weights_a;
  Vec3 weights_b;
  Vec3 separation;
};

Vec3 corner_weights(unsigned corner) {
  return Vec3::Unit(static_cast<Eigen::Index>(first_of(corner)));
}

Vec3 side_weights(unsigned side, double share_of_last) {
  Vec3 weights = Vec3::Zero();
  weights[static_cast<Eigen::Index>(first_of(side))] = 1.0 - share_of_last;
  weights[static_cast<Eigen::Index>(last_of(side))] = share_of_last;
  return weights;
}

bool is_short(double distance, double size, Relation relation) {
  if (distance >= kShortest * size || relation != Relation::apart) return false;
  ++closest_counters().exact_lengths;
  return true;
}

Points corner_side(Corners a, Corners b, const Decision& decision) {
  const auto [corner, side] = decision.witness_features;
  const Vec3& p = a[first_of(corner)];
  const Vec3& c = b[first_of(side)];
  const Vec3& d = b[last_of(side)];
  const FootPoint foot = foot_on_edge(p, {c, d});
  Points points{corner_weights(corner), side_weights(side, foot.weights[1]),
                foot.distance * foot.direction};
  if (is_short(foot.distance, (d - c).norm(), decision.relation))
    points.separation = exact_part_across({p, c}, {c, d});
  return points;
}

Points corner_face(Corners a, Corners b, const Decision& decision) {
  const unsigned corner = decision.witness_features.a;
  const Vec3& p = a[first_of(corner)];
  const FootPoint foot = foot_on_face(p, {b[0], b[1], b[2]});
  Points points{corner_weights(corner), foot.weights, foot.distance * foot.direction};
  const double square = std::max(
      {(b[1] - b[0]).squaredNorm(), (b[2] - b[1]).squaredNorm(), (b[0] - b[2]).squaredNorm()});
  const bool is_sliver = (b[1] - b[0]).cross(b[2] - b[0]).norm() < kShortest * square;
  if (is_short(foot.distance, std::sqrt(square), decision.relation) || is_sliver) {
    points.separation = exact_part_along_normal({p, b[0]}, {b[0], b[1]}, {b[0], b[2]});
    points.weights_b = exact_shares({b[0], p}, {b[0], b[1]}, {b[0], b[2]});
  }
  return points;
}

/// The part of w across v. Done twice, because the first pass leaves a rest of the size of the
/// rounding error of w, which may exceed the result.
Vec3 part_across(const Vec3& w, const Vec3& v, double v_squared) {
  const Vec3 first = w - (w.dot(v) / v_squared) * v;
  return first - (first.dot(v) / v_squared) * v;
}

/// Of two lines with the common perpendicular inside both sides. Everything is taken across the
/// longer side v: there the other one is u' and the way between their starts w', the parameter s =
/// w'.u' / u'.u' is a least-squares fit and w' - s u' its residual. Its length is as accurate as u'
/// and w', a few ulps of the size, but its direction is only perpendicular to u', so it is off by
/// the error of u' over the length of u'. Sides whose angle is below kShortest get exact points.
/// Where s leads past an end of v the points face each other at that end.
Points side_side(Corners a, Corners b, const Decision& decision) {
  const WitnessFeatures& witness_features = decision.witness_features;
  const Vec3& a0 = a[first_of(witness_features.a)];
  const Vec3& a1 = a[last_of(witness_features.a)];
  const Vec3& b0 = b[first_of(witness_features.b)];
  const Vec3& b1 = b[last_of(witness_features.b)];
  const Vec3 u = a1 - a0;
  const Vec3 v = b1 - b0;
  const Vec3 w = b0 - a0;
  const double uu = u.squaredNorm();
  const double vv = v.squaredNorm();
  const Vec3 u_across = part_across(u, v, vv);
  const Vec3 w_across = part_across(w, v, vv);
  const double across = u_across.squaredNorm();
  double s = across > 0.0 ? std::clamp(w_across.dot(u_across) / across, 0.0, 1.0) : 0.5;
  const Vec3 residual = w_across - s * u_across;
  const double free_t = (s * u - w).dot(v) / vv;
  const double t = std::clamp(free_t, 0.0, 1.0);
  if (t != free_t) s = std::clamp((t * v + w).dot(u) / uu, 0.0, 1.0);
  Points points{side_weights(witness_features.a, s), side_weights(witness_features.b, t), residual};
  const double size = std::sqrt(std::max({uu, vv, w.squaredNorm()}));
  const bool is_slight = across < kShortest * kShortest * uu;
  if (is_short(points.separation.norm(), size, decision.relation) || is_slight)
    points.separation = exact_part_along_normal({a0, b0}, {a0, a1}, {b0, b1});
  if (is_slight) {
    const Vec3 shares = exact_shares({a0, b0}, {a0, a1}, {b0, b1});
    points.weights_a = side_weights(witness_features.a, shares[1]);
    points.weights_b = side_weights(witness_features.b, -shares[2]);
  }
  return points;
}

Decision reversed(const Decision& decision) {
  return {{decision.witness_features.b, decision.witness_features.a}, decision.relation};
}
Points reversed(const Points& points) {
  return {points.weights_b, points.weights_a, -points.separation};
}

/// The sides are taken in an order that depends neither on which is called a, nor on the faces they
/// belong to.
Points side_side_in_order(Corners a, Corners b, const Decision& decision) {
  const auto ends = [](Corners x, unsigned side) {
    return std::array{x[first_of(side)], x[last_of(side)]};
  };
  const auto ends_a = ends(a, decision.witness_features.a);
  const auto ends_b = ends(b, decision.witness_features.b);
  const double length_a = (ends_a[1] - ends_a[0]).squaredNorm();
  const double length_b = (ends_b[1] - ends_b[0]).squaredNorm();
  const bool keeps =
      length_a < length_b || (length_a == length_b && !is_lower_side(ends_b, ends_a));
  return keeps ? side_side(a, b, decision) : reversed(side_side(b, a, reversed(decision)));
}

/// Of all but a side that goes through a face.
Points at_feet(Corners a, Corners b, const Decision& decision) {
  const int count_a = std::popcount(decision.witness_features.a);
  const int count_b = std::popcount(decision.witness_features.b);
  if (count_a == 2 && count_b == 2) return side_side_in_order(a, b, decision);
  if (count_a > 1) return reversed(at_feet(b, a, reversed(decision)));
  if (count_b == 3) return corner_face(a, b, decision);
  if (count_b == 2) return corner_side(a, b, decision);
  const auto [corner_a, corner_b] = decision.witness_features;
  return {corner_weights(corner_a), corner_weights(corner_b),
          b[first_of(corner_b)] - a[first_of(corner_a)]};
}

/// The common point of a side and a face, which it goes through at any angle: shares of volumes,
/// from exact arithmetic.
Points crossing(Corners a, unsigned side, Corners b) {
  const Vec3& from = a[first_of(side)];
  const Vec3& to = a[last_of(side)];
  const Difference u{b[0], b[1]};
  const Difference v{b[0], b[2]};
  const double before = std::abs(exact_volume(u, v, {b[0], from}));
  const double behind = std::abs(exact_volume(u, v, {b[0], to}));
  Vec3 weights;
  for (std::size_t k = 0; k < 3; ++k) {
    const double opposite =
        exact_volume({from, to}, {from, b[(k + 1) % 3]}, {from, b[(k + 2) % 3]});
    weights[static_cast<Eigen::Index>(k)] = std::abs(opposite);
  }
  const double height = before + behind;
  const double sum = weights.sum();
  return {side_weights(side, height > 0.0 ? before / height : 0.5),
          sum > 0.0 ? Vec3(weights / sum) : Vec3(Vec3::Constant(1.0 / 3.0)), Vec3::Zero()};
}

Points points_of(Corners a, Corners b, const Decision& decision) {
  const auto [of_a, of_b] = decision.witness_features;
  if (of_a == 7U && std::popcount(of_b) == 2) return reversed(crossing(b, of_b, a));
  if (of_b == 7U && std::popcount(of_a) == 2) return crossing(a, of_a, b);
  return at_feet(a, b, decision);
}

Vec3 equal_weights(unsigned corners) {
  Vec3 weights = Vec3::Zero();
  for (unsigned k = 0; k < 3; ++k) {
    if ((corners >> k & 1U) != 0) weights[k] = 1.0 / std::popcount(corners);
  }
  return weights;
}

/// Of features so small (below 1e-150 m) that the squares of their lengths vanish.
Points of_vanishing_features(Corners a, Corners b, WitnessFeatures witness_features) {
  const int count_a = std::popcount(witness_features.a);
  const int count_b = std::popcount(witness_features.b);
  const Difference w{a[first_of(witness_features.a)], b[first_of(witness_features.b)]};
  const Difference u{w.from, a[last_of(witness_features.a)]};
  const Difference v{w.to, b[last_of(witness_features.b)]};
  Vec3 separation = w.rounded();
  if (count_a + count_b == 3) separation = exact_part_across(w, count_a == 2 ? u : v);
  if (count_a == 2 && count_b == 2) separation = exact_part_along_normal(w, u, v);
  if (count_a == 3) separation = exact_part_along_normal(w, {a[0], a[1]}, {a[0], a[2]});
  if (count_b == 3) separation = exact_part_along_normal(w, {b[0], b[1]}, {b[0], b[2]});
  return {equal_weights(witness_features.a), equal_weights(witness_features.b), separation};
}

}  // namespace

namespace {

/// m, also where the square would vanish.
double length_of(const Vec3& v) {
  constexpr double kSquareHasAllBits = 1e-140;  // m
  const double length = v.norm();
  return length > kSquareHasAllBits ? length : v.stableNorm();
}

}  // namespace

ClosestPoints evaluate(Corners a, Corners b, const Decision& decision) noexcept {
  Points points = points_of(a, b, decision);
  if (!std::isfinite((points.weights_a + points.weights_b + points.separation).sum()))
    points = of_vanishing_features(a, b, decision.witness_features);
  if (decision.relation != Relation::apart) points.separation.setZero();
  return {points.weights_a,
          points.weights_b,
          points.separation,
          length_of(points.separation),
          decision.witness_features.a,
          decision.witness_features.b,
          decision.relation};
}

}  // namespace plekton::geometry::closest
