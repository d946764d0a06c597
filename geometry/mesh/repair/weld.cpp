// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/weld.hpp"

#include "geometry/base/lexicographic.hpp"
#include "geometry/mesh/disjoint_sets.hpp"
#include "geometry/mesh/mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <sstream>

namespace plekton::geometry {
namespace {

Weld weld_of(std::span<const Vec3> points, DisjointSets& sets) {
  Weld weld;
  weld.representative.resize(points.size());
  weld.position.assign(points.begin(), points.end());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t first = weld.representative[i] = sets.find(i);
    if (first == i) continue;
    ++weld.merged;
    if (lexicographically_less(points[i], weld.position[first])) weld.position[first] = points[i];
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    weld.position[i] = weld.position[weld.representative[i]];
    weld.largest_move = std::max(weld.largest_move, (weld.position[i] - points[i]).norm());
  }
  return weld;
}

using Cell = std::array<std::int64_t, 3>;

/// Points sorted into cubic cells, a little more than half the weld distance wide, so that all
/// points of one cell are within reach of each other (the diagonal is 0.87 of the distance) and
/// partners are at most two cells away, however places are rounded.
class CellGrid {
 public:
  CellGrid(std::span<const Vec3> points, double distance)
      : cell_of_(points.size()), order_(points.size()) {
    Vec3 lower = points[0];
    for (const Vec3& p : points) lower = lower.cwiseMin(p);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 scaled = 1.98 * ((points[i] - lower) / distance);
      for (std::size_t k = 0; k < 3; ++k)
        cell_of_[i][k] =
            static_cast<std::int64_t>(std::floor(scaled[static_cast<Eigen::Index>(k)]));
    }
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::sort(order_.begin(), order_.end(),
              [&](std::size_t i, std::size_t j) { return cell_of_[i] < cell_of_[j]; });
    for (std::size_t k = 0; k < order_.size(); ++k) {
      if (k > 0 && cell_of_[order_[k]] == cells_.back()) continue;
      cells_.push_back(cell_of_[order_[k]]);
      start_.push_back(k);
    }
    start_.push_back(order_.size());
  }

  std::size_t size() const noexcept { return cells_.size(); }
  std::span<const std::size_t> points_in(std::size_t cell) const noexcept {
    return {order_.data() + start_[cell], order_.data() + start_[cell + 1]};
  }

  /// Calls visit(other) for the occupied cells at most two away that follow a cell.
  template <class Visit>
  void for_each_later_neighbour(std::size_t cell, const Visit& visit) const {
    const Cell& c = cells_[cell];
    for (std::int64_t dx = 0; dx <= 2; ++dx) {
      for (std::int64_t dy = dx == 0 ? 0 : -2; dy <= 2; ++dy) {
        const Cell from = {c[0] + dx, c[1] + dy, c[2] - 2}, to = {c[0] + dx, c[1] + dy, c[2] + 2};
        const auto begin = std::lower_bound(cells_.begin(), cells_.end(), from);
        for (auto other = begin; other != cells_.end() && *other <= to; ++other)
          if (*other > c) visit(static_cast<std::size_t>(other - cells_.begin()));
      }
    }
  }

 private:
  std::vector<Cell> cell_of_;
  std::vector<std::size_t> order_;
  std::vector<Cell> cells_;
  std::vector<std::size_t> start_;
};

bool any_within(std::span<const Vec3> points, double distance, std::span<const std::size_t> a,
                std::span<const std::size_t> b) {
  for (const std::size_t i : a)
    for (const std::size_t j : b)
      if ((points[i] - points[j]).norm() <= distance) return true;
  return false;
}

void require_resolvable(std::span<const Vec3> points, double distance) {
  Vec3 lower = points[0], upper = points[0];
  for (const Vec3& p : points) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  const double extent = (upper - lower).maxCoeff();
  if (distance > 0.0 && std::isfinite(distance) && extent <= 1e12 * distance) return;
  std::ostringstream text;
  text << "a weld distance of " << distance << " m on a mesh " << extent
       << " m across; expected a positive length above " << 1e-12 * extent << " m";
  throw MeshError(text.str());
}

}  // namespace

Weld weld_equal_points(std::span<const Vec3> points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return lexicographically_less(points[i], points[j]);
  });
  DisjointSets sets(points.size());
  for (std::size_t k = 1; k < order.size(); ++k)
    if (points[order[k - 1]] == points[order[k]]) sets.unite(order[k - 1], order[k]);
  return weld_of(points, sets);
}

Weld weld_near_points(std::span<const Vec3> points, double distance) {
  DisjointSets sets(points.size());
  if (points.empty()) return weld_of(points, sets);
  require_resolvable(points, distance);

  const CellGrid grid(points, distance);
  for (std::size_t cell = 0; cell < grid.size(); ++cell)
    for (const std::size_t i : grid.points_in(cell)) sets.unite(grid.points_in(cell).front(), i);
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    grid.for_each_later_neighbour(cell, [&](std::size_t other) {
      const auto a = grid.points_in(cell), b = grid.points_in(other);
      if (sets.find(a.front()) != sets.find(b.front()) && any_within(points, distance, a, b))
        sets.unite(a.front(), b.front());
    });
  }
  return weld_of(points, sets);
}

}  // namespace plekton::geometry
