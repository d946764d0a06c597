// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/ball_volume.hpp"

#include "geometry/base/elementary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace plekton::geometry {
namespace {

constexpr double kPi = std::numbers::pi;

double square(double x) noexcept {
  return x * x;
}

/// sqrt(1 - a² - b²), of the height of the unit sphere over a point.
double height_over(double a, double b) noexcept {
  return std::sqrt(std::max(0.0, 1.0 - a * a - b * b));
}

// Of the unit ball, with planes x = a, y = b, z = c at right angles: what is beyond all of them.
// For a, b, c >= 0 that is bounded by flat faces and by a piece of the sphere whose sides are arcs
// of circles. With the origin as centre, the divergence theorem gives
//     3 V = S - a A_a - b A_b - c A_c
// with the area S of the piece and A of the faces, and Gauss and Bonnet
//     S = 2 pi - sum a dtheta_a - sum phi
// since a circle in the plane x = a has geodesic curvature times length a dtheta, dtheta its angle
// in that plane, and sides meet under the outer angle phi, cos phi = -a b / sqrt((1-a²)(1-b²)).
// Planes beneath the centre follow from what is on their other side.

double beyond_one(double a) noexcept {
  const double h = 1.0 - std::clamp(a, -1.0, 1.0);
  return kPi / 3.0 * h * h * (3.0 - h);
}

double beyond_two(double a, double b) noexcept {
  if (a < 0.0) return beyond_one(b) - beyond_two(-a, b);
  if (b < 0.0) return beyond_one(a) - beyond_two(a, -b);
  if (a * a + b * b >= 1.0) return 0.0;
  const double w = height_over(a, b);
  const double half_a = elementary::atan2(w, b);  // of the angle of the arc in x = a
  const double half_b = elementary::atan2(w, a);
  const double piece = 2.0 * (kPi - a * half_a - b * half_b - elementary::atan2(w, -a * b));
  const double face_a = (1.0 - a * a) * half_a - b * w;
  const double face_b = (1.0 - b * b) * half_b - a * w;
  return (piece - a * face_a - b * face_b) / 3.0;
}

/// An arc in the plane x = a, beyond y = b and z = c, and the face that it bounds.
struct Face {
  double angle;
  double area;
};

Face face_of(double a, double b, double c) noexcept {
  const double w_b = height_over(a, b);
  const double w_c = height_over(a, c);
  const double angle = elementary::atan2(w_b, b) - elementary::atan2(c, w_c);
  return {angle, 0.5 * ((1.0 - a * a) * angle - b * (w_b - c) - c * (w_c - b))};
}

double beyond_three(double a, double b, double c) noexcept {
  if (a < 0.0) return beyond_two(b, c) - beyond_three(-a, b, c);
  if (b < 0.0) return beyond_two(a, c) - beyond_three(a, -b, c);
  if (c < 0.0) return beyond_two(a, b) - beyond_three(a, b, -c);
  if (a * a + b * b + c * c >= 1.0) return 0.0;
  const Face at_a = face_of(a, b, c);
  const Face at_b = face_of(b, c, a);
  const Face at_c = face_of(c, a, b);
  const auto outer_angle = [](double u, double v) {
    return elementary::atan2(height_over(u, v), -u * v);
  };
  const double piece = 2.0 * kPi - a * at_a.angle - b * at_b.angle - c * at_c.angle -
                       outer_angle(a, b) - outer_angle(b, c) - outer_angle(c, a);
  return (piece - a * at_a.area - b * at_b.area - c * at_c.area) / 3.0;
}

/// Area (m²) that two circles have in common.
double lens_area(double a, double b, double distance) noexcept {
  if (distance >= a + b) return 0.0;
  const double smaller = std::min(a, b);
  if (distance <= std::abs(a - b)) return kPi * square(smaller);
  // Twice the area of the triangle of centres and a point where the circles cross (Heron).
  const double product =
      (a + b - distance) * (distance + a - b) * (distance - a + b) * (a + b + distance);
  const double h = std::sqrt(std::max(0.0, product)) / (2.0 * distance);
  const double x = (square(distance) + (a - b) * (a + b)) / (2.0 * distance);
  return square(a) * elementary::atan2(h, x) + square(b) * elementary::atan2(h, distance - x) -
         distance * h;
}

/// Positive nodes in (-1, 1) and weights of Gauss and Legendre with 20 points.
constexpr std::array<std::array<double, 2>, 10> kGauss = {{
    {0.076526521133497338, 0.15275338713072598},
    {0.22778585114164507, 0.14917298647260377},
    {0.37370608871541955, 0.14209610931838215},
    {0.51086700195082713, 0.1316886384491765},
    {0.63605368072651502, 0.11819453196151831},
    {0.7463319064601508, 0.10193011981724048},
    {0.83911697182221889, 0.083276741576704741},
    {0.91223442825132595, 0.06267204833410904},
    {0.96397192727791381, 0.04060142980038705},
    {0.99312859918509488, 0.017614007139152264},
}};

/// Integral of a function whose ends may have kinks as of a power 3/2: t = u² (3 - 2u) makes them
/// smooth.
template <class Function>
double integral(double low, double high, Function function) {
  double sum = 0.0;
  for (const auto& [node, weight] : kGauss) {
    for (const double u : {0.5 * (1.0 - node), 0.5 * (1.0 + node)}) {
      const double t = low + (high - low) * u * u * (3.0 - 2.0 * u);
      sum += weight * 6.0 * u * (1.0 - u) * function(t);
    }
  }
  return 0.5 * (high - low) * sum;
}

}  // namespace

