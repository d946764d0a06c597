// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/pack.hpp"
#include "geometry/base/types.hpp"

#include <array>

/// The foot of a point inside a triangle, for some points and triangles side by side.
namespace plekton::geometry {

/// Foot of the perpendicular from a point on a triangle.
template <class Real>
struct FaceFootOf {
  PackVec3<Real> weights;    ///< of the corners, sum 1
  PackVec3<Real> direction;  ///< unit, from the point to the foot
  Real distance;             ///< m
  /// Positive where the exact signs certainly say that the foot is inside, nearer than the range,
  /// and that neither a side nor a corner is; else nothing is known.
  Real is_alone;
};

namespace detail {

template <class Real, class Mask>
PLEKTON_INLINE PackVec3<Real> choose(const Mask& condition, const PackVec3<Real>& u,
                                     const PackVec3<Real>& v) noexcept {
  return {select(condition, u.x, v.x), select(condition, u.y, v.y), select(condition, u.z, v.z)};
}

template <class Real>
PLEKTON_INLINE PackVec3<Real> quotient(const PackVec3<Real>& v, const Real& s) noexcept {
  return {v.x / s, v.y / s, v.z / s};
}

/// The smallest of some numbers; none that is NaN is found if a later one is not. Conditions are
/// joined by it, x > y as x - y > 0, which rounding keeps: GCC 12 takes conditions that are joined
/// as such apart, lane by lane.
template <class Real, class... More>
PLEKTON_INLINE Real smallest_of(const Real& first, const Real& second,
                                const More&... more) noexcept {
  const Real smaller = smaller_of(first, second);
  if constexpr (sizeof...(more) == 0)
    return smaller;
  else
    return smallest_of(smaller, more...);
}

/// std::clamp, also of signed zeros.
template <class Real>
PLEKTON_INLINE Real clamped(const Real& x, const Real& low, const Real& high) noexcept {
  return select(low > x, low, select(x > high, high, x));
}

/// Offset of a point from the nearer one of two, and 0 if that is the first, 1 if the second.
template <class Real>
struct NearerEndOf {
  PackVec3<Real> offset;
  Real start;
  PLEKTON_INLINE NearerEndOf(const PackVec3<Real>& p, const PackVec3<Real>& first,
                             const PackVec3<Real>& second) noexcept {
    const PackVec3<Real> from_first = p - first;
    const PackVec3<Real> from_second = p - second;
    const auto is_second = from_first.squaredNorm() > from_second.squaredNorm();
    offset = choose(is_second, from_second, from_first);
    start = select(is_second, Real(1.0), Real(0.0));
  }
};

template <class Real>
PLEKTON_INLINE PackVec3<Real> perpendicular_part(const PackVec3<Real>& v, const PackVec3<Real>& u,
                                                 const Real& u_squared) noexcept {
  const PackVec3<Real> first = v - (v.dot(u) / u_squared) * u;
  return first - (first.dot(u) / u_squared) * u;
}

/// Positive where the line along u through a point at w from it is surely farther than a range; as
/// in critical_features.cpp.
template <class Real>
PLEKTON_INLINE Real line_is_beyond(const PackVec3<Real>& w, const PackVec3<Real>& u,
                                   const Real& range_squared) noexcept {
  const Real along = w.dot(u);
  const Real w_squared = w.squaredNorm();
  const Real u_squared = u.squaredNorm();
  return (w_squared - range_squared) * u_squared -
         (along * along + Real(1e-12) * w_squared * u_squared);
}

/// A triangle and a point, in numbers that tell certain cases apart, for any Real. Side k joins
/// corners k and k + 1.
template <class Real>
struct FaceSidesOf {
  std::array<Real, 3> side;  ///< m⁴, positive where the foot is inside of it
  Real error;                ///< m⁴, of these
  Real is_usual;             ///< positive where the error is known
  Real height;               ///< m³, over the plane, times |n|
  Real normal_squared;       ///< m⁴, n.n
  PLEKTON_INLINE FaceSidesOf(const PackVec3<Real>& point,
                             const std::array<PackVec3<Real>, 3>& x) noexcept {
    const PackVec3<Real> u = x[1] - x[0];
    const PackVec3<Real> v = x[2] - x[0];
    const PackVec3<Real> w = point - x[0];
    const PackVec3<Real> normal = u.cross(v);
    const PackVec3<Real> turned = normal.cross(w);
    normal_squared = normal.squaredNorm();
    side[0] = -u.dot(turned);
    side[2] = v.dot(turned);
    side[1] = normal_squared - side[0] - side[2];
    const Real length_squared = larger_of(u.squaredNorm(), v.squaredNorm());
    const Real reach_squared = larger_of(w.squaredNorm(), length_squared);
    error = Real(2e-13) * length_squared * reach_squared;
    is_usual = smaller_of(Real(length_squared - Real(1e-70)), Real(Real(1e70) - reach_squared));
    height = normal.dot(w);
  }
};

/// Positive where the line of side k of a triangle is surely farther than range from a point.
template <class Real>
PLEKTON_INLINE Real side_is_beyond(std::size_t k, const PackVec3<Real>& point,
                                   const std::array<PackVec3<Real>, 3>& x,
                                   const Real& range) noexcept {
  const std::size_t next = k == 2 ? 0 : k + 1;
  const Real range_squared = range * range * Real(1.0 + 1e-12);
  return line_is_beyond(PackVec3<Real>(point - x[k]), PackVec3<Real>(x[next] - x[k]),
                        range_squared);
}

/// Positive where is_alone, but for the distance; FaceView's quick test against the range has to
/// fail too. A corner is no nearer than the line of a side through it.
template <class Real>
PLEKTON_INLINE Real is_inside_alone(const PackVec3<Real>& point,
                                    const std::array<PackVec3<Real>, 3>& x, const Real& range,
                                    const PackVec3<Real>& may_be_near) noexcept {
  const FaceSidesOf<Real> of(point, x);
  const Real is_inside = smaller_of(of.side[0], smaller_of(of.side[1], of.side[2])) - of.error;
  const Real is_near = range * range * of.normal_squared - of.height * of.height;
  return smallest_of(of.is_usual, is_inside, is_near,
                     larger_of(may_be_near.x, side_is_beyond(0, point, x, range)),
                     larger_of(may_be_near.y, side_is_beyond(1, point, x, range)),
                     larger_of(may_be_near.z, side_is_beyond(2, point, x, range)));
}

}  // namespace detail

/// Whether the foot of a point on the plane of a triangle is certainly across its side 0, and both
/// other sides farther than range (m): nothing of the triangle but side 0 may be in range, and the
/// point is nearer to side 0 than to the inside.
inline bool is_across_first_side(const Vec3& point, const std::array<Vec3, 3>& corners,
                                 double range) noexcept {
  using Vector = PackVec3<double>;
  const auto vector = [](const Vec3& v) { return Vector{v.x(), v.y(), v.z()}; };
  const std::array<Vector, 3> x{vector(corners[0]), vector(corners[1]), vector(corners[2])};
  const Vector p = vector(point);
  const detail::FaceSidesOf<double> of(p, x);
  return detail::smallest_of(of.is_usual, -of.side[0] - of.error,
                             detail::side_is_beyond(1, p, x, range),
                             detail::side_is_beyond(2, p, x, range)) > 0.0;
}

/// Where is_alone, this is what foot_on_face() finds, to the last bit, line by line.
/// @param range  m, > 0
/// @param may_be_near  by side: 1 where the side may be in range all the same, because it is known
///                     not to touch by itself; else -1
template <class Real>
PLEKTON_INLINE FaceFootOf<Real> face_foot(const PackVec3<Real>& point,
                                          const std::array<PackVec3<Real>, 3>& x, const Real& range,
                                          const PackVec3<Real>& may_be_near) noexcept {
  using Vector = PackVec3<Real>;
  using namespace detail;
  // The longest side leads from corner i to corner j.
  const Real s0 = Vector(x[1] - x[0]).squaredNorm();
  const Real s1 = Vector(x[2] - x[1]).squaredNorm();
  const Real s2 = Vector(x[0] - x[2]).squaredNorm();
  const auto first = s0 >= larger_of(s1, s2);
  const auto second = s1 >= s2;
  const Vector xi = choose(first, x[0], choose(second, x[1], x[2]));
  const Vector xj = choose(first, x[1], choose(second, x[2], x[0]));
  const Vector xk = choose(first, x[2], choose(second, x[0], x[1]));
  const Vector e = xj - xi;
  const Real e_squared = e.squaredNorm();

  const NearerEndOf<Real> side(xk, xi, xj);
  const NearerEndOf<Real> to_point(point, xi, xj);
  const Real zero = 0.0;
  const Real one = 1.0;
  const Real tau = clamped(Real(side.start + side.offset.dot(e) / e_squared), zero, one);
  const Real alpha = clamped(Real(to_point.start + to_point.offset.dot(e) / e_squared), zero, one);
  const Vector v = perpendicular_part(side.offset, e, e_squared);
  const Vector q = perpendicular_part(to_point.offset, e, e_squared);
  const Real height = v.norm();
  const Vector across = quotient(v, height);

  const Real part =
      select(tau > alpha, alpha, Real(one - alpha)) / select(tau > alpha, tau, Real(one - tau));
  const Real end = select(tau == alpha, one, part);
  const Real step = clamped(q.dot(across), zero, Real(end * height));
  const Real share = step / height;
  const Real beta = select(share > end, end, share);
  const Real weight_j = clamped(Real(alpha - beta * tau), zero, Real(one - beta));
  const Real weight_i = one - beta - weight_j;

  const auto is_far = q.squaredNorm() > Real(4.0) * height * height;
  const Vector separation = choose(is_far, Vector(step * across - q), e.cross(across));
  const Real length = separation.norm();
  const Vector unit = quotient(separation, length);
  const Real above = unit.dot(q);
  const Real side_of_point = select(is_far, Real(-1.0), above);
  const Real sign = select(side_of_point > zero, Real(-1.0), one);
  const Real distance = select(is_far, length, larger_of(above, Real(-above)));
  const Real is_right = smallest_of(height, length, distance, Real(range - distance));
  return {{select(first, weight_i, select(second, beta, weight_j)),
           select(first, weight_j, select(second, weight_i, beta)),
           select(first, beta, select(second, weight_j, weight_i))},
          sign * unit,
          distance,
          smaller_of(is_inside_alone(point, x, range, may_be_near), is_right)};
}

}  // namespace plekton::geometry
