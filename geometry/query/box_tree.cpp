// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/box_tree.hpp"

#include <algorithm>

namespace plekton::geometry {
namespace {

using Row = BoxTree::Row;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Row row_of(double number) {
  Row row;
  row.fill(number);
  return row;
}

BoxTree::Node empty_node() {
  BoxTree::Node node{};
  node.lower.fill(row_of(kInfinity));
  node.upper.fill(row_of(-kInfinity));
  node.child.fill({BoxTree::Child::kNothing});
  return node;
}

/// How many items the children of a node hold if all but the last are full.
///
/// Items are dealt in units that fill a grandchild, so that nodes further down are full, and the
/// children are of one size to a unit.
std::array<std::size_t, BoxTree::kLanes + 1> shares(std::size_t count) {
  constexpr std::size_t kLanes = BoxTree::kLanes;
  std::size_t capacity = 1;
  while (capacity * kLanes < count) capacity *= kLanes;
  const std::size_t unit = std::max<std::size_t>(1, capacity / kLanes);
  const std::size_t units = (count + unit - 1) / unit;
  const std::size_t children = (count + capacity - 1) / capacity;
  std::array<std::size_t, kLanes + 1> begin{};
  for (std::size_t k = 0; k <= kLanes; ++k)
    begin[k] = std::min(count, unit * (units * std::min(k, children) / children));
  return begin;
}

}  // namespace

void BoxTree::rebuild(std::span<const ThickBox> boxes) {
  nodes_.clear();
  if (boxes.empty()) return;
  Vec3 lower = boxes.front().box.lower, upper = boxes.front().box.upper;
  for (const auto& [box, radius] : boxes) {
    lower = lower.cwiseMin(box.lower);
    upper = upper.cwiseMax(box.upper);
  }
  // A float is enough to sort by, but not wide enough for every coordinate.
  const double size = (upper - lower).maxCoeff();
  const double scale = size > 0.0 ? 0.5 / size : 0.0;
  std::vector<Centre> centres(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box& box = boxes[i].box;
    const Vec3 middle = ((box.lower - lower) + (box.upper - lower)) * scale;
    for (std::size_t axis = 0; axis < 3; ++axis)
      centres[i].x[axis] = static_cast<float>(middle[static_cast<int>(axis)]);
    centres[i].item = static_cast<std::int32_t>(i);
  }
  nodes_.reserve(boxes.size() / 2 + 1);
  build(centres);
  fit(boxes);
}

namespace {

/// The axis along which centres spread most.
template <class Centre>
std::size_t widest_axis(std::span<const Centre> centres) {
  std::array<float, 3> least = centres.front().x, most = least;
  for (const Centre& centre : centres) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      least[axis] = std::min(least[axis], centre.x[axis]);
      most[axis] = std::max(most[axis], centre.x[axis]);
    }
  }
  const auto width = [&](std::size_t axis) { return most[axis] - least[axis]; };
  const std::size_t wider = width(1) > width(0) ? 1 : 0;
  return width(2) > width(wider) ? 2 : wider;
}

/// Puts those that are least along the widest axis first.
template <class Centre>
void halve(std::span<Centre> centres, std::size_t first_half) {
  if (first_half == 0 || first_half >= centres.size()) return;
  const std::size_t axis = widest_axis(std::span<const Centre>(centres));
  std::nth_element(centres.begin(), centres.begin() + static_cast<std::ptrdiff_t>(first_half),
                   centres.end(),
                   [axis](const Centre& p, const Centre& q) { return p.x[axis] < q.x[axis]; });
}

}  // namespace

/// @returns the place of the node over some centres
std::int32_t BoxTree::build(std::span<Centre> centres) {
  const auto place = static_cast<std::int32_t>(nodes_.size());
  nodes_.push_back(empty_node());
  const auto begin = shares(centres.size());
  if (centres.size() > kLanes) {
    halve(centres, begin[2]);
    halve(centres.first(begin[2]), begin[1]);
    halve(centres.subspan(begin[2]), begin[3] - begin[2]);
  }
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const auto part = centres.subspan(begin[lane], begin[lane + 1] - begin[lane]);
    if (part.empty()) continue;
    const std::int32_t child = part.size() == 1 ? ~part.front().item : build(part);
    nodes_[static_cast<std::size_t>(place)].child[lane] = {child};
  }
  return place;
}

void BoxTree::refit(std::span<const ThickBox> boxes) {
  fit(boxes);
}

void BoxTree::fit(std::span<const ThickBox> boxes) {
  for (std::size_t place = nodes_.size(); place-- > 0;) {
    Node& node = nodes_[place];
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const Child child = node.child[lane];
      if (!child.exists()) continue;
      if (child.is_item()) {
        const auto& [box, radius] = boxes[static_cast<std::size_t>(child.item())];
        for (std::size_t axis = 0; axis < 3; ++axis) {
          node.lower[axis][lane] = box.lower[static_cast<int>(axis)];
          node.upper[axis][lane] = box.upper[static_cast<int>(axis)];
        }
        node.radius[lane] = radius;
        continue;
      }
      const Node& below = nodes_[static_cast<std::size_t>(child.place)];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        node.lower[axis][lane] =
            *std::min_element(below.lower[axis].begin(), below.lower[axis].end());
        node.upper[axis][lane] =
            *std::max_element(below.upper[axis].begin(), below.upper[axis].end());
      }
      node.radius[lane] = *std::max_element(below.radius.begin(), below.radius.end());
    }
  }
}

}  // namespace plekton::geometry
