// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/triangulate_polygon.hpp"

#include "geometry/base/lexicographic.hpp"
#include "geometry/mesh/repair/exact_signs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace plekton::geometry {
namespace {

/// Newell's sum of the cross products of neighbours, about the first corner: twice the area vector
/// (m²).
Vec3 area_vector(std::span<const Vec3> x) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < x.size(); ++i) sum += (x[i] - x[0]).cross(x[i + 1] - x[0]);
  return sum;
}

std::array<int, 3> axes_by_size(const Vec3& normal) {
  std::array<int, 3> axes = {0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(),
                   [&](int i, int j) { return std::abs(normal[i]) > std::abs(normal[j]); });
  return axes;
}

/// A polygon seen along an axis. All answers are exact.
class FlatView {
 public:
  FlatView(std::span<const Vec3> x, Axis along) : x_(x), along_(along) {}

  int turn_at(std::size_t a, std::size_t b, std::size_t c) const {
    return turn(along_, x_[a], x_[b], x_[c]);
  }

  /// 1 if the polygon runs counterclockwise, -1 if clockwise, 0 if it folds back at its lowest
  /// corner.
  int winding() const {
    const std::size_t n = x_.size();
    const auto low = static_cast<std::size_t>(
        std::min_element(x_.begin(), x_.end(),
                         [&](const Vec3& p, const Vec3& q) { return less(p, q); }) -
        x_.begin());
    // The extreme corner of a simple polygon is strictly convex: both neighbours lie beyond it.
    return turn_at((low + n - 1) % n, low, (low + 1) % n);
  }

  /// True if no two sides meet, other than neighbours in their common corner.
  bool is_simple() const {
    const std::size_t n = x_.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (same(i, (i + 1) % n)) return false;
      if (folds_back(i)) return false;
      for (std::size_t j = i + 2; j < n; ++j)
        if (!(i == 0 && j == n - 1) && sides_meet(i, (i + 1) % n, j, (j + 1) % n)) return false;
    }
    return true;
  }

  /// Is corner p inside triangle a, b, c (counterclockwise for sign 1) or on its rim?
  bool holds(int sign, std::size_t a, std::size_t b, std::size_t c, std::size_t p) const {
    return sign * turn_at(a, b, p) >= 0 && sign * turn_at(b, c, p) >= 0 &&
           sign * turn_at(c, a, p) >= 0;
  }

 private:
  double u(const Vec3& p) const { return p[(along_.value + 1) % 3]; }
  double v(const Vec3& p) const { return p[(along_.value + 2) % 3]; }
  bool less(const Vec3& p, const Vec3& q) const { return u(p) != u(q) ? u(p) < u(q) : v(p) < v(q); }
  bool same(std::size_t i, std::size_t j) const {
    return u(x_[i]) == u(x_[j]) && v(x_[i]) == v(x_[j]);
  }

  /// Do the two sides at the corner behind side i lie on top of each other?
  bool folds_back(std::size_t i) const {
    const std::size_t n = x_.size();
    const std::size_t j = (i + 1) % n, k = (i + 2) % n;
    if (turn_at(i, j, k) != 0) return false;
    return less(x_[i], x_[j]) == less(x_[k], x_[j]);
  }

  /// On the line through a and b: is p between them, ends included?
  bool is_between(std::size_t a, std::size_t b, std::size_t p) const {
    const auto [low, high] = less(x_[a], x_[b]) ? std::pair(a, b) : std::pair(b, a);
    return !less(x_[p], x_[low]) && !less(x_[high], x_[p]);
  }

  bool sides_meet(std::size_t a, std::size_t b, std::size_t c, std::size_t d) const {
    const int ca = turn_at(a, b, c), cb = turn_at(a, b, d), cc = turn_at(c, d, a),
              cd = turn_at(c, d, b);
    if (ca * cb < 0 && cc * cd < 0) return true;
    return (ca == 0 && is_between(a, b, c)) || (cb == 0 && is_between(a, b, d)) ||
           (cc == 0 && is_between(c, d, a)) || (cd == 0 && is_between(c, d, b));
  }

  std::span<const Vec3> x_;
  Axis along_;
};

