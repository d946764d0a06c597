// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/primitives/cell_clearance.hpp"

#include <algorithm>
#include <cmath>

namespace plekton::geometry {
namespace {

/// What is left of a squared length (m²) from coordinate differences, and of differences of such,
/// when all rounding is taken off it: they have errors up to 1e-14 of the largest square in them.
constexpr double kRounding = 1e-12;

/// m, a lower bound of the distance to the line along e through a point at w from it.
double line_distance_bound(const Vec3& w, const Vec3& e) noexcept {
  const double along = w.dot(e);
  const double squared = (1.0 - kRounding) * w.squaredNorm() - along * along / e.squaredNorm();
  return squared > 0.0 ? std::sqrt(squared) : 0.0;
}

/// Whether the line along e through a point at w from it is surely farther than range.
bool line_is_beyond(const Vec3& w, const Vec3& e, double range_squared) noexcept {
  const double along = w.dot(e);
  return ((1.0 - kRounding) * w.squaredNorm() - range_squared) * e.squaredNorm() > along * along;
}

/// m, a lower bound of the distance to a segment of a length.
double segment_distance_bound(const Vec3& point, const Vec3& a, const Vec3& b) noexcept {
  const Vec3 e = b - a;
  const Vec3 w = point - a;
  const double along = w.dot(e);
  // Next to an end, where rounding may choose the other formula, both agree within it.
  if (along <= 0.0) return (1.0 - kRounding) * w.norm();
  if (along >= e.squaredNorm()) return (1.0 - kRounding) * (point - b).norm();
  return line_distance_bound(w, e);
}

}  // namespace

/// With the errors of distance_bound(), height - a |w| > range (|n| + a) holds if height² exceeds
/// (1 + d) range² |n|² + (1 + 1 / d) a² (|w| + range)², whatever d > 0 is; d = 1e-6 here.
bool FaceView::is_beyond(double range) const noexcept {
  if (!has_usual_size()) return false;
  constexpr double kSplit = 1e-6;
  const double range_squared = (1.0 + kSplit) * range * range;
  for (std::size_t k = 0; k < 3; ++k) {
    if (is_across(k) && line_is_beyond(offset(k), along(k), range_squared)) return true;
  }
  const double area_error = 1e-14 * length_squared_;
  const double reach_squared = 2.0 * (offset_squared_ + range * range);
  return height_ * height_ >
         range_squared * normal_squared_ + (2.0 / kSplit) * area_error * area_error * reach_squared;
}

double FaceView::distance_bound() const noexcept {
  if (!has_usual_size()) return 0.0;
  // The cross product and the height have errors up to 1e-14 |u||v| and 1e-14 |u||v||w|.
  const double area_error = 1e-14 * length_squared_;
  const double height = std::abs(height_) - area_error * std::sqrt(offset_squared_);
  double bound = height / (std::sqrt(normal_squared_) + area_error);
  for (std::size_t k = 0; k < 3; ++k) {
    if (is_across(k)) bound = std::max(bound, line_distance_bound(offset(k), along(k)));
  }
  return bound;
}

double clearance(const Surface& surface, CellId cell, const Vec3& point, double range,
                 Positions x) noexcept {
  if (index_of(cell) >= surface.face_count()) {
    const auto ends = surface.nodes_of(cell);
    const double bound = segment_distance_bound(point, x[index_of(ends[0])], x[index_of(ends[1])]);
    return (1.0 - kRounding) * bound - range;
  }
  const auto& n = surface.nodes_of(id_at<FaceId>(index_of(cell)));
  const FaceView view(point, {x[index_of(n[0])], x[index_of(n[1])], x[index_of(n[2])]});
  return view.is_beyond(range) ? (1.0 - kRounding) * view.distance_bound() - range : 0.0;
}

}  // namespace plekton::geometry
