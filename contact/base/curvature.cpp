// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/base/curvature.hpp"

#include "geometry/base/elementary.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace plekton::contact {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

/// Complete elliptic integrals of the modulus e, e² = 1 - q².
struct EllipticIntegrals {
  double first;       ///< K
  double difference;  ///< D = (K - E) / e²
};

/// By the arithmetic-geometric mean: K = pi / (2 M), K - E = K sum 2^(n-1) c_n² with c_0 = e and
/// c_(n+1) = c_n² / (4 a_(n+1)). Abramowitz & Stegun, 17.6. The sum is taken over e², so that
/// nothing cancels as the ellipse becomes a circle.
/// @param q  in (0, 1]
EllipticIntegrals elliptic_integrals(double q) noexcept {
  double mean = 1.0;
  double geometric = q;
  double c_squared = (1.0 - q) * (1.0 + q);
  double part = 1.0;  // c_n² / e²
  double weight = 0.5;
  double sum = 0.5;
  // It converges with the square; the bound is for radii that are no numbers.
  for (int n = 0; n < 64 && weight * part > kEps * sum; ++n) {
    const double next = 0.5 * (mean + geometric);
    geometric = std::sqrt(mean * geometric);
    mean = next;
    const double factor = c_squared / (16.0 * mean * mean);
    part *= factor;
    c_squared *= factor;
    weight *= 2.0;
    sum += weight * part;
  }
  const double first = std::numbers::pi / (2.0 * mean);
  return {first, first * sum};
}

/// b/a of the ellipse: R'/R'' = (K - D) / (q² D), which is Johnson (4.28) without what cancels.
/// @param ratio  R'/R'' > 1
double axis_ratio(double ratio) noexcept {
  const double log_ratio = elementary::log(ratio);
  const auto error = [&](double log_q) {
    const auto [first, difference] = elliptic_integrals(elementary::exp(log_q));
    return 2.0 * log_q + log_ratio - elementary::log(first / difference - 1.0);
  };
  // About (R''/R')^(2/3); the slope of the error is between 1.5, for a circle, and 2.
  double log_q = -2.0 / 3.0 * log_ratio;
  double before = error(log_q);
  double step = -before / 1.75;
  for (int n = 0; n < 32 && std::abs(step) > kEps * (1.0 - log_q); ++n) {
    log_q = std::min(0.0, log_q + step);
    const double now = error(log_q);
    if (now == before) break;
    step *= now / (before - now);
    before = now;
  }
  return elementary::exp(log_q);
}

double reduced(double a, double b) noexcept {
  return a * b / (a + b);
}

}  // namespace

RelativeRadii relative_radii(const Body& a, const Body& b) noexcept {
  const bool a_is_flat = a.shape == Shape::flat;
  const bool b_is_flat = b.shape == Shape::flat;
  if (a_is_flat != b_is_flat) {
    const double round = a_is_flat ? b.radius : a.radius;
    return {round, round};
  }
  const bool a_is_sphere = a.shape == Shape::sphere;
  const bool b_is_sphere = b.shape == Shape::sphere;
  const double both = reduced(a.radius, b.radius);
  if (a_is_sphere && b_is_sphere) return {both, both};
  if (a_is_sphere || b_is_sphere) return {a_is_sphere ? a.radius : b.radius, both};
  return {std::max(a.radius, b.radius), std::min(a.radius, b.radius)};
}

// P and the approach d by the axes of the ellipse, Johnson (4.24) to (4.26):
//   1/(2 R') = 3 P / (2 pi E*) D / a³,   d = 3 P / (2 pi E*) K / a;
// without a, P² = 16/9 E*² R d³.
double hertz_radius(const RelativeRadii& radii) noexcept {
  if (!(radii.larger > radii.smaller)) return radii.smaller;
  const auto [first, difference] = elliptic_integrals(axis_ratio(radii.larger / radii.smaller));
  constexpr double kPi = std::numbers::pi;
  return 0.5 * kPi * kPi * radii.larger * difference / (first * first * first);
}

}  // namespace plekton::contact
