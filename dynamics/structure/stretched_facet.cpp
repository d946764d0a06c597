// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/stretched_facet.hpp"

#include <cmath>
#include <limits>

namespace plekton::dynamics {
namespace {

/// l_1 and l_2 by Newton's method from r = 1.
std::optional<std::array<double, 2>> principal_stretches(double a, double b, double nu) {
  double r = 1.0;
  constexpr int kMost = 50;
  for (int round = 0; round < kMost; ++round) {
    const double c = nu * (a - b);
    const double value = (((b * r + 1.0) * r - c) * r - 1.0) * r - a;
    const double slope = ((4.0 * b * r + 3.0) * r - 2.0 * c) * r - 1.0;
    const double step = value / slope;
    r -= step;
    if (!(r > 0.0)) break;
    if (std::abs(step) > 4.0 * std::numeric_limits<double>::epsilon() * r) continue;
    const double square_1 = 1.0 + a / r - nu * b * r, square_2 = 1.0 + b * r - nu * a / r;
    if (!(square_1 > 0.0 && square_2 > 0.0)) break;
    return {{std::sqrt(square_1), std::sqrt(square_2)}};
  }
  return std::nullopt;
}

/// Gives a facet its corners at rest, with the first side along the first axis again.
void set_corners(const Eigen::Matrix2d& shrink, SheetFacet& facet) {
  std::array<Vec2, 3> corners = facet.corners;
  for (Vec2& corner : corners) corner = shrink * corner;
  const double length = corners[1].norm();
  const double cosine = corners[1].x() / length, sine = corners[1].y() / length;
  const auto turned_back = [&](const Vec2& x) {
    return Vec2(cosine * x.x() + sine * x.y(), cosine * x.y() - sine * x.x());
  };
  facet.corners = {Vec2::Zero(), Vec2(length, 0.0), turned_back(corners[2])};
  // Half the angle; its cosine is above 0, since shrink is positive definite.
  const double half = std::sqrt(0.5 * (1.0 + cosine));
  const Quat turn(half, 0.0, 0.0, 0.5 * sine / half);
  for (Quat& rest : facet.rest) rest = (rest * turn).normalized();
}

}  // namespace

std::array<double, 2> principal_values(const Eigen::Matrix2d& force) noexcept {
  const double mean = 0.5 * force.trace();
  const double half = 0.5 * (force(0, 0) - force(1, 1));
  const double difference = std::sqrt(half * half + force(0, 1) * force(0, 1));
  return {mean + difference, mean - difference};
}

std::optional<StretchedFacet> stretched_facet(const SheetFacet& at_rest,
                                              const Eigen::Matrix2d& force) noexcept {
  const auto [n1, n2] = principal_values(force);
  const double half_stiffness = 0.5 * at_rest.section.tensile_stiffness;
  const auto stretches =
      principal_stretches(n1 / half_stiffness, n2 / half_stiffness, at_rest.section.poisson_ratio);
  if (!stretches) return std::nullopt;
  const auto [l1, l2] = *stretches;
  // U^-1 has the axes of the force, so it is linear in the force between the two.
  const Eigen::Matrix2d identity = Eigen::Matrix2d::Identity();
  const double slope = n1 > n2 ? (1.0 / l1 - 1.0 / l2) / (n1 - n2) : 0.0;
  StretchedFacet result{at_rest, *stretches};
  set_corners(0.5 * (1.0 / l1 + 1.0 / l2) * identity + slope * (force - 0.5 * (n1 + n2) * identity),
              result.facet);
  return result;
}

}  // namespace plekton::dynamics
