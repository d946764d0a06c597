// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

/// Reference of the contact rule for a ball against a surface, written as "cells minus seams", in
/// plain double and without any part of the library: slow and short.
///
/// The maximal cells in range each push with f(range - distance) from their nearest point. A seam
/// is what two cells share; those of a spanning forest over the cells, nearest seams first, are
/// taken away again. What is left counts the connected parts of the surface that are in range.
namespace plekton::test {

using geometry::Vec3;

/// Nearest point of a simplex, as seen from a point: where it is, and how far.
struct ReferenceFoot {
  Vec3 separation;
  double distance;
};

/// Node, segment or triangle. Corners in a fixed order give the same bits, whichever cell asks for
/// them.
class ReferenceSimplex {
 public:
  ReferenceSimplex(std::vector<int> nodes, const std::vector<Vec3>& x)
      : nodes_(std::move(nodes)), x_(&x) {
    std::sort(nodes_.begin(), nodes_.end());
  }

  const std::vector<int>& nodes() const { return nodes_; }

  /// The least of the feet on all corners, sides and, if the perpendicular meets it, the face.
  ReferenceFoot foot(const Vec3& p) const {
    ReferenceFoot best{Vec3::Zero(), std::numeric_limits<double>::infinity()};
    const auto offer = [&](const Vec3& separation) {
      if (separation.norm() < best.distance) best = {separation, separation.norm()};
    };
    for (const int node : nodes_) offer(at(node) - p);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      for (std::size_t j = i + 1; j < nodes_.size(); ++j) {
        const Vec3 a = at(nodes_[i]) - p;
        const Vec3 side = at(nodes_[j]) - at(nodes_[i]);
        const double t = -a.dot(side) / side.squaredNorm();
        if (t > 0.0 && t < 1.0) offer(a + t * side);
      }
    }
    if (nodes_.size() == 3) {
      const Vec3 a = at(nodes_[0]) - p;
      const Vec3 u = at(nodes_[1]) - at(nodes_[0]);
      const Vec3 v = at(nodes_[2]) - at(nodes_[0]);
      const Vec3 normal = u.cross(v);
      const double area_squared = normal.squaredNorm();
      const double s = -a.cross(v).dot(normal) / area_squared;
      const double t = -u.cross(a).dot(normal) / area_squared;
      if (s > 0.0 && t > 0.0 && s + t < 1.0) offer(a.dot(normal) / area_squared * normal);
    }
    return best;
  }

 private:
  const Vec3& at(int node) const { return (*x_)[static_cast<std::size_t>(node)]; }

  std::vector<int> nodes_;
  const std::vector<Vec3>* x_;
};

struct ReferenceContact {
  Vec3 force = Vec3::Zero();  ///< on the ball
  int components = 0;
  double overlaps = 0.0;  ///< m, sum of the overlaps of the cells minus those of the seams taken
                          ///< away: the integral of the number of components over the levels
  double energy = 0.0;    ///< m^2, the same with half their squares: that of springs
  int cells = 0;          ///< in range
  double nearest = std::numeric_limits<double>::infinity();
};

/// Force f(overlap) of a surface on a ball whose centre is at p.
/// @param cells  node lists of the maximal cells
/// @param range  radius of the ball + radius of the cells
template <class Force>
ReferenceContact reference_contact(const Vec3& p, double range,
                                   const std::vector<std::vector<int>>& cells,
                                   const std::vector<Vec3>& x, Force f) {
  ReferenceContact result;
  const auto add = [&](const ReferenceFoot& foot, double sign) {
    result.force -= sign * f(range - foot.distance) / foot.distance * foot.separation;
    result.overlaps += sign * (range - foot.distance);
    result.energy += 0.5 * sign * (range - foot.distance) * (range - foot.distance);
  };
  std::vector<ReferenceSimplex> near;
  for (const auto& nodes : cells) {
    const ReferenceSimplex cell(nodes, x);
    const ReferenceFoot foot = cell.foot(p);
    result.nearest = std::min(result.nearest, foot.distance);
    if (!(foot.distance < range)) continue;
    add(foot, 1.0);
    near.push_back(cell);
  }
  result.cells = static_cast<int>(near.size());
  result.components = result.cells;

  struct Seam {
    ReferenceFoot foot;
    std::size_t i;
    std::size_t j;
  };
  std::vector<Seam> seams;
  for (std::size_t i = 0; i < near.size(); ++i) {
    for (std::size_t j = i + 1; j < near.size(); ++j) {
      std::vector<int> shared;
      std::set_intersection(near[i].nodes().begin(), near[i].nodes().end(), near[j].nodes().begin(),
                            near[j].nodes().end(), std::back_inserter(shared));
      if (shared.empty()) continue;
      const ReferenceFoot foot = ReferenceSimplex(shared, x).foot(p);
      if (foot.distance < range) seams.push_back({foot, i, j});
    }
  }
  std::stable_sort(seams.begin(), seams.end(),
                   [](const Seam& a, const Seam& b) { return a.foot.distance < b.foot.distance; });

  std::vector<std::size_t> root(near.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (root[i] != i) i = root[i];
    return i;
  };
  for (const Seam& seam : seams) {
    const std::size_t a = find(seam.i);
    const std::size_t b = find(seam.j);
    if (a == b) continue;
    root[a] = b;
    add(seam.foot, -1.0);
    --result.components;
  }
  return result;
}

}  // namespace plekton::test
