// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/elements.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

/// Reference of what the nodes of bars give back where they wrap a ball
/// (contact/counting/wrap.hpp), for springs of 1 N/m: by levels, with Simpson's rule, and
/// with the bars' weights from as many normal equations.
namespace plekton::test {

/// Mean over the levels of a linear spring of the angle, over pi, under which half a chord at a
/// level sees the part of the bar up to its foot.
inline double reference_seen(double foot, double distance, double range) {
  // By the root of the depth below the node, as half chords are in proportion to it.
  constexpr int kSteps = 4000;
  double sum = 0.0;
  for (int i = 1; i <= kSteps; ++i) {
    const double part = static_cast<double>(i) / kSteps;
    const double level = distance + (range - distance) * part * part;
    const double half_chord = std::sqrt(2.0 * distance * (level - distance));
    sum += std::atan2(foot, half_chord) * (range - level) * part * (i % 2 == 1 ? 4.0 : 2.0);
  }
  const double step = 2.0 * (range - distance) / (3.0 * kSteps);
  return 2.0 / std::pow(range - distance, 2) * sum * step / std::numbers::pi;
}

/// How many contacts a node gets back.
/// @param bars  from the node to their other ends
inline double reference_share(const std::vector<geometry::Vec3>& bars,
                              const geometry::Vec3& to_node, double range, double turn) {
  const double distance = to_node.norm();
  if (bars.size() < 2 || !(distance > 0.0 && distance < range)) return 0.0;
  const auto count = static_cast<Eigen::Index>(bars.size());
  Eigen::Matrix3Xd along(3, count);
  Eigen::VectorXd seen(count);
  double squared_length = 0.0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const geometry::Vec3& bar = bars[static_cast<std::size_t>(i)];
    const geometry::Vec3 normal = to_node / distance;
    along.col(i) = bar / bar.norm() - normal * normal.dot(bar) / bar.norm();
    seen[i] = reference_seen(-to_node.dot(bar) / bar.norm(), distance, range);
    squared_length += bar.squaredNorm() / static_cast<double>(count);
  }
  const Eigen::MatrixXd products =
      along.transpose() * along + turn * Eigen::MatrixXd::Identity(count, count);
  const Eigen::VectorXd weights = products.ldlt().solve(Eigen::VectorXd::Constant(count, turn));
  const double x = weights.dot(seen);
  if (!(x > 0.0)) return 0.0;
  const double squared_width = 2.0 * distance * (range - distance);
  const double bend = std::pow(0.5 * turn * static_cast<double>(count), 2) * squared_length /
                      (squared_length + std::pow(3.0 * std::numbers::pi / 8.0, 2) * squared_width);
  return (1.0 + turn * turn) * x * x * x / (x * x + bend);
}

/// J, of all nodes of bars alone.
inline double reference_wrap_energy(const geometry::Surface& surface,
                                    const std::vector<geometry::Vec3>& x,
                                    const geometry::Vec3& centre, double range, double turn) {
  double energy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto node = geometry::id_at<geometry::NodeId>(i);
    if (!surface.faces_of(node).empty()) continue;
    std::vector<geometry::Vec3> bars;
    for (const geometry::EdgeId edge : surface.edges_of(node)) {
      const auto& ends = surface.nodes_of(edge);
      bars.push_back(x[index_of(ends[0] == node ? ends[1] : ends[0])] - x[i]);
    }
    const geometry::Vec3 to_node = x[i] - centre;
    energy += reference_share(bars, to_node, range, turn) * 0.5 *
              std::pow(std::max(0.0, range - to_node.norm()), 2);
  }
  return energy;
}

}  // namespace plekton::test
