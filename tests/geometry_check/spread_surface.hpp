// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/contact_surfaces.hpp"

#include <cmath>
#include <numbers>

namespace plekton::geometry_check {

/// A ball of range 1 m about the origin on a surface that spreads around it.
struct SpreadTouch {
  test::Complex complex;
  geometry::Vec3 centre;  ///< m
  static constexpr double kRange = 1.0;
};

/// A wire, some part of a hoop around the ball.
inline test::Complex any_hoop(test::Random& random) {
  test::Complex hoop;
  const int bars = random.integer(2, 30);
  const double angle = random.uniform(0.1, 0.9) * 2.0 * std::numbers::pi / bars;
  for (int i = 0; i <= bars; ++i) {
    const double at = angle * (i - 0.5 * bars);
    hoop.node({std::sin(at), 0.0, -std::cos(at)});
    if (i > 0) hoop.cylinder(i - 1, i);
  }
  return hoop;
}

/// A square or a triangulated patch of n x n cells, as wide, that a map bends.
template <class Map>
test::Complex bent(test::Complex patch, int n, double width, Map map) {
  for (geometry::Vec3& x : patch.x) {
    const double a = (x.x() / n - 0.5) * width;
    const double b = (x.y() / n - 0.5) * width;
    x = map(a, b);
  }
  return patch;
}

/// Wrapped around the lower part of the ball.
inline geometry::Vec3 wrapped(double a, double b) {
  return geometry::Vec3(std::tan(a), std::tan(b), -1.0).normalized();
}

/// A net or a sheet: wrapped, flat, rough, folded in a valley or on a ridge, or with a hole.
inline test::Complex any_spread_surface(test::Random& random) {
  const int n = random.integer(1, 9);
  const bool is_net = random.coin();
  const test::Complex flat = is_net ? test::net(n) : test::sheet(std::min(n, 5));
  const int cells = is_net ? n : std::min(n, 5);
  const double width = random.uniform(0.1, 2.2);
  switch (random.integer(0, 5)) {
    case 0:
      return any_hoop(random);
    case 1:
      return bent(flat, cells, std::min(width, 1.6), wrapped);
    case 2:
      return bent(flat, cells, width,
                  [](double a, double b) { return geometry::Vec3(a, b, -1.0); });
    case 3: {
      const double slope = random.signed_power(-6.0, 0.0);
      return bent(flat, cells, width, [slope](double a, double b) {
        return geometry::Vec3(a, b, -1.0 + slope * std::abs(a));
      });
    }
    case 4: {
      const double rim = random.uniform(0.05, 0.8);
      test::Complex plate = test::plate_with_hole(random.integer(3, 12), rim, rim + width);
      for (geometry::Vec3& x : plate.x) x.z() -= 1.0;
      return plate;
    }
    default: {
      const double curvature = random.uniform(-1.0, 1.0);
      return bent(flat, cells, width, [curvature](double a, double b) {
        return geometry::Vec3(a, b, -1.0 + 0.5 * curvature * (a * a + b * b));
      });
    }
  }
}

/// Nodes are moved by up to a hundredth of the range, or not at all; the ball is anywhere beside
/// the middle, or right over it, and mostly 1e-3 to 0.2 deep.
inline SpreadTouch any_spread_touch(test::Random& random) {
  SpreadTouch touch{any_spread_surface(random), geometry::Vec3::Zero()};
  if (random.integer(0, 3) != 0) {
    const double rough = random.signed_power(-7.0, -2.0);
    for (geometry::Vec3& x : touch.complex.x) x += rough * random.in_cube(1.0);
  }
  if (random.integer(0, 3) != 0) touch.centre = 0.1 * random.in_cube(1.0);
  const geometry::Surface surface = touch.complex.surface();
  geometry::CriticalFeatureFinder finder(surface);
  double nearest = 10.0;
  geometry::Vec3 towards(0.0, 0.0, -1.0);
  for (const auto& feature :
       finder.find(touch.centre, 10.0, test::all_cells(surface), touch.complex.x)) {
    if (!(feature.distance < nearest)) continue;
    nearest = feature.distance;
    towards = feature.direction;
  }
  const double depth = std::pow(10.0, random.uniform(-3.0, -0.7));
  touch.centre += (nearest - (SpreadTouch::kRange - depth)) * towards;
  return touch;
}

}  // namespace plekton::geometry_check
