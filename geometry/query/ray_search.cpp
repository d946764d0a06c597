// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/ray_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plekton::geometry {
namespace {

using Row = BoxTree::Row;
/// t where there is no hit.
constexpr double kNever = std::numeric_limits<double>::infinity();

/// m. Whatever hit() calls a hit at t or before is as near to the point at t or before, also in its
/// rounded box.
double slack_of(const Ray& ray, double t, const Box& bounds) {
  const double size = bounds.lower.norm() + bounds.upper.norm();
  return 4.0 * resolution(ray, t) + 1e-12 * size;
}

/// The part of a ray inside the ball around a surface, by the way s (m) from where it comes in.
struct Way {
  Vec3 start;    ///< m
  Vec3 inverse;  ///< of the components of the unit direction
  double begin;  ///< t of the start
  double speed;  ///< m for each t
  double slack;  ///< m
  bool is_empty;

  Way(const Ray& ray, const Box& bounds) : speed(ray.direction.norm()) {
    const Vec3 direction = ray.direction / speed;
    const Vec3 centre = 0.5 * (bounds.lower + bounds.upper);
    const double nearest_t = (centre - ray.origin).dot(direction) / speed;
    const double margin = slack_of(ray, std::max(nearest_t, 0.0), bounds);
    const double radius = 0.5 * (bounds.upper - bounds.lower).norm() * (1.0 + 1e-9) + margin;
    begin = std::max(0.0, nearest_t - radius / speed);
    const double end = std::min(ray.t_end, nearest_t + radius / speed);
    is_empty = !(begin <= end);
    slack = slack_of(ray, std::max(end, 0.0), bounds);
    start = ray.origin + begin * ray.direction;
    // A component that is nearly zero counts as one so small that the way hardly feels it.
    for (int axis = 0; axis < 3; ++axis) {
      const double least = std::copysign(1e-18, direction[axis]);
      inverse[axis] = 1.0 / (std::abs(direction[axis]) < 1e-18 ? least : direction[axis]);
    }
  }

  double s_of(double t) const { return (t - begin) * speed; }

  /// Where (m) it comes into each child's box, grown by the radius and the slack; infinite if it
  /// does not.
  Row entries(const BoxTree::Node& node) const {
    Row in{}, out;
    out.fill(kNever);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double from = start[static_cast<int>(axis)], by = inverse[static_cast<int>(axis)];
      for (std::size_t lane = 0; lane < BoxTree::kLanes; ++lane) {
        const double margin = node.radius[lane] + slack;
        const double p = (node.lower[axis][lane] - margin - from) * by;
        const double q = (node.upper[axis][lane] + margin - from) * by;
        in[lane] = std::max(in[lane], std::min(p, q));
        out[lane] = std::min(out[lane], std::max(p, q));
      }
    }
    for (std::size_t lane = 0; lane < BoxTree::kLanes; ++lane) {
      if (!node.child[lane].exists() || !(in[lane] <= out[lane])) in[lane] = kNever;
    }
    return in;
  }
};

/// Calls visit(cell) for all cells that the ray may hit before last() (m of its way), the nearest
/// boxes first.
template <class Visit, class Last>
void walk(const Way& way, const BoxTree& tree, const Visit& visit, const Last& last) {
  struct Waiting {
    double in;
    BoxTree::Child child;
  };
  std::array<Waiting, BoxTree::kMostEntries> open;
  std::size_t count = 0;
  const auto push = [&](const BoxTree::Node& node) {
    const Row in = way.entries(node);
    const std::size_t first = count;
    for (std::size_t lane = 0; lane < BoxTree::kLanes; ++lane) {
      if (!(in[lane] < kNever) || in[lane] > last()) continue;
      std::size_t k = count++;
      for (; k > first && open[k - 1].in < in[lane]; --k) open[k] = open[k - 1];
      open[k] = {in[lane], node.child[lane]};
    }
  };
  push(tree.root());
  while (count > 0) {
    const Waiting entry = open[--count];
    if (entry.in > last()) continue;
    if (entry.child.is_item())
      visit(CellId{entry.child.item()});
    else
      push(tree.node(entry.child));
  }
}

}  // namespace

std::optional<RayHit> first_hit(const Ray& ray, const SearchedSurface& on, const Box& bounds) {
  std::optional<RayHit> first;
  if (on.tree.is_empty() || !can_hit(ray)) return first;
  const Way way(ray, bounds);
  if (way.is_empty) return first;
  double last = kNever;
  walk(
      way, on.tree,
      [&](CellId cell) {
        const auto found = hit(ray, on.placed, cell);
        if (!found ||
            (first && !(found->t < first->t || (found->t == first->t && cell < first->cell))))
          return;
        first = found;
        last = way.s_of(first->t) + 2.0 * way.slack;
      },
      [&] { return last; });
  return first;
}

std::vector<RayHit> all_hits(const Ray& ray, const SearchedSurface& on, const Box& bounds) {
  std::vector<RayHit> hits;
  if (on.tree.is_empty() || !can_hit(ray)) return hits;
  const Way way(ray, bounds);
  if (way.is_empty) return hits;
  walk(
      way, on.tree,
      [&](CellId cell) {
        if (const auto found = hit(ray, on.placed, cell)) hits.push_back(*found);
      },
      [] { return kNever; });
  std::sort(hits.begin(), hits.end(), [](const RayHit& p, const RayHit& q) {
    return std::pair(p.t, p.cell) < std::pair(q.t, q.cell);
  });
  return hits;
}

}  // namespace plekton::geometry
