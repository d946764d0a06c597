// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/bodies_of_cells.hpp"

#include <array>
#include <cmath>
#include <map>
#include <numbers>

/// A hollow ball, and what it can be set on.
namespace plekton::test {

/// Of radius 1 m: an octahedron with every side in so many parts, 8 parts^2 facets.
inline Body hollow_ball(int parts) {
  Body ball;
  std::map<std::array<int, 3>, int> ids;
  const auto node = [&](int i, int j, int k) {
    const auto [entry, is_new] = ids.try_emplace({i, j, k}, static_cast<int>(ball.x.size()));
    if (is_new) ball.x.push_back(Vec3(i, j, k).normalized());
    return entry->second;
  };
  for (int octant = 0; octant < 8; ++octant) {
    const auto at = [&](int i, int j) {
      return node((octant & 1) != 0 ? i : -i, (octant & 2) != 0 ? j : -j,
                  (octant & 4) != 0 ? parts - i - j : i + j - parts);
    };
    for (int i = 0; i < parts; ++i) {
      for (int j = 0; i + j < parts; ++j) {
        ball.facets.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 1 < parts)
          ball.facets.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
  return ball;
}

/// A plate in z = 0 with a regular hole about the origin: its corners at the rim radius (m).
inline Body plate_with_hole_of(int corners, double rim, double outer) {
  Body plate;
  for (const auto& [radius, shift] : {std::pair{rim, 0.0}, std::pair{outer, 0.5}}) {
    for (int k = 0; k < corners; ++k) {
      const double angle = 2.0 * std::numbers::pi * (k + shift) / corners;
      plate.x.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    }
  }
  for (int k = 0; k < corners; ++k) {
    const int next = (k + 1) % corners;
    plate.facets.push_back({k, next, corners + k});
    plate.facets.push_back({next, corners + next, corners + k});
  }
  return plate;
}

/// A square net of cylinders in z = 0 about the origin.
inline Body square_net_of(int meshes, double spacing) {
  Body net;
  const auto node = [&](int i, int j) { return j * (meshes + 1) + i; };
  for (int j = 0; j <= meshes; ++j) {
    for (int i = 0; i <= meshes; ++i) {
      net.x.emplace_back(spacing * (i - 0.5 * meshes), spacing * (j - 0.5 * meshes), 0.0);
      if (i < meshes) net.cylinders.push_back({node(i, j), node(i + 1, j)});
      if (j < meshes) net.cylinders.push_back({node(i, j), node(i, j + 1)});
    }
  }
  return net;
}

}  // namespace plekton::test
