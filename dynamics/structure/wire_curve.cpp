// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/wire_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <ostream>
#include <stdexcept>

namespace plekton::dynamics {
namespace {

/// Slopes of points that were rounded may differ by this much where they are meant to be equal.
constexpr double kSlopeRounding = 8.0 * std::numeric_limits<double>::epsilon();

/// @returns whether the point follows the one before
bool list_order(const WireCurve::Point& before, const WireCurve::Point& point,
                const std::string& where, std::ostream& problems) {
  if (!std::isfinite(point.strain) || !std::isfinite(point.force)) {
    problems << where << ": strain " << point.strain << " and force " << point.force
             << " N must be finite\n";
    return false;
  }
  if (point.force < 0.0) {
    problems << where << ": the force is " << point.force
             << " N; a wire does not push, so it must be zero or positive\n";
  }
  if (point.strain > before.strain) return true;
  problems << where << ": the strain is " << point.strain << " after " << before.strain
           << "; strains must rise from point to point, from 0\n";
  return false;
}

}  // namespace

double WireCurve::force_at(double strain) const noexcept {
  const auto next = std::find_if(points.begin(), points.end(),
                                 [&](const Point& point) { return strain < point.strain; });
  if (next == points.begin()) return first_slope() * strain;
  if (next == points.end()) return points.back().force;
  const Point& before = *std::prev(next);
  const double part = (strain - before.strain) / (next->strain - before.strain);
  return before.force + part * (next->force - before.force);
}

std::optional<double> WireCurve::strain_at(double force) const noexcept {
  Point before{0.0, 0.0};
  for (const Point& point : points) {
    if (point.force >= force)
      return before.strain +
             (point.strain - before.strain) * (force - before.force) / (point.force - before.force);
    before = point;
  }
  return std::nullopt;
}

BeamSection wire_section(double radius, const WireCurve& curve) {
  if (curve.points.empty())
    throw std::invalid_argument(
        "wire_section: the curve has no points; give at least one, at which the wire breaks");
  const double area = std::numbers::pi * radius * radius;
  return bar_section(radius, curve.first_slope() / area);
}

void list_problems(const WireCurve& curve, std::string_view name, std::ostream& problems) {
  if (curve.points.empty()) {
    problems << name << ": has no points; give at least one, at which the wire breaks\n";
    return;
  }
  WireCurve::Point before{0.0, 0.0};
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const WireCurve::Point& point = curve.points[i];
    const std::string where = std::string(name) + ", point " + std::to_string(i + 1);
    if (!list_order(before, point, where, problems)) return;
    if (i == 0 && point.force == 0.0) {
      problems << where << ": the first force must be positive; it says how stiff the wire is\n";
      return;
    }
    const double slope = (point.force - before.force) / (point.strain - before.strain);
    if (slope > curve.first_slope() * (1.0 + kSlopeRounding)) {
      problems << where << ": the piece before it is steeper (" << slope
               << " N for each unit of strain) than the first (" << curve.first_slope()
               << "), along which the wire unloads: it would give back more work than it took; "
                  "make the first piece the steepest\n";
    }
    before = point;
  }
}

}  // namespace plekton::dynamics
