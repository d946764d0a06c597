// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/closest/certificate.hpp"

#include "geometry/base/predicates.hpp"
#include "geometry/closest/corner_mask.hpp"

#include <algorithm>
#include <bit>

namespace plekton::geometry::closest {
namespace {

/// Conditions that must not be positive: whether all hold, and whether all are negative.
class Conditions {
 public:
  /// @returns whether it holds
  bool add(int sign) {
    is_strict_ = is_strict_ && sign < 0;
    return sign <= 0;
  }
  /// What the features carry that fulfil them all.
  Verdict verdict() const { return is_strict_ ? Verdict::unique : Verdict::tied; }
  bool is_strict() const { return is_strict_; }

 private:
  bool is_strict_ = true;
};

/// Calls holds(corner) for every corner that does not span the feature, until one does not.
template <class Holds>
bool all_others(Corners x, unsigned feature, Holds holds) {
  for (std::size_t k = 0; k < x.size(); ++k) {
    if ((feature >> k & 1U) == 0 && !holds(x[k])) return false;
  }
  return true;
}

Verdict corner_corner(Corners a, Corners b, WitnessFeatures witness_features) {
  const Vec3& p = a[first_of(witness_features.a)];
  const Vec3& q = b[first_of(witness_features.b)];
  if (p == q) return Verdict::touching;
  Conditions conditions;
  const bool holds =
      all_others(a, witness_features.a,
                 [&](const Vec3& x) { return conditions.add(sign_past_vertex(p, x, q)); }) &&
      all_others(b, witness_features.b,
                 [&](const Vec3& x) { return conditions.add(sign_past_vertex(q, x, p)); });
  return holds ? conditions.verdict() : Verdict::refuted;
}

bool is_over_side(const Vec3& p, const Vec3& first, const Vec3& last) {
  return sign_past_vertex(first, last, p) > 0 && sign_past_vertex(last, first, p) > 0;
}

/// A corner of a and a side of b. With v along the side from c, and w from the corner p to c, the
/// way from p to its foot is the part of w across v, and for any direction x its product with x is
/// (v x w).(v x x) / v.v.
Verdict corner_side(Corners a, unsigned corner, Corners b, unsigned side) {
  const Vec3& p = a[first_of(corner)];
  const Vec3& c = b[first_of(side)];
  const Vec3& d = b[last_of(side)];
  if (!is_over_side(p, c, d)) return Verdict::refuted;
  Conditions conditions;
  const auto stays_behind = [&](const Vec3& x) {
    return conditions.add(sign_of_crosses({c, d}, {p, c}, {p, x}));
  };
  const auto stays_beyond = [&](const Vec3& x) {
    return conditions.add(sign_inside_edge(c, d, x, p));
  };
  if (!all_others(a, corner, stays_behind) || !all_others(b, side, stays_beyond))
    return Verdict::refuted;
  const bool may_meet = !conditions.is_strict() || a.size() + b.size() == 3;
  if (may_meet && sign_of_crosses({c, d}, {c, p}, {c, p}) == 0) return Verdict::touching;
  return conditions.verdict();
}

Verdict corner_face(Corners a, unsigned corner, Corners b) {
  const Vec3& p = a[first_of(corner)];
  if (sign_inside_edge(b[0], b[1], b[2], p) <= 0 || sign_inside_edge(b[1], b[2], b[0], p) <= 0 ||
      sign_inside_edge(b[2], b[0], b[1], p) <= 0) {
    return Verdict::refuted;
  }
  const Difference u{b[0], b[1]};
  const Difference v{b[0], b[2]};
  const int above = sign_of_volume(u, v, {b[0], p});
  if (above == 0) return Verdict::touching;
  Conditions conditions;
  const bool holds = all_others(a, corner, [&](const Vec3& x) {
    return conditions.add(-above * sign_of_volume(u, v, {p, x}));
  });
  return holds ? conditions.verdict() : Verdict::refuted;
}

/// Whether the common perpendicular of two lines ends inside the first segment: with n = u x v its
/// parameter is ((c - a) x v).n / n.n, and ((c - b) x v).n / n.n less than that is 1.
bool ends_inside(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return sign_of_crosses({c, d}, {a, c}, {a, b}) > 0 && sign_of_crosses({c, d}, {b, c}, {b, a}) > 0;
}

Verdict side_side(Corners a, Corners b, WitnessFeatures witness_features) {
  const Vec3& a0 = a[first_of(witness_features.a)];
  const Vec3& a1 = a[last_of(witness_features.a)];
  const Vec3& b0 = b[first_of(witness_features.b)];
  const Vec3& b1 = b[last_of(witness_features.b)];
  if (!ends_inside(a0, a1, b0, b1) || !ends_inside(b0, b1, a0, a1)) return Verdict::refuted;
  const Difference u{a0, a1};
  const Difference v{b0, b1};
  const int above = sign_of_volume(u, v, {a0, b0});
  if (above == 0) return Verdict::touching;
  Conditions conditions;
  const bool holds = all_others(a, witness_features.a,
                                [&](const Vec3& x) {
                                  return conditions.add(above * sign_of_volume(u, v, {a0, x}));
                                }) &&
                     all_others(b, witness_features.b, [&](const Vec3& x) {
                       return conditions.add(-above * sign_of_volume(u, v, {b0, x}));
                     });
  return holds ? conditions.verdict() : Verdict::refuted;
}

}  // namespace

Verdict certify(Corners a, Corners b, WitnessFeatures witness_features) noexcept {
  const int count_a = std::popcount(witness_features.a);
  const int count_b = std::popcount(witness_features.b);
  if (count_a == 1 && count_b == 1) return corner_corner(a, b, witness_features);
  if (count_a == 1 && count_b == 2)
    return corner_side(a, witness_features.a, b, witness_features.b);
  if (count_a == 2 && count_b == 1)
    return corner_side(b, witness_features.b, a, witness_features.a);
  if (count_a == 1) return corner_face(a, witness_features.a, b);
  if (count_b == 1) return corner_face(b, witness_features.b, a);
  // A side and a face, as of cores that crossed: where they are apart, lower features are nearest.
  if (count_a + count_b > 4) return Verdict::refuted;
  return side_side(a, b, witness_features);
}

bool crosses(Corners segment, unsigned side, Corners triangle) noexcept {
  const Vec3& from = segment[first_of(side)];
  const Vec3& to = segment[last_of(side)];
  const Difference u{triangle[0], triangle[1]};
  const Difference v{triangle[0], triangle[2]};
  if (sign_of_volume(u, v, {triangle[0], from}) * sign_of_volume(u, v, {triangle[0], to}) >= 0)
    return false;
  int turn = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const int sign = sign_of_volume({from, to}, {from, triangle[k]}, {from, triangle[(k + 1) % 3]});
    if (sign == 0 || sign == -turn) return false;
    turn = sign;
  }
  return true;
}

bool is_lower_side(Corners b, Corners a) noexcept {
  if (b.size() != a.size()) return b.size() < a.size();
  for (std::size_t k = 0; k < a.size(); ++k) {
    for (int i = 0; i < 3; ++i) {
      if (b[k][i] != a[k][i]) return b[k][i] < a[k][i];
    }
  }
  return false;
}

}  // namespace plekton::geometry::closest
