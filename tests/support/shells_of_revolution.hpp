// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

/// Surfaces around the z axis that face outward, every second ring of nodes turned by half a cell.
namespace plekton::test {

/// Radius and height (m) of a ring of nodes.
struct Ring {
  double radius, height;
};

/// @param profile   rings from below, on the outside; even in number if it is a cycle
/// @param is_cycle  whether the first ring comes after the last one
inline geometry::Mesh revolved(const std::vector<Ring>& profile, int around, bool is_cycle) {
  geometry::Mesh mesh;
  const auto count = static_cast<int>(profile.size());
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < around; ++k) {
      const double angle = 2.0 * std::numbers::pi * (k + 0.5 * (i % 2)) / around;
      const auto [radius, height] = profile[static_cast<std::size_t>(i)];
      mesh.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
    }
  }
  for (int i = 0; i + (is_cycle ? 0 : 1) < count; ++i) {
    const auto lower = [&](int k) { return geometry::NodeId{i * around + k % around}; };
    const auto upper = [&](int k) {
      return geometry::NodeId{(i + 1) % count * around + k % around};
    };
    for (int k = 0; k < around; ++k) {
      if (i % 2 == 0) {
        mesh.facets.push_back({lower(k), lower(k + 1), upper(k)});
        mesh.facets.push_back({lower(k + 1), upper(k + 1), upper(k)});
      } else {
        mesh.facets.push_back({lower(k), lower(k + 1), upper(k + 1)});
        mesh.facets.push_back({lower(k), upper(k + 1), upper(k)});
      }
    }
  }
  return mesh;
}

/// Closes the first or last ring around a node on the axis.
inline void add_pole(geometry::Mesh& mesh, int around, bool at_end, double height) {
  const auto pole = geometry::id_at<geometry::NodeId>(mesh.points.size());
  const int first = at_end ? static_cast<int>(mesh.points.size()) - around : 0;
  mesh.points.emplace_back(0.0, 0.0, height);
  for (int k = 0; k < around; ++k) {
    const geometry::NodeId a{first + k}, b{first + (k + 1) % around};
    if (at_end)
      mesh.facets.push_back({a, b, pole});
    else
      mesh.facets.push_back({b, a, pole});
  }
}

/// Circle of radius r around the circle of radius R, in cells across it and around the axis.
/// @param across  even
inline geometry::Mesh torus(double R, double r, int across, int around) {
  std::vector<Ring> profile;
  for (int i = 0; i < across; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / across;
    profile.push_back({R + r * std::cos(angle), r * std::sin(angle)});
  }
  return revolved(profile, around, true);
}

/// A cylinder of radius R between z = 0 and its length, with half a sphere over either end, in
/// cells along a quarter of a circle, along the cylinder and around.
inline geometry::Mesh capsule(double R, double length, int quarter, int along, int around) {
  std::vector<Ring> profile;
  const auto angle = [&](int i) { return 0.5 * std::numbers::pi * i / quarter; };
  for (int i = 1; i < quarter; ++i)
    profile.push_back({R * std::sin(angle(i)), -R * std::cos(angle(i))});
  for (int i = 0; i <= along; ++i) profile.push_back({R, length * i / along});
  for (int i = 1; i < quarter; ++i)
    profile.push_back({R * std::cos(angle(i)), length + R * std::sin(angle(i))});
  geometry::Mesh mesh = revolved(profile, around, false);
  add_pole(mesh, around, true, length + R);
  // The first ring is still the first: the pole comes last.
  add_pole(mesh, around, false, -R);
  return mesh;
}

/// Cap of a sphere of radius R with a rim of radius a at z = 0.
inline geometry::Mesh cap(double R, double a, int rings, int around) {
  const double opening = std::asin(a / R), low = R * std::cos(opening);
  std::vector<Ring> profile;
  for (int i = 0; i < rings; ++i) {
    const double angle = opening * (rings - i) / rings;
    profile.push_back({R * std::sin(angle), R * std::cos(angle) - low});
  }
  geometry::Mesh mesh = revolved(profile, around, false);
  add_pole(mesh, around, true, R - low);
  return mesh;
}

}  // namespace plekton::test
