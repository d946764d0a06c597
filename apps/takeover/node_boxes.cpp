// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/takeover/node_boxes.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace plekton::apps::yade {
namespace {

using geometry::Box;
using geometry::Vec3;

constexpr double kMargin = 1e-9;  // of the size of all, so that decimals of a text do not matter

bool holds(const Box& box, const Vec3& point) {
  return (point.array() >= box.lower.array()).all() && (point.array() <= box.upper.array()).all();
}

/// Around these points, with a margin.
Box box_of(const std::vector<Vec3>& points, const std::vector<std::size_t>& of, double margin) {
  Box box{points[of.front()], points[of.front()]};
  for (const std::size_t i : of) {
    box.lower = box.lower.cwiseMin(points[i]);
    box.upper = box.upper.cwiseMax(points[i]);
  }
  return {box.lower.array() - margin, box.upper.array() + margin};
}

/// Where to cut a sorted part along an axis: in the gap nearest to the middle that is wider than
/// both margins and rounding, so that no point is in the boxes of both sides. 0: nowhere.
std::size_t cut_of(const std::vector<Vec3>& points, const std::vector<std::size_t>& part,
                   Eigen::Index axis, double margin) {
  const auto from_middle = [&](std::size_t i) {
    return i < part.size() / 2 ? part.size() / 2 - i : i - part.size() / 2;
  };
  std::size_t best = 0;
  for (std::size_t i = 1; i < part.size(); ++i) {
    if (points[part[i]][axis] - points[part[i - 1]][axis] <= 4.0 * margin) continue;
    if (best == 0 || from_middle(i) < from_middle(best)) best = i;
  }
  return best;
}

/// Points by number.
using Part = std::vector<std::size_t>;

/// Covers parts of the points by boxes that hold no others.
class Cover {
 public:
  Cover(const std::vector<Vec3>& points, double margin) : points_(points), margin_(margin) {}

  /// One box if it holds no other point; otherwise those of both sides of a cut across its longest
  /// side.
  /// @param others  that may be in the box: a box of a side is within that of both
  void add(Part part, Part others) {
    const Box box = box_of(points_, part, margin_);
    std::erase_if(others, [&](std::size_t i) { return !holds(box, points_[i]); });
    if (others.empty()) {
      result_.boxes.push_back(box);
      return;
    }
    Eigen::Index axis = 0;
    (box.upper - box.lower).maxCoeff(&axis);
    std::ranges::stable_sort(part, {}, [&](std::size_t i) { return points_[i][axis]; });
    const std::size_t cut = cut_of(points_, part, axis, margin_);
    if (cut == 0) {
      result_.hold_all = false;
      return;
    }
    const auto middle = part.begin() + static_cast<std::ptrdiff_t>(cut);
    add({part.begin(), middle}, others);
    add({middle, part.end()}, std::move(others));
  }

  NodeBoxes result() && { return std::move(result_); }

 private:
  const std::vector<Vec3>& points_;
  double margin_;
  NodeBoxes result_;
};

}  // namespace

NodeBoxes boxes_around(const std::vector<Vec3>& points, const std::vector<bool>& chosen) {
  Part part, others;
  for (std::size_t i = 0; i < points.size(); ++i) (chosen[i] ? part : others).push_back(i);
  if (part.empty()) return {};
  Vec3 lower = points.front(), upper = lower;
  for (const Vec3& point : points) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  Cover cover(points, kMargin * (upper - lower).norm());
  cover.add(std::move(part), std::move(others));
  return std::move(cover).result();
}

}  // namespace plekton::apps::yade
