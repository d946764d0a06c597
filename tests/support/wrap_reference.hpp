// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/elements.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

/// Reference of what the nodes of bars give back where they wrap a ball (contact/wrap.hpp), for
/// springs of 1 N/m: by levels, with the angles under which half circles see the bars, and
/// Simpson's rule.
namespace plekton::test {

/// X of a bar at a level, less than 0 if its foot is beyond the node.
inline double reference_seen(const geometry::Vec3& bar, const geometry::Vec3& to_centre,
                             double level) {
  const double along = to_centre.dot(bar) / bar.norm();
  const double height = (to_centre - along / bar.norm() * bar).norm();
  const double half_chord = std::sqrt(level * level - height * height);
  return 2.0 / std::numbers::pi * std::asin(std::clamp(along / half_chord, -1.0, 1.0));
}

/// J, of two bars of a node.
/// @param to_ends  from the node along the bars, any length
inline double reference_turn_energy(const geometry::Vec3& a, const geometry::Vec3& b,
                                    const geometry::Vec3& to_centre, double range, double turn) {
  const double from = to_centre.norm();
  const double cosine = a.dot(b) / (a.norm() * b.norm());
  const double along = to_centre.dot(a) / a.norm() + to_centre.dot(b) / b.norm();
  if (!(from < range && cosine < -0.5 && along > 0.0)) return 0.0;
  // By the fourth root of the depth below the node, as angles change with its square root.
  constexpr int kSteps = 4000;
  double sum = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const double part = static_cast<double>(i) / kSteps;
    const double level =
        std::max(from + (range - from) * part * part * part * part, from * (1.0 + 1e-15));
    const double mean =
        0.5 * (reference_seen(a, to_centre, level) + reference_seen(b, to_centre, level));
    const double value = (1.0 + turn * turn) * mean * mean * mean / (mean * mean + turn * turn) *
                         (range - level) * 4.0 * part * part * part * (range - from);
    sum += value * (i == 0 || i == kSteps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0);
  }
  const double straight = -1.0 - 2.0 * cosine;
  return straight * straight * (3.0 - 2.0 * straight) * sum / (3.0 * kSteps);
}

/// J, of all nodes of bars alone.
inline double reference_wrap_energy(const geometry::Surface& surface,
                                    const std::vector<geometry::Vec3>& x,
                                    const geometry::Vec3& centre, double range, double turn) {
  double energy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto node = geometry::id_at<geometry::NodeId>(i);
    if (!surface.faces_of(node).empty()) continue;
    std::vector<geometry::Vec3> to_ends;
    for (const geometry::EdgeId edge : surface.edges_of(node)) {
      const auto& ends = surface.nodes_of(edge);
      to_ends.push_back(x[index_of(ends[0] == node ? ends[1] : ends[0])] - x[i]);
    }
    for (std::size_t a = 0; a < to_ends.size(); ++a) {
      for (std::size_t b = a + 1; b < to_ends.size(); ++b)
        energy += reference_turn_energy(to_ends[a], to_ends[b], centre - x[i], range, turn);
    }
  }
  return energy;
}

}  // namespace plekton::test
