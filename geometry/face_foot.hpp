// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/pack.hpp"

#include <array>

/// The foot of a point inside a triangle, for some points and triangles side by side.
namespace plekton::geometry {

/// Foot of the perpendicular from a point on a triangle.
template <class Real>
struct FaceFootOf {
  PackVec3<Real> weights;    ///< of the corners, sum 1
  PackVec3<Real> direction;  ///< unit, from the point to the foot
  Real distance;             ///< m
  /// 1 where the exact signs certainly say that the foot is inside, nearer than the range, and
  /// that neither a side nor a corner is; else 0, and nothing is known.
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

/// 1 where the line along u through a point at w from it is surely farther than a range; as in
/// critical_features.cpp.
template <class Real>
PLEKTON_INLINE Real line_is_beyond(const PackVec3<Real>& w, const PackVec3<Real>& u,
                                   const Real& range_squared) noexcept {
  const Real along = w.dot(u);
  const Real w_squared = w.squaredNorm();
  const Real u_squared = u.squaredNorm();
  return flag((w_squared - range_squared) * u_squared >
              along * along + Real(1e-12) * w_squared * u_squared);
}

/// is_alone, but for the distance. The signs are certain for the reasons given at FaceView
/// (cell_clearance.hpp), whose quick test against the range has to fail too. A corner is no nearer
/// than the line of a side through it.
template <class Real>
PLEKTON_INLINE Real is_inside_alone(const PackVec3<Real>& point,
                                    const std::array<PackVec3<Real>, 3>& x,
                                    const Real& range) noexcept {
  const PackVec3<Real> u = x[1] - x[0];
  const PackVec3<Real> v = x[2] - x[0];
  const PackVec3<Real> w = point - x[0];
  const PackVec3<Real> normal = u.cross(v);
  const PackVec3<Real> turned = normal.cross(w);
  const Real normal_squared = normal.squaredNorm();
  const Real side_0 = -u.dot(turned);
  const Real side_2 = v.dot(turned);
  const Real side_1 = normal_squared - side_0 - side_2;
  const Real length_squared = larger_of(u.squaredNorm(), v.squaredNorm());
  const Real reach_squared = larger_of(w.squaredNorm(), length_squared);
  const Real error = Real(2e-13) * length_squared * reach_squared;
  const Real is_usual = flag(length_squared > Real(1e-70)) * flag(Real(1e70) > reach_squared);
  const Real is_inside = flag(smaller_of(side_0, smaller_of(side_1, side_2)) > error);
  const Real height = normal.dot(w);
  const Real is_near = flag(range * range * normal_squared >= height * height);
  const Real range_squared = range * range * Real(1.0 + 1e-12);
  return is_usual * is_inside * is_near * line_is_beyond(w, u, range_squared) *
         line_is_beyond(w, v, range_squared) *
         line_is_beyond(PackVec3<Real>(point - x[1]), PackVec3<Real>(x[2] - x[1]), range_squared);
}

}  // namespace detail

/// Where is_alone, this is foot_on_face() (foot_point.hpp) to the last bit, line by line.
/// @param range  m, > 0
template <class Real>
PLEKTON_INLINE FaceFootOf<Real> face_foot(const PackVec3<Real>& point,
                                          const std::array<PackVec3<Real>, 3>& x,
                                          const Real& range) noexcept {
  using Vector = PackVec3<Real>;
  using namespace detail;
  // The longest side leads from corner i to corner j.
  const Real s0 = Vector(x[1] - x[0]).squaredNorm();
  const Real s1 = Vector(x[2] - x[1]).squaredNorm();
  const Real s2 = Vector(x[0] - x[2]).squaredNorm();
  const auto first = select(s0 >= s1, flag(s0 >= s2), Real(0.0)) > Real(0.0);
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
  const Real sign = select(is_far, one, select(above > zero, Real(-1.0), one));
  const Real distance = select(is_far, length, select(above > zero, above, Real(-above)));
  const Real is_right =
      flag(height > zero) * flag(length > zero) * flag(distance > zero) * flag(range > distance);
  return {{select(first, weight_i, select(second, beta, weight_j)),
           select(first, weight_j, select(second, weight_i, beta)),
           select(first, beta, select(second, weight_j, weight_i))},
          sign * unit,
          distance,
          is_right * is_inside_alone(point, x, range)};
}

}  // namespace plekton::geometry
