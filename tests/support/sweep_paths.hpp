// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/contact_probe.hpp"

#include <cmath>
#include <numbers>

/// Surfaces over which a ball is dragged with a constant overlap, and the paths of its centre. All
/// sweeps of the acceptance checks share these parameters.
namespace plekton::test::dragged {

constexpr double kSphereRadius = 0.1;                                    // m
constexpr double kSurfaceRadius = 0.02;                                  // m
constexpr double kOverlap = 0.002;                                       // m
constexpr double kDistance = kSphereRadius + kSurfaceRadius - kOverlap;  // m, between the cores
constexpr double kYoungModulus = 1e6;                                    // Pa
constexpr double kStiffnessRatio = 0.3;
// Springs E R of both bodies in series: 100000/3 N/m, so the normal force is 200/3 N.
constexpr double kNormalStiffness =
    2.0 * kYoungModulus * kSphereRadius * kSurfaceRadius / (kSphereRadius + kSurfaceRadius);
constexpr double kTangentialStiffness = kStiffnessRatio * kNormalStiffness;
constexpr double kNormalForce = kNormalStiffness * kOverlap;

constexpr double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

inline Material material(double friction_angle_in_degrees) {
  return {kYoungModulus, kStiffnessRatio, std::tan(radians(friction_angle_in_degrees))};
}
/// Limits the tangential force to 573 times the normal force: no sweep gets there.
inline Material no_slip() {
  return material(89.9);
}
inline Material frictionless() {
  return material(0.0);
}

/// Sheet of two flat halves that meet along y at x = 0, z = -|x| tan(angle): a ridge for an angle
/// > 0, a valley for < 0. Rows of nodes at uneven y, diagonals cut in turns.
inline ProbedSurface folded_strip(double angle) {
  ProbedSurface strip;
  strip.radius = kSurfaceRadius;
  constexpr std::array<double, 5> kX{-1.0, -0.5, 0.0, 0.5, 1.0};
  constexpr std::array<double, 3> kY{-0.6, 0.05, 0.7};
  for (const double x : kX) {
    for (const double y : kY) strip.nodes.push_back(Vec3(x, y, -std::abs(x) * std::tan(angle)));
  }
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 2; ++j) {
      const int a = 3 * i + j;
      const int b = a + 3;
      const int c = b + 1;
      const int d = a + 1;
      if ((i + j) % 2 == 0) {
        strip.facets.insert(strip.facets.end(), {{a, b, c}, {a, c, d}});
      } else {
        strip.facets.insert(strip.facets.end(), {{a, b, d}, {b, c, d}});
      }
    }
  }
  return strip;
}

/// Chain of cylinders through these points.
inline ProbedSurface chain_of_cylinders(std::vector<Vec3> points) {
  ProbedSurface chain{std::move(points), {}, {}, kSurfaceRadius};
  for (int i = 1; i < static_cast<int>(chain.nodes.size()); ++i) {
    chain.cylinders.push_back({i - 1, i});
  }
  return chain;
}

/// Straight path of this number of steps.
inline std::vector<Vec3> line(const Vec3& from, const Vec3& to, int steps) {
  std::vector<Vec3> path;
  for (int k = 0; k <= steps; ++k) path.push_back(from + (to - from) * k / steps);
  return path;
}

/// A place on the way over a ridge: where the centre is, and which way the ridge pushes it.
struct RidgePoint {
  Vec3 centre;
  Vec3 normal;  ///< unit, away from the surface
};

/// Centre at the constant distance from the surface z = -|x| tan(angle): up one side from a foot
/// point at this length from the ridge, around it on an arc, and down the other. Equal steps.
inline std::vector<RidgePoint> over_ridge(double angle, double side, int steps) {
  const double arc = 2.0 * angle * kDistance;
  std::vector<RidgePoint> path;
  for (int k = 0; k <= steps; ++k) {
    const double way = (2.0 * side + arc) * k / steps - side;  // 0 where the arc begins
    const double turn = std::min(std::max(way / kDistance, 0.0), 2.0 * angle) - angle;
    const double along = std::min(way, 0.0) + std::max(way - arc, 0.0);
    const Vec3 normal(std::sin(turn), 0.0, std::cos(turn));
    const Vec3 tangent(std::cos(turn), 0.0, -std::sin(turn));
    path.push_back({along * tangent + kDistance * normal, normal});
  }
  return path;
}

inline std::vector<Vec3> centres(std::span<const RidgePoint> path) {
  std::vector<Vec3> result;
  for (const RidgePoint& point : path) result.push_back(point.centre);
  return result;
}

}  // namespace plekton::test::dragged
