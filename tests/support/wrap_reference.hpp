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

/// What one node gives back at a level.
/// @param to_ends  from the node along its bars, any length
inline double reference_turn(const std::vector<geometry::Vec3>& to_ends,
                             const geometry::Vec3& to_centre, double level, double turn) {
  double sum = 0.0;
  for (const geometry::Vec3& bar : to_ends) {
    const double along = to_centre.dot(bar) / bar.norm();
    const double height = (to_centre - along / bar.norm() * bar).norm();
    const double half_chord = std::sqrt(level * level - height * height);
    const double seen = 2.0 / std::numbers::pi * std::asin(std::min(1.0, along / half_chord));
    sum += 1.0 / seen;
  }
  const auto count = static_cast<double>(to_ends.size());
  const double mean = count / sum;
  return 0.5 * count * (1.0 + turn * turn) * mean * mean * mean / (mean * mean + turn * turn);
}

/// J, of one node.
inline double reference_node_energy(const std::vector<geometry::Vec3>& to_ends,
                                    const geometry::Vec3& to_centre, double range, double turn) {
  const double from = to_centre.norm();
  if (!(from < range) || to_ends.size() < 2) return 0.0;
  for (const geometry::Vec3& bar : to_ends) {
    if (!(to_centre.dot(bar) > 0.0)) return 0.0;
  }
  // By the root of the depth below the node, as angles change with it.
  constexpr int kSteps = 4000;
  double sum = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const double part = static_cast<double>(i) / kSteps;
    const double level = from + (range - from) * part * part * part * part;
    const double value =
        reference_turn(to_ends, to_centre, std::max(level, from * (1.0 + 1e-15)), turn) *
        (range - level) * 4.0 * part * part * part * (range - from);
    sum += value * (i == 0 || i == kSteps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0);
  }
  return sum / (3.0 * kSteps);
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
    energy += reference_node_energy(to_ends, centre - x[i], range, turn);
  }
  return energy;
}

}  // namespace plekton::test
