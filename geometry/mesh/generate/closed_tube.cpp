// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/generate/closed_tube.hpp"

#include "geometry/base/elementary.hpp"
#include "geometry/mesh/generate/generator_checks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

namespace plekton::geometry {
namespace {

/// Nodes around an axis, at even angles from that of the first one, counterclockwise.
using Ring = std::vector<NodeId>;

/// A disc over the end of a tube, whose axis is z.
class Disc {
 public:
  /// @param end  of the tube
  Disc(Mesh& mesh, Ring end, bool faces_up)
      : mesh_(mesh), end_(std::move(end)), faces_up_(faces_up) {
    const Vec3& first = mesh_.points[index_of(end_.front())];
    height_ = first.z();
    radius_ = elementary::hypot(first.x(), first.y());
    first_angle_ = elementary::atan2(first.y(), first.x());
  }

  void add() {
    const int rings = rings_of(end_.size());
    Ring outer = end_;
    for (int k = rings - 1; k > 0; --k) {
      Ring inner = add_ring(k, rings);
      join(outer, inner);
      outer = std::move(inner);
    }
    const NodeId middle = add_point(Vec3(0.0, 0.0, height_));
    for (std::size_t i = 0; i < outer.size(); ++i)
      add_facet(outer[i], outer[(i + 1) % outer.size()], middle);
  }

  /// As wide as a cell is around, 2 pi r / n: r over that, of about 2 pi.
  static int rings_of(std::size_t around) {
    return std::max(1, static_cast<int>(std::lround(static_cast<double>(around) / 6.0)));
  }

 private:
  Ring add_ring(int number, int rings) {
    const double share = static_cast<double>(number) / rings;
    const auto nodes =
        static_cast<std::size_t>(std::lround(share * static_cast<double>(end_.size())));
    Ring ring;
    for (std::size_t i = 0; i < nodes; ++i) {
      const double angle = first_angle_ + 2.0 * std::numbers::pi * static_cast<double>(i) /
                                              static_cast<double>(nodes);
      ring.push_back(add_point(Vec3(share * radius_ * elementary::cos(angle),
                                    share * radius_ * elementary::sin(angle), height_)));
    }
    return ring;
  }

  /// Goes around both rings at once, on the one of which the middle of the next side comes first: so
  /// the third corner of a facet is the node nearest to the middle of its side.
  void join(const Ring& outer, const Ring& inner) {
    const std::size_t n = outer.size(), m = inner.size();
    for (std::size_t i = 0, j = 0; i < n || j < m;) {
      if ((2 * i + 1) * m <= (2 * j + 1) * n) {
        add_facet(outer[i], outer[(i + 1) % n], inner[j % m]);
        ++i;
      } else {
        add_facet(inner[(j + 1) % m], inner[j], outer[i % n]);
        ++j;
      }
    }
  }

  NodeId add_point(const Vec3& point) {
    mesh_.points.push_back(point);
    return id_at<NodeId>(mesh_.points.size() - 1);
  }

  /// @param a, b, c  counterclockwise from above
  void add_facet(NodeId a, NodeId b, NodeId c) {
    if (faces_up_)
      mesh_.facets.push_back({a, b, c});
    else
      mesh_.facets.push_back({b, a, c});
  }

  Mesh& mesh_;
  Ring end_;
  bool faces_up_;
  double height_;       // m
  double radius_;       // m
  double first_angle_;  // rad
};

}  // namespace

Mesh closed_tube(const Tube& tube, const std::array<bool, 2>& is_closed) {
  // Both discs have about n² / 6 nodes.
  require_numbers_for(tube.around * (tube.along + 1.0 + tube.around / 6.0), "a closed tube");
  Mesh mesh = geometry::tube(tube);
  const std::array<int, 2> levels = {0, tube.along};
  for (std::size_t end = 0; end < 2; ++end) {
    if (!is_closed[end]) continue;
    Ring ring;
    for (int i = 0; i < tube.around; ++i)
      ring.push_back(id_at<NodeId>(static_cast<std::size_t>(levels[end]) *
                                       static_cast<std::size_t>(tube.around) +
                                   static_cast<std::size_t>(i)));
    Disc(mesh, std::move(ring), end == 1).add();
  }
  return mesh;
}

}  // namespace plekton::geometry
