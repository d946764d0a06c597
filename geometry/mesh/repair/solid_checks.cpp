// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/solid_checks.hpp"

#include "geometry/mesh/repair/cgal_mesh.hpp"

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>

namespace plekton::geometry {
namespace {

using Facet3 = std::array<NodeId, 3>;

/// Two facets, and whether they meet beyond what they share.
class FacetPair {
 public:
  FacetPair(const std::vector<Kernel::Point_3>& points, Facet3 a, Facet3 b)
      : points_(points), a_(a), b_(b) {
    // Shared nodes to the front of both, in the same order.
    for (std::size_t i = 0; i < 3; ++i) {
      const auto found = std::find(b_.begin() + shared_, b_.end(), a_[i]);
      if (found == b_.end()) continue;
      std::iter_swap(b_.begin() + shared_, found);
      std::swap(a_[static_cast<std::size_t>(shared_)], a_[i]);
      ++shared_;
    }
  }

  bool meet() const {
    const Kernel::Triangle_3 ta(at(a_[0]), at(a_[1]), at(a_[2])),
        tb(at(b_[0]), at(b_[1]), at(b_[2]));
    switch (shared_) {
      case 0:
        return CGAL::do_intersect(ta, tb);
      // The common part is connected and holds the shared node, so if it is more than that it
      // reaches a far side.
      case 1:
        return CGAL::do_intersect(Kernel::Segment_3(at(a_[1]), at(a_[2])), tb) ||
               CGAL::do_intersect(Kernel::Segment_3(at(b_[1]), at(b_[2])), ta);
      // Two planes meet in the shared edge only; in one plane the far nodes must lie on different
      // sides of it.
      default:
        return CGAL::coplanar(at(a_[0]), at(a_[1]), at(a_[2]), at(b_[2])) &&
               CGAL::coplanar_orientation(at(a_[0]), at(a_[1]), at(a_[2]), at(b_[2])) ==
                   CGAL::POSITIVE;
    }
  }

 private:
  const Kernel::Point_3& at(NodeId node) const { return points_[index_of(node)]; }

  const std::vector<Kernel::Point_3>& points_;
  Facet3 a_, b_;
  std::ptrdiff_t shared_ = 0;
};

using FacetBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;

std::vector<FacetBox> boxes_of(const Mesh& mesh, const std::vector<Kernel::Point_3>& points) {
  std::vector<FacetBox> boxes;
  boxes.reserve(mesh.facets.size());
  for (std::uint32_t f = 0; f < mesh.facets.size(); ++f) {
    CGAL::Bbox_3 box;
    for (const NodeId node : mesh.facets[f]) box += points[index_of(node)].bbox();
    boxes.emplace_back(box, f);
  }
  return boxes;
}

}  // namespace

std::vector<std::array<std::uint32_t, 2>> self_intersections(const Mesh& mesh) {
  const auto points = to_cgal(mesh).points;
  auto boxes = boxes_of(mesh, points);
  std::vector<std::array<std::uint32_t, 2>> pairs;
  CGAL::box_self_intersection_d(
      boxes.begin(), boxes.end(), [&](const FacetBox& a, const FacetBox& b) {
        const auto [low, high] =
            std::minmax({a.info(), b.info()});  // By value: info() gives temporaries.
        if (FacetPair(points, mesh.facets[low], mesh.facets[high]).meet())
          pairs.push_back({low, high});
      });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::optional<bool> bounds_volume(const Mesh& mesh) {
  namespace PMP = CGAL::Polygon_mesh_processing;
  const CgalSoup soup = to_cgal(mesh);
  if (soup.triangles.empty() || !PMP::is_polygon_soup_a_polygon_mesh(soup.triangles))
    return std::nullopt;

  SurfaceMesh surface;
  PMP::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, surface);
  // does_bound_a_volume of CGAL 5.5 reads a wild index for a vertex without facets.
  std::vector<CGAL::SM_Vertex_index> unused;
  for (const auto vertex : surface.vertices())
    if (surface.is_isolated(vertex)) unused.push_back(vertex);
  for (const auto vertex : unused) surface.remove_vertex(vertex);
  surface.collect_garbage();
  if (!CGAL::is_closed(surface)) return std::nullopt;
  // Parts that all face the wrong way bound what is around them.
  return PMP::does_bound_a_volume(surface) && PMP::is_outward_oriented(surface);
}

}  // namespace plekton::geometry
