// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/neighbor/space_order.hpp"

#include <CGAL/Hilbert_sort_median_3.h>

#include <numeric>
#include <utility>

namespace plekton::geometry {
namespace {

/// What CGAL asks of points, with indices of things for points.
struct IndexTraits {
  using Point_3 = std::int32_t;

  template <int kAxis>
  struct Less {
    Positions x;
    std::span<const NodeId> nodes;
    bool operator()(std::int32_t i, std::int32_t j) const noexcept { return key(i) < key(j); }
    std::pair<double, std::int32_t> key(std::int32_t i) const noexcept {
      const double value = x[index_of(nodes[static_cast<std::size_t>(i)])][kAxis];
      return {value == value ? value : 0.0, i};
    }
  };
  using Less_x_3 = Less<0>;
  using Less_y_3 = Less<1>;
  using Less_z_3 = Less<2>;
  Less_x_3 less_x_3_object() const noexcept { return {x, nodes}; }
  Less_y_3 less_y_3_object() const noexcept { return {x, nodes}; }
  Less_z_3 less_z_3_object() const noexcept { return {x, nodes}; }

  Positions x;
  std::span<const NodeId> nodes;
};

}  // namespace

void order_along_curve(Positions x, std::span<const NodeId> nodes,
                       std::vector<std::int32_t>& order) {
  CGAL::Hilbert_sort_median_3<IndexTraits, CGAL::Sequential_tag> sort(IndexTraits{x, nodes});
  sort(order.begin(), order.end());
}

std::vector<std::int32_t> order_along_curve(Positions points) {
  std::vector<NodeId> nodes;
  for (std::size_t i = 0; i < points.size(); ++i) nodes.push_back(id_at<NodeId>(i));
  std::vector<std::int32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  order_along_curve(points, nodes, order);
  return order;
}

}  // namespace plekton::geometry
