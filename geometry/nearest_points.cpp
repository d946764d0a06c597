// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/nearest_points.hpp"

#include "geometry/foot_point.hpp"
#include "geometry/predicates.hpp"

#include <limits>

namespace plekton::geometry {
namespace {

/// A point of a simplex: weights of its corners, and which of them span its feature.
struct Place {
  std::array<double, 3> weights{};
  unsigned corners = 0;
};

Place at_corner(std::size_t i) {
  Place place;
  place.weights[i] = 1.0;
  place.corners = 1u << i;
  return place;
}

Place on_edge(std::size_t i, std::size_t k, double share_of_k) {
  Place place;
  place.weights[i] = 1.0 - share_of_k;
  place.weights[k] = share_of_k;
  place.corners = 1u << i | 1u << k;
  return place;
}

using Corners = std::span<const Vec3>;

std::size_t edge_count(Corners simplex) {
  return simplex.size() == 3 ? 3 : simplex.size() - 1;
}

/// Foot of a point on a simplex: the only one, by the exact signs, that is inside its feature.
struct Foot {
  FootPoint foot;
  Place place;
};

bool projects_inside(const Vec3& point, const Vec3& first, const Vec3& last) {
  return sign_past_vertex(first, last, point) > 0 && sign_past_vertex(last, first, point) > 0;
}

Foot foot_on_corner(const Vec3& point, Corners simplex) {
  std::size_t nearest = 0;
  for (std::size_t k = 1; k < simplex.size(); ++k) {
    const double so_far = (simplex[nearest] - point).squaredNorm();
    if ((simplex[k] - point).squaredNorm() < so_far) nearest = k;
  }
  return {foot_on_node(point, simplex[nearest]), at_corner(nearest)};
}

Foot foot_on(const Vec3& point, Corners simplex) {
  bool is_above = simplex.size() == 3;
  for (std::size_t k = 0; k < edge_count(simplex); ++k) {
    const std::size_t next = (k + 1) % simplex.size();
    const Vec3& first = simplex[k];
    const Vec3& last = simplex[next];
    if (simplex.size() == 3) {
      if (sign_inside_edge(first, last, simplex[(k + 2) % 3], point) > 0) continue;
      is_above = false;
    }
    if (!projects_inside(point, first, last)) continue;
    const FootPoint foot = foot_on_edge(point, {first, last});
    return {foot, on_edge(k, next, foot.weights[1])};
  }
  if (!is_above) return foot_on_corner(point, simplex);
  const FootPoint foot = foot_on_face(point, {simplex[0], simplex[1], simplex[2]});
  return {foot, {{foot.weights[0], foot.weights[1], foot.weights[2]}, 7u}};
}

class Search {
 public:
  Search(Corners a, Corners b) : a_(a), b_(b) {}

  NearestPoints run() {
    for (std::size_t i = 0; i < a_.size(); ++i) {
      const Foot found = foot_on(a_[i], b_);
      take(found.foot.distance, found.foot.direction, at_corner(i), found.place);
    }
    for (std::size_t i = 0; i < b_.size(); ++i) {
      const Foot found = foot_on(b_[i], a_);
      take(found.foot.distance, -found.foot.direction, found.place, at_corner(i));
    }
    for (std::size_t i = 0; i < edge_count(a_); ++i) {
      for (std::size_t k = 0; k < edge_count(b_); ++k) {
        between_edges(i, (i + 1) % a_.size(), k, (k + 1) % b_.size());
      }
    }
    return best_;
  }

 private:
  /// @param normal  unit, from a to b
  void take(double distance, const Vec3& normal, const Place& on_a, const Place& on_b) {
    if (distance >= best_.distance) return;
    best_ = {distance, normal, on_a.weights, on_b.weights, on_a.corners, on_b.corners};
  }

  /// Only where both lines are nearest inside both edges. Of edges that are parallel up to
  /// round-off some end is as near.
  void between_edges(std::size_t i, std::size_t i_next, std::size_t k, std::size_t k_next) {
    const Vec3 u = a_[i_next] - a_[i];
    const Vec3 v = b_[k_next] - b_[k];
    const Vec3 across = b_[k] - a_[i];
    const Vec3 n = u.cross(v);
    const double square = n.squaredNorm();
    constexpr double kRoundoff = 1e-12;
    if (square <= kRoundoff * kRoundoff * u.squaredNorm() * v.squaredNorm()) return;
    const double on_a = across.cross(v).dot(n);
    const double on_b = across.cross(u).dot(n);
    if (!(on_a > 0.0 && on_a < square && on_b > 0.0 && on_b < square)) return;
    const double height = across.dot(n);
    if (height * height >= square * best_.distance * best_.distance) return;
    const double length = std::sqrt(square);
    const Vec3 normal = (height < 0.0 ? -1.0 : 1.0) / length * n;
    take(std::abs(height) / length, normal, on_edge(i, i_next, on_a / square),
         on_edge(k, k_next, on_b / square));
  }

  Corners a_;
  Corners b_;
  NearestPoints best_{std::numeric_limits<double>::infinity(), Vec3::UnitZ(), {}, {}, 0, 0};
};

}  // namespace

NearestPoints nearest_points(std::span<const Vec3> a, std::span<const Vec3> b) noexcept {
  return Search(a, b).run();
}

}  // namespace plekton::geometry