/// Is the diagonal 0-2 shorter than 1-3? Equal ones are decided by position, so that neither the
/// first corner nor the direction of the polygon matters.
bool first_diagonal_is_better(std::span<const Vec3> x) {
  const double first = (x[2] - x[0]).squaredNorm(), second = (x[3] - x[1]).squaredNorm();
  if (first != second) return first < second;
  const auto lower = [](const Vec3& a, const Vec3& b) {
    return lexicographically_less(a, b) ? a : b;
  };
  return lexicographically_less(lower(x[0], x[2]), lower(x[1], x[3]));
}

std::optional<PolygonTriangles> cut_convex_quadrilateral(std::span<const Vec3> x,
                                                         const FlatView& view, int sign) {
  for (std::size_t i = 0; i < 4; ++i)
    if (sign * view.turn_at(i, (i + 1) % 4, (i + 2) % 4) <= 0) return std::nullopt;
  if (first_diagonal_is_better(x)) return PolygonTriangles{{0, 1, 2}, {0, 2, 3}};
  return PolygonTriangles{{0, 1, 3}, {1, 2, 3}};
}

/// Removes one ear after the other, the one whose new side is shortest first. Meisters' theorem
/// gives a simple polygon two ears; an ear here may hold no other corner even on its rim, so
/// straight corners leave no flat triangle.
PolygonTriangles cut_ears(std::span<const Vec3> x, const FlatView& view, int sign) {
  std::vector<std::size_t> left(x.size());
  std::iota(left.begin(), left.end(), std::size_t{0});

  const auto ear_length = [&](std::size_t k) -> double {
    const std::size_t n = left.size();
    const std::size_t a = left[(k + n - 1) % n], b = left[k], c = left[(k + 1) % n];
    if (sign * view.turn_at(a, b, c) <= 0) return -1.0;
    for (const std::size_t p : left)
      if (p != a && p != b && p != c && view.holds(sign, a, b, c, p)) return -1.0;
    return (x[c] - x[a]).norm();
  };

  // Only the ears at the two neighbours of a removed corner can change their length; a corner that
  // was no ear because another one was in the way is tested again when no ear is left in the list.
  std::vector<double> length;
  for (std::size_t k = 0; k < left.size(); ++k) length.push_back(ear_length(k));
  PolygonTriangles triangles;
  while (left.size() > 3) {
    auto best = length.end();
    for (auto it = length.begin(); it != length.end(); ++it)
      if (*it >= 0.0 && (best == length.end() || *it < *best)) best = it;
    if (best == length.end()) {
      for (std::size_t k = 0; k < left.size(); ++k) length[k] = ear_length(k);
      if (*std::max_element(length.begin(), length.end()) < 0.0) return {};
      continue;
    }
    const auto k = static_cast<std::size_t>(best - length.begin());
    const std::size_t n = left.size();
    triangles.push_back({left[(k + n - 1) % n], left[k], left[(k + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
    length.erase(best);
    for (const std::size_t neighbour : {(k + n - 2) % (n - 1), k % (n - 1)})
      length[neighbour] = ear_length(neighbour);
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

}  // namespace

std::optional<PolygonTriangles> triangulate_polygon(std::span<const Vec3> x) {
  if (x.size() == 3) return PolygonTriangles{{0, 1, 2}};
  if (x.size() > kLargestPolygon) return std::nullopt;
  for (const int axis : axes_by_size(area_vector(x))) {
    const FlatView view(x, Axis{axis});
    const int sign = view.winding();
    if (sign == 0 || !view.is_simple()) continue;
    if (x.size() == 4)
      if (auto triangles = cut_convex_quadrilateral(x, view, sign)) return triangles;
    auto triangles = cut_ears(x, view, sign);
    if (!triangles.empty()) return triangles;
  }
  return std::nullopt;
}

double warp(std::span<const Vec3> x) {
  const Vec3 normal = area_vector(x).stableNormalized();
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : x) mean += (p - x[0]) / static_cast<double>(x.size());
  double largest = 0.0;
  for (const Vec3& p : x) largest = std::max(largest, std::abs((p - x[0] - mean).dot(normal)));
  return largest;
}

}  // namespace plekton::geometry
