// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/enclosure.hpp"

#include "geometry/base/predicates.hpp"

#include <algorithm>

namespace plekton::geometry {
namespace {

using Corners = std::array<Vec3, 3>;

/// A ray from a point along an axis. Seen along it, u and v are the axes to the right and upwards;
/// the point is moved up by an infinitesimal amount, and to the right by a much smaller one.
class AxisRay {
 public:
  AxisRay(const Vec3& point, int axis, bool is_upward)
      : point_(point),
        u_((axis + 1) % 3),
        v_((axis + 2) % 3),
        is_upward_(is_upward),
        along_(Vec3::Unit(axis)) {}

  bool crosses(const Corners& x) const {
    if (!is_over(x)) return false;
    const int turn = sign_seen_along(x[0], x[1], x[2]);
    const int above = sign_of_volume({x[0], x[1]}, {x[0], x[2]}, {x[0], point_});
    return (turn * above < 0) == is_upward_;
  }

 private:
  /// Sign of the area of three points, seen along the axis.
  int sign_seen_along(const Vec3& a, const Vec3& b, const Vec3& c) const {
    return sign_of_volume({a, b}, {a, c}, {origin_, along_});
  }

  /// Whether the point is over or under a facet: an odd number of sides is to the right of it.
  bool is_over(const Corners& x) const {
    bool is_odd = false;
    for (std::size_t k = 0; k < 3; ++k) is_odd ^= is_to_the_right(x[k], x[(k + 1) % 3]);
    return is_odd;
  }

  bool is_to_the_right(const Vec3& a, const Vec3& b) const {
    const bool rises = b[v_] > point_[v_];
    if ((a[v_] > point_[v_]) == rises) return false;
    int turn = sign_seen_along(a, b, point_);
    if (turn == 0) turn = (b[u_] > a[u_]) - (b[u_] < a[u_]);
    if (turn == 0) turn = rises ? -1 : 1;
    return (turn > 0) == rises;
  }

  const Vec3& point_;
  int u_;
  int v_;
  bool is_upward_;
  Vec3 along_;
  Vec3 origin_ = Vec3::Zero();
};

Corners corners_of(const PlacedSurface& on, FaceId face) {
  const auto& n = on.surface.nodes_of(face);
  return {on.x[index_of(n[0])], on.x[index_of(n[1])], on.x[index_of(n[2])]};
}

bool is_in(const Vec3& point, const Corners& x) {
  return ((x[0].cwiseMin(x[1]).cwiseMin(x[2]) - point).array() <= 0.0).all() &&
         ((x[0].cwiseMax(x[1]).cwiseMax(x[2]) - point).array() >= 0.0).all();
}

/// The ray along an axis that leaves a box soonest.
std::pair<int, bool> shortest_way_out(const Vec3& point, const Box& box) {
  int axis = 0;
  const Vec3 down = point - box.lower, up = box.upper - point;
  const Vec3 shorter = down.cwiseMin(up);
  shorter.minCoeff(&axis);
  return {axis, up[axis] < down[axis]};
}

}  // namespace

std::optional<EdgeId> open_edge(const Surface& surface) {
  for (std::size_t e = 0; e < surface.edge_count(); ++e) {
    const EdgeId edge = id_at<EdgeId>(e);
    if (surface.faces_of(edge).size() % 2 != 0) return edge;
  }
  return std::nullopt;
}

Side side_of(const Vec3& point, const SearchedSurface& on, const Box& bounds) {
  const auto [axis, is_upward] = shortest_way_out(point, bounds);
  const AxisRay ray(point, axis, is_upward);
  Box way{point, point};
  if (is_upward)
    way.upper[axis] = std::max(way.upper[axis], bounds.upper[axis]);
  else
    way.lower[axis] = std::min(way.lower[axis], bounds.lower[axis]);
  bool is_odd = false, is_on = false;
  on.tree.for_each_near(way, [&](std::int32_t item) {
    const FaceId face{item};
    const Corners x = corners_of(on.placed, face);
    if (is_in(point, x) && proximity(Probe::point(point), on.placed, CellId{item}).relation ==
                               Relation::touching_or_crossing) {
      is_on = true;
    }
    is_odd ^= ray.crosses(x);
  });
  if (is_on) return Side::on;
  return is_odd ? Side::inside : Side::outside;
}

}  // namespace plekton::geometry
