// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/first_contact.hpp"

#include "geometry/base/problems.hpp"
#include "geometry/query/number_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

namespace plekton::geometry {
namespace {

constexpr double kUlp = std::numeric_limits<double>::epsilon();
constexpr int kMostSteps = 10000;

void check(const char* which, const MovingProbe& probe, std::ostream& problems) {
  if (probe.from.count != probe.to.count) {
    problems << which << " has " << probe.from.count << " corners at the start of the step and "
             << probe.to.count << " at the end; expected as many\n";
  }
  const std::string name = which;
  list_probe_problems({probe.from, probe.radius}, problems, name + " at the start of the step");
  list_probe_problems({probe.to, probe.radius}, problems, name + " at the end of the step");
}

Probe at(const MovingProbe& moving, double t) {
  Probe probe{{{}, moving.from.count}, moving.radius};
  for (std::size_t k = 0; k < moving.from.count; ++k)
    probe.core.x[k] = moving.from.x[k] + t * (moving.to.x[k] - moving.from.x[k]);
  return probe;
}

/// Both motions, seen from the first corner of a.
class Approach {
 public:
  Approach(const MovingProbe& a, const MovingProbe& b) : a_(a), b_(b) {
    double largest = 0.0, size = 0.0;
    const Vec3& from = a.from.x[0];
    for (const MovingProbe* probe : {&a, &b}) {
      for (const Core* core : {&probe->from, &probe->to}) {
        for (const Vec3& corner : core->corners()) {
          largest = std::max(largest, corner.cwiseAbs().maxCoeff());
          size = std::max(size, (corner - from).cwiseAbs().maxCoeff());
        }
      }
    }
    // Positions at t are within 2 ulps of the largest coordinate, supports within some of the size.
    rounding_ = 8.0 * kUlp * largest + 32.0 * kUlp * (size + a.radius + b.radius);
    least_tolerance_ = std::max(8.0 * rounding_, 1e-13 * size);
  }

  double least_tolerance() const { return least_tolerance_; }

  /// When a plane across a unit normal may first not separate both any more, not later than 2; it
  /// does at t. @returns t if that is not certain
  double separated_until(const Vec3& normal, const Probe& at_a, const Probe& at_b, double t) const {
    const Vec3& from = at_a.core.x[0];
    const double length = normal.norm();
    const double margin = lowest(normal, at_b.core, from) + lowest(-normal, at_a.core, from) -
                          (a_.radius + b_.radius) * length * (1.0 + 8.0 * kUlp) - rounding_;
    if (!(margin > 0.0)) return t;
    double fastest = -std::numeric_limits<double>::infinity(), slack = 0.0;
    for (std::size_t i = 0; i < a_.from.count; ++i) {
      for (std::size_t k = 0; k < b_.from.count; ++k) {
        const Vec3 way_a = a_.to.x[i] - a_.from.x[i], way_b = b_.to.x[k] - b_.from.x[k];
        fastest = std::max(fastest, normal.dot(way_a - way_b));
        slack = std::max(slack, way_a.cwiseAbs().sum() + way_b.cwiseAbs().sum());
      }
    }
    fastest += 16.0 * kUlp * slack;
    if (!(fastest > 0.0)) return 2.0;
    const double lasts = margin / fastest * (1.0 - 8.0 * kUlp);
    return std::min(2.0, std::nextafter(t + lasts, t));
  }

 private:
  /// m, the least product of a unit normal with the ways to the corners of a core.
  static double lowest(const Vec3& normal, const Core& core, const Vec3& from) {
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& corner : core.corners()) least = std::min(least, normal.dot(corner - from));
    return least;
  }

  const MovingProbe& a_;
  const MovingProbe& b_;
  double rounding_;  ///< m
  double least_tolerance_;
};

}  // namespace

MovingProbe MovingProbe::translated(const Probe& probe, const Vec3& way) {
  MovingProbe moving = resting(probe);
  const std::size_t count = std::min(probe.core.count, probe.core.x.size());  // checked later
  for (std::size_t k = 0; k < count; ++k) moving.to.x[k] += way;
  return moving;
}

std::optional<FirstContact> first_contact(const MovingProbe& a, const MovingProbe& b,
                                          ContactTolerance tolerance) {
  std::ostringstream problems;
  check("a", a, problems);
  check("b", b, problems);
  if (!(tolerance.length >= 0.0 && std::isfinite(tolerance.length)))
    problems << "the tolerance is " << tolerance.length << " m; it must be 0 or more, and finite\n";
  throw_if_any(problems);

  const Approach approach(a, b);
  const double enough = std::max(tolerance.length, approach.least_tolerance());
  double t = 0.0;
  for (int step = 0;; ++step) {
    const Probe at_a = at(a, t), at_b = at(b, t);
    const Proximity near = proximity(at_a, at_b);
    if (near.gap <= enough || step == kMostSteps) return FirstContact{t, near};
    const double until = approach.separated_until(near.normal, at_a, at_b, t);
    if (until > 1.0) return std::nullopt;
    if (!(until > t)) return FirstContact{t, near};
    t = until;
  }
}

}  // namespace plekton::geometry