double ball_volume(double radius) noexcept {
  return 4.0 / 3.0 * kPi * radius * radius * radius;
}

double cap_volume(double radius, double height) noexcept {
  const double h = radius - std::clamp(height, -radius, radius);
  return kPi / 3.0 * h * h * (3.0 * radius - h);
}

double lens_volume(double radius_a, double radius_b, double distance) noexcept {
  if (distance >= radius_a + radius_b) return 0.0;
  if (distance <= std::abs(radius_a - radius_b)) return ball_volume(std::min(radius_a, radius_b));
  // From the centre of a to the plane of the circle in which the spheres meet.
  const double x = 0.5 * (distance + (radius_a - radius_b) * ((radius_a + radius_b) / distance));
  return cap_volume(radius_a, x) + cap_volume(radius_b, distance - x);
}

double ball_volume_in_box(const Vec3& centre, double radius, const Box& box) noexcept {
  const Vec3 low = box.lower - centre;
  const Vec3 high = box.upper - centre;
  if (low.maxCoeff() <= -radius && high.minCoeff() >= radius) return ball_volume(radius);
  if (low.maxCoeff() >= radius || high.minCoeff() <= -radius) return 0.0;
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 from;
    double sign = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const bool is_upper = ((corner >> axis) & 1) != 0;
      from[axis] = (is_upper ? high[axis] : low[axis]) / radius;
      if (is_upper) sign = -sign;
    }
    sum += sign * beyond_three(from[0], from[1], from[2]);
  }
  return std::max(0.0, sum * radius * radius * radius);
}

double ball_volume_in_cylinder(const Vec3& centre, double radius,
                               const CylinderRegion& cylinder) noexcept {
  const Vec3 along = cylinder.to - cylinder.from;
  const double length = along.norm();
  const Vec3 axis = along / length;
  const Vec3 to_centre = centre - cylinder.from;
  const double height = axis.dot(to_centre);
  const double distance = (to_centre - height * axis).norm();
  const double low = std::max(-radius, -height);
  const double high = std::min(radius, length - height);
  if (low >= high || distance >= cylinder.radius + radius) return 0.0;
  if (distance + radius <= cylinder.radius)
    return cap_volume(radius, low) - cap_volume(radius, high);
  // Where one circle begins to hold the other, or to meet it; in the middle it nearly may.
  std::array<double, 7> ends{low, std::clamp(0.0, low, high), high, high, high, high, high};
  std::size_t next = 3;
  for (const double across : {cylinder.radius - distance, cylinder.radius + distance}) {
    const double half = std::sqrt(std::max(0.0, square(radius) - square(across)));
    for (const double t : {-half, half}) ends[next++] = std::clamp(t, low, high);
  }
  std::sort(ends.begin(), ends.end());
  double volume = 0.0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    if (!(ends[i] < ends[i + 1])) continue;
    volume += integral(ends[i], ends[i + 1], [&](double t) {
      return lens_area(std::sqrt(std::max(0.0, square(radius) - square(t))), cylinder.radius,
                       distance);
    });
  }
  return volume;
}

}  // namespace plekton::geometry
