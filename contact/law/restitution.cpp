// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law/restitution.hpp"

#include <cmath>

namespace plekton::contact {
namespace {

/// Overlap and its rate; in units in which the mass and the speed of impact are 1.
struct Impact {
  double overlap;
  double rate;
};

/// Force of the spring, d^n with n = 1 or 3/2, and its stiffness.
double spring_force(SpringKind kind, double d) {
  return kind == SpringKind::linear ? d : d * std::sqrt(d);
}
double stiffness(SpringKind kind, double d) {
  return kind == SpringKind::linear ? 1.0 : 1.5 * std::sqrt(d);
}

double force(SpringKind kind, double damping_ratio, const Impact& now) {
  const double d = now.overlap > 0.0 ? now.overlap : 0.0;
  return spring_force(kind, d) + 2.0 * damping_ratio * std::sqrt(stiffness(kind, d)) * now.rate;
}

/// Runge and Kutta's fourth-order rule. Hairer, Norsett & Wanner, Solving ODEs I (1993), II.1.
Impact step(SpringKind kind, double damping_ratio, const Impact& now, double dt) {
  const auto rate = [&](const Impact& at) {
    return Impact{at.rate, -force(kind, damping_ratio, at)};
  };
  const auto moved = [](const Impact& from, const Impact& by, double share) {
    return Impact{from.overlap + share * by.overlap, from.rate + share * by.rate};
  };
  const Impact k1 = rate(now);
  const Impact k2 = rate(moved(now, k1, 0.5 * dt));
  const Impact k3 = rate(moved(now, k2, 0.5 * dt));
  const Impact k4 = rate(moved(now, k3, dt));
  const auto mean = [&](double a, double b, double c, double d) {
    return dt / 6.0 * (a + 2.0 * (b + c) + d);
  };
  return {now.overlap + mean(k1.overlap, k2.overlap, k3.overlap, k4.overlap),
          now.rate + mean(k1.rate, k2.rate, k3.rate, k4.rate)};
}

}  // namespace

double restitution(SpringKind kind, double damping_ratio) {
  const double dt = 2e-3 / (1.0 + damping_ratio);
  Impact now{0.0, 1.0};
  for (;;) {
    const Impact next = step(kind, damping_ratio, now, dt);
    // It ends on the way out, where the force would pull; the rate has no slope there.
    if (next.rate < 0.0 && !(force(kind, damping_ratio, next) > 0.0)) return -next.rate;
    now = next;
  }
}

double damping_ratio(SpringKind kind, double wanted) {
  if (wanted >= 1.0) return 0.0;
  double low = 0.0, high = 1.0;
  while (high < 1e3 && restitution(kind, high) > wanted) high *= 2.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (restitution(kind, middle) > wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace plekton::contact
