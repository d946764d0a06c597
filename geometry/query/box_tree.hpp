// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/box.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace plekton::geometry {

/// A box with a radius (m): what is inside is that much thicker than the box.
struct ThickBox {
  Box box;
  double radius;
};

/// A tree over thick boxes that stay in their places among each other, four to a node, for searches
/// that go down nearest first. It decides nothing: a search looks at every item whose box it cannot
/// rule out, so the shape of the tree has no say in an answer.
///
/// With n boxes rebuild takes O(n log n), refit O(n); a node takes 256 bytes, and there are about
/// n / 3. Coordinates must be finite and below 1e75 m.
class BoxTree {
 public:
  static constexpr std::size_t kLanes = 4;
  /// Entries that a search which goes down may have to remember: three of every level.
  static constexpr std::size_t kMostEntries = 64;
  using Row = std::array<double, kLanes>;

  /// A child: another node, an item, or nothing.
  struct Child {
    std::int32_t place;

    bool is_item() const noexcept { return place < 0; }
    bool exists() const noexcept { return place != kNothing; }
    std::int32_t item() const noexcept { return ~place; }
    static constexpr std::int32_t kNothing = std::numeric_limits<std::int32_t>::min();
  };

  struct alignas(64) Node {
    std::array<Row, 3> lower;  ///< m, by axis; infinite for a child that is not there
    std::array<Row, 3> upper;  ///< m, by axis; minus infinite
    Row radius;                ///< m, the largest below
    std::array<Child, kLanes> child;

    Box box(std::size_t lane) const noexcept {
      const auto corner = [lane](const std::array<Row, 3>& rows) {
        return Vec3(rows[0][lane], rows[1][lane], rows[2][lane]);
      };
      return {corner(lower), corner(upper)};
    }
    /// Squared distances (m²) of all children's boxes from another; 0 if they overlap, infinite of
    /// nothing. Each is within 8 ulps.
    Row squared_distances(const Box& from) const noexcept;
  };

  /// A box's place in the span is its item from now on.
  void rebuild(std::span<const ThickBox> boxes);

  /// Moves the boxes. The further they have wandered among each other since the last rebuild, the
  /// longer searches take.
  void refit(std::span<const ThickBox> boxes);

  bool is_empty() const noexcept { return nodes_.empty(); }
  const Node& root() const noexcept { return nodes_.front(); }
  const Node& node(Child child) const noexcept {
    return nodes_[static_cast<std::size_t>(child.place)];
  }

  /// Calls visit(item) for every item whose box, radius included, overlaps another one, in any
  /// order. May call it for some that do not.
  template <class Visit>
  void for_each_near(const Box& box, Visit visit) const;

  /// Calls visit(item) for items whose boxes, radius left out, are no further from another box than
  /// a length: about the nearest first, so that visits which lower the length find the nearest item
  /// in O(log n), if few are as near as it.
  /// @param least  m; infinite at first
  template <class Visit>
  void for_each_nearer(const Box& from, const double& least, Visit visit) const;

 private:
  /// The middle of a box in the tree's own units, for sorting.
  struct Centre {
    std::array<float, 3> x;
    std::int32_t item;
  };

  std::int32_t build(std::span<Centre> centres);
  void fit(std::span<const ThickBox> boxes);

  std::vector<Node> nodes_;  ///< children behind their parents
};

inline BoxTree::Row BoxTree::Node::squared_distances(const Box& from) const noexcept {
  Row sum{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double least = from.lower[static_cast<int>(axis)];
    const double greatest = from.upper[static_cast<int>(axis)];
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double below = lower[axis][lane] - greatest;
      const double above = least - upper[axis][lane];
      const double more = below > above ? below : above;
      const double apart = more > 0.0 ? more : 0.0;
      sum[lane] += apart * apart;
    }
  }
  return sum;
}

template <class Visit>
void BoxTree::for_each_near(const Box& box, Visit visit) const {
  if (is_empty()) return;
  std::array<const Node*, kMostEntries> open;
  std::size_t count = 0;
  open[count++] = &root();
  while (count > 0) {
    const Node& at = *open[--count];
    const Row squared = at.squared_distances(box);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double reach = at.radius[lane];
      if (squared[lane] > reach * reach * (1.0 + 1e-12)) continue;
      const Child child = at.child[lane];
      if (child.is_item())
        visit(child.item());
      else
        open[count++] = &node(child);
    }
  }
}

template <class Visit>
void BoxTree::for_each_nearer(const Box& from, const double& least, Visit visit) const {
  if (is_empty()) return;
  struct Entry {
    double squared;  ///< m²
    Child child;
  };
  std::array<Entry, kMostEntries> open;
  std::size_t count = 0;
  const auto is_beyond = [&least](double squared) {
    return squared * (1.0 - 1e-12) > least * least;
  };
  const auto open_children = [&](const Node& of) {
    const Row squared = of.squared_distances(from);
    const std::size_t first = count;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (!of.child[lane].exists() || is_beyond(squared[lane])) continue;
      std::size_t k = count++;
      for (; k > first && open[k - 1].squared < squared[lane]; --k) open[k] = open[k - 1];
      open[k] = {squared[lane], of.child[lane]};
    }
  };
  open_children(root());
  while (count > 0) {
    const Entry entry = open[--count];
    if (is_beyond(entry.squared)) continue;
    if (entry.child.is_item())
      visit(entry.child.item());
    else
      open_children(node(entry.child));
  }
}

}  // namespace plekton::geometry
