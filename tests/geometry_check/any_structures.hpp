// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/closest/core_pair.hpp"
#include "tests/geometry_check/structure_scene.hpp"
#include "tests/support/hollow_ball.hpp"
#include "tests/support/seeded_random.hpp"

#include <limits>
#include <numbers>

namespace plekton::geometry_check {

/// Nearest points of two bodies: of their cells, one by one.
inline geometry::ClosestPoints nearest_points(const test::Body& a, const test::Body& b) {
  const auto cores = [](const test::Body& body) {
    std::vector<geometry::Core> found;
    const auto at = [&](int node) { return body.x[static_cast<std::size_t>(node)]; };
    for (const auto& f : body.facets) found.push_back({{at(f[0]), at(f[1]), at(f[2])}, 3});
    for (const auto& c : body.cylinders)
      found.push_back({{at(c[0]), at(c[1]), geometry::Vec3::Zero()}, 2});
    return found;
  };
  geometry::ClosestPoints nearest{};
  nearest.distance = std::numeric_limits<double>::infinity();
  const auto of_b = cores(b);
  for (const geometry::Core& core : cores(a)) {
    for (const geometry::Core& other : of_b) {
      const geometry::ClosestPoints points = geometry::closest_points(core, other);
      if (points.distance < nearest.distance) nearest = points;
    }
  }
  return nearest;
}

/// Moves b along the line of the nearest points until these overlap by a depth (m), but for what
/// others come nearer on the way.
inline void bring_near(const test::Body& a, test::Body& b, double depth) {
  for (int k = 0; k < 4; ++k) {
    const geometry::ClosestPoints points = nearest_points(a, b);
    if (!(points.distance > 0.0)) return;
    const double way = points.distance - (Structures::kRange - depth);
    for (geometry::Vec3& x : b.x) x -= way / points.distance * points.separation;
  }
}

/// 0, or 1e-12 to 1e-3 rad.
inline double small_turn(test::Random& random) {
  return random.integer(0, 3) == 0 ? 0.0 : random.signed_power(-12.0, -3.0);
}

inline test::Cut any_cut(test::Random& random) {
  return random.coin() ? test::Cut::one_way : test::Cut::alternating;
}

/// Nodes moved by up to a roughness (m).
inline test::Body roughened(test::Body body, double roughness, test::Random& random) {
  for (geometry::Vec3& x : body.x) x += roughness * random.in_cube(1.0);
  return body;
}

/// A net or a chain on another, at any angle or nearly in line.
inline Structures bars_on_bars(double depth, test::Random& random) {
  const auto any = [&]() -> test::Body {
    if (random.coin()) return test::chain(random.integer(1, 4), random.uniform(0.1, 0.8));
    return test::square_net_of(random.integer(1, 3), random.uniform(0.05, 0.25));
  };
  Structures pair{any(), any(), false, {}};
  const double turn = random.coin() ? small_turn(random) : random.uniform(0.0, 3.2);
  const double tilt = random.coin() ? small_turn(random) : random.uniform(-0.5, 0.5);
  pair.b = test::moved(pair.b, {tilt, 0.3 * tilt, turn}, {0.0, 0.0, 0.8});
  if (random.coin())
    for (geometry::Vec3& x : pair.b.x)
      x += geometry::Vec3(0.1 * random.unit(), 0.1 * random.unit(), 0.0);
  bring_near(pair.a, pair.b, depth);
  return pair;
}

/// A sheet on another with edges in common, equal ones too, so that rims lie on rims.
inline Structures sheet_on_sheet(double depth, test::Random& random) {
  const double spacing = random.uniform(0.05, 0.25);
  const int n = random.integer(1, 4), m = random.coin() ? n : random.integer(1, n);
  Structures pair{test::sheet(n, n, n * spacing, n * spacing, any_cut(random)),
                  test::sheet(m, m, m * spacing, m * spacing, any_cut(random)),
                  true,
                  {}};
  const double half = (n - m) % 2 == 0 ? 0.0 : 0.5 * spacing;  // node on node
  const double off = random.coin() ? 0.0 : random.signed_power(-12.0, -1.0);
  pair.b = test::moved(pair.b, {0.0, 0.0, small_turn(random)},
                       {half + off, half, Structures::kRange - depth});
  return pair;
}

/// A rough sheet on its own mirror image.
inline Structures sheet_on_mirror_image(double depth, test::Random& random) {
  const int n = random.integer(1, 4);
  const double side = n * random.uniform(0.05, 0.25);
  const test::Body rough =
      roughened(test::sheet(n, n, side, side, any_cut(random)),
                0.5 * depth * std::pow(10.0, random.uniform(-4.0, 0.0)), random);
  Structures pair{rough, rough, true, {}};
  for (geometry::Vec3& x : pair.b.x) x.z() = Structures::kRange - depth - x.z();
  pair.b = test::moved(pair.b, {0.0, 0.0, small_turn(random)}, geometry::Vec3::Zero());
  return pair;
}

/// A sheet folded onto its own mirror image, over a strip that stands up between both halves.
inline Structures folded(double depth, test::Random& random) {
  const int n = random.integer(2, 3);
  const double spacing = 1.01 * Structures::kRange;
  const double height = Structures::kRange - depth;
  Structures sheet{
      test::sheet(2 * n + 1, n, (2 * n + 1) * spacing, n * spacing, any_cut(random)), {}, true, {}};
  sheet.rest = sheet.a.x;
  const double rough = 0.5 * depth * std::pow(10.0, random.uniform(-4.0, 0.0));
  const double turn = small_turn(random);
  for (geometry::Vec3& x : sheet.a.x) {
    const double beside = std::abs(x.x()) - 0.5 * spacing;
    const bool is_above = x.x() > 0.0;
    x = {beside, x.y(), is_above ? height : 0.0};
    if (is_above) x.y() += turn * beside;
    if (beside > 0.1 * spacing) x.z() += rough * random.uniform(-1.0, 1.0);
  }
  return sheet;
}

/// A ridge on a ridge, the rim of a hole on a ball or on another rim, a sheet that stands on one.
inline Structures rim_on_rim(double depth, test::Random& random) {
  const auto any = [&]() -> test::Body {
    switch (random.integer(0, 3)) {
      case 0:
        return test::plate_with_hole_of(random.integer(3, 12), random.uniform(0.1, 0.3), 0.5);
      case 1: {
        test::Body ball = test::hollow_ball(random.integer(1, 3));
        for (geometry::Vec3& x : ball.x) x *= 0.4;
        return ball;
      }
      case 2: {
        test::Body ridge = test::sheet(2, 2, 0.8, 0.8, any_cut(random));
        const double slope = random.uniform(0.05, 1.2);
        for (geometry::Vec3& x : ridge.x) x.z() = -slope * std::abs(x.y());
        return ridge;
      }
      default:
        return test::moved(test::sheet(2, 2, 0.6, 0.6, any_cut(random)),
                           {0.5 * std::numbers::pi, 0.0, 0.0}, geometry::Vec3::Zero());
    }
  };
  Structures pair{any(), any(), false, {}};
  const geometry::Vec3 turns = random.coin() ? geometry::Vec3(random.in_cube(3.0))
                                             : geometry::Vec3(0.0, 0.0, small_turn(random));
  pair.b = test::moved(pair.b, turns, {0.0, 0.0, 1.0});
  if (random.coin())
    for (geometry::Vec3& x : pair.b.x)
      x += geometry::Vec3(0.2 * random.unit(), 0.2 * random.unit(), 0.0);
  bring_near(pair.a, pair.b, depth);
  return pair;
}

/// A net or a chain on a sheet.
inline Structures bars_on_sheet(double depth, test::Random& random) {
  const int n = random.integer(1, 3);
  const double spacing = random.uniform(0.1, 0.3);
  Structures pair{test::sheet(n, n, n * spacing, n * spacing, any_cut(random)),
                  random.coin() ? test::chain(random.integer(1, 4), random.uniform(0.1, 0.8))
                                : test::square_net_of(random.integer(1, 2), spacing),
                  false,
                  {}};
  const double tilt = random.coin() ? small_turn(random) : random.uniform(-0.5, 0.5);
  const double turn = random.coin() ? small_turn(random) : random.uniform(0.0, 3.2);
  pair.b = test::moved(pair.b, {tilt, 0.3 * tilt, turn}, {0.0, 0.0, 0.8});
  bring_near(pair.a, pair.b, depth);
  return pair;
}

/// A sheet, a ridge, a chain or a net pressed through another: at a small angle or at any.
inline Structures crossed(test::Random& random) {
  const auto any = [&]() -> test::Body {
    const double side = random.uniform(0.1, 0.6);
    if (random.integer(0, 3) == 0) return test::chain(random.integer(1, 3), side);
    if (random.integer(0, 3) == 0) return test::square_net_of(random.integer(1, 2), 0.5 * side);
    const int n = random.integer(1, 2);
    test::Body sheet = test::sheet(n, n, side, side, any_cut(random));
    const double slope = random.uniform(-0.5, 0.5);
    for (geometry::Vec3& x : sheet.x) x.z() = slope * std::abs(x.y());
    return roughened(sheet, 0.01 * side, random);
  };
  Structures pair{any(), any(), false, {}};
  pair.do_cross = true;
  const geometry::Vec3 turns =
      random.coin() ? geometry::Vec3(random.in_cube(3.0))
                    : geometry::Vec3(0.4 * random.in_cube(1.0).x(), 0.4 * random.in_cube(1.0).x(),
                                     random.uniform(0.0, 3.2));
  pair.b = test::moved(pair.b, turns, 0.05 * random.in_cube(1.0));
  return pair;
}

enum class StructureFamily {
  bars_on_bars,
  sheet_on_sheet,
  mirror_image,
  folded,
  rims,
  bars_on_sheet
};
inline constexpr int kStructureFamilies = 6;

/// Overlaps are 1e-4 to 0.02 m.
inline Structures any_structures_of(StructureFamily family, test::Random& random) {
  const double depth = std::pow(10.0, random.uniform(-4.0, -1.7));
  Structures found = [&] {
    switch (family) {
      case StructureFamily::bars_on_bars:
        return bars_on_bars(depth, random);
      case StructureFamily::sheet_on_sheet:
        return sheet_on_sheet(depth, random);
      case StructureFamily::mirror_image:
        return sheet_on_mirror_image(depth, random);
      case StructureFamily::folded:
        return folded(depth, random);
      case StructureFamily::rims:
        return rim_on_rim(depth, random);
      default:
        return bars_on_sheet(depth, random);
    }
  }();
  if (found.rest.empty()) found.rest = found.nodes();
  return found;
}

inline Structures any_crossed_structures(test::Random& random) {
  Structures found = crossed(random);
  found.rest = found.nodes();
  return found;
}

/// Two rough shells pressed through each other, which have no rims.
inline Structures any_crossed_shells(test::Random& random) {
  const auto any = [&]() -> test::Body {
    test::Body ball = test::hollow_ball(random.integer(1, 2));
    const geometry::Vec3 semi_axes(random.uniform(0.05, 0.4), random.uniform(0.2, 0.4), 0.3);
    for (geometry::Vec3& x : ball.x) x = x.cwiseProduct(semi_axes);
    return roughened(ball, 0.02, random);
  };
  Structures pair{any(), any(), false, {}};
  pair.do_cross = true;
  pair.b = test::moved(pair.b, random.in_cube(3.0), 0.4 * random.in_cube(1.0));
  pair.rest = pair.nodes();
  return pair;
}

inline Structures any_structures(test::Random& random) {
  const auto family = static_cast<StructureFamily>(random.integer(0, kStructureFamilies - 1));
  return any_structures_of(family, random);
}

}  // namespace plekton::geometry_check
