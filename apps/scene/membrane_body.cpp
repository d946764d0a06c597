// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scene/membrane_body.hpp"

#include "geometry/base/rotation_about.hpp"
#include "geometry/mesh/edge_table.hpp"
#include "geometry/mesh/io/import.hpp"
#include "geometry/mesh/repair/measures.hpp"
#include "geometry/mesh/repair/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace plekton::apps {
namespace {

using geometry::index_of;
using geometry::Lattice;
using geometry::Membrane;
using geometry::Mesh;
using geometry::NodeId;

void put_in_place(std::vector<Vec3>& points, const Placement& placement) {
  const geometry::Mat3 rotation = geometry::rotation_about(placement.axis, placement.angle);
  for (Vec3& point : points) point = rotation * (placement.scale * point) + placement.translation;
}

/// Mesh files are repaired as they are written, where facets without area are exactly that, so the
/// lengths of the repair follow the file; those of the report follow the scene.
geometry::ImportedMesh import_unscaled(const MembraneSettings& settings) {
  const double scale = settings.placement.scale;
  geometry::ImportOptions import{settings.repair};
  import.repair.weld_distance /= scale;
  import.repair.longest_hole /= scale;
  import.repair.wrap_detail /= scale;
  import.repair.target_edge /= scale;
  const auto scaled = [&](const char* message) {
    return fmt::format("{} (lengths here are before scaling by {})", message, scale);
  };
  try {
    geometry::ImportedMesh imported = geometry::import_mesh(settings.mesh, import);
    if (scale != 1.0) geometry::scale_lengths(imported.report, scale);
    return imported;
  } catch (const geometry::RefusedMesh& error) {
    if (scale == 1.0) throw;
    throw geometry::RefusedMesh(scaled(error.what()), error.failed_step);
  } catch (const geometry::MeshError& error) {
    if (scale == 1.0) throw;
    throw geometry::MeshError(scaled(error.what()));
  }
}

/// Whether each node is on an edge with one facet.
std::vector<bool> rim_of(const Mesh& mesh) {
  const geometry::EdgeTable edges(mesh);
  std::vector<bool> on_rim(mesh.points.size(), false);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges.uses(e).size() != 1) continue;
    for (const NodeId node : edges.edges()[e]) on_rim[index_of(node)] = true;
  }
  return on_rim;
}

double area_of(const Mesh& mesh) {
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.facets) {
    const Vec3& x0 = mesh.points[index_of(a)];
    area += 0.5 * (mesh.points[index_of(b)] - x0).cross(mesh.points[index_of(c)] - x0).norm();
  }
  return area;
}

MembraneBody body_of(Mesh mesh, const MembraneSettings& settings, std::size_t first_node) {
  put_in_place(mesh.points, settings.placement);
  return {geometry::make_membrane(mesh, {settings.thickness, first_node}),
          rim_of(mesh),
          {},
          area_of(mesh),
          std::nullopt};
}

/// A bar that is shorter than thick overlaps more bars than its neighbours.
void warn_about_bars(Membrane& net, const Lattice& lattice, double thickness) {
  std::size_t count = 0;
  double shortest = thickness;
  for (const geometry::LatticeEdge& edge : lattice.edges) {
    const auto [a, b] = edge.nodes;
    const double length = (lattice.points[index_of(b)] - lattice.points[index_of(a)]).norm();
    if (length < thickness) ++count;
    shortest = std::min(shortest, length);
  }
  if (count == 0) return;
  net.warnings.push_back(
      fmt::format("the thickness of {} m exceeds the length of {} of {} bars (shortest {} m); use "
                  "longer bars or a thinner net",
                  thickness, count, lattice.edges.size(), shortest));
}

MembraneBody body_of(Lattice lattice, const MembraneSettings& settings, std::size_t first_node) {
  Vec3 lower = lattice.points.front(), upper = lower;
  for (const Vec3& point : lattice.points) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  MembraneBody body;
  // Rows and columns of a lattice share their coordinates to the last bit.
  for (const Vec3& point : lattice.points)
    body.on_rim.push_back(point[0] == lower[0] || point[0] == upper[0] || point[1] == lower[1] ||
                          point[1] == upper[1]);
  const Vec3 size = settings.placement.scale * (upper - lower);
  body.area = size[0] * size[1];
  put_in_place(lattice.points, settings.placement);
  for (const geometry::Cylinder& bar :
       geometry::cylinders_of(lattice, 0.5 * settings.thickness, first_node))
    body.membrane.edges.push_back(bar.nodes);
  for (const geometry::LatticeEdge& edge : lattice.edges)
    body.is_twist.push_back(edge.part == geometry::LatticePart::twist);
  warn_about_bars(body.membrane, lattice, settings.thickness);
  body.membrane.nodes = std::move(lattice.points);
  return body;
}

Mesh make(const geometry::PlaneSheet& sheet) {
  return geometry::plane_sheet(sheet);
}
Mesh make(const geometry::Polygon& polygon) {
  return geometry::polygon(polygon);
}
Mesh make(const TubeShape& shape) {
  return geometry::closed_tube(shape.tube, shape.is_closed);
}
Mesh make(const SphereShape& sphere) {
  return geometry::icosphere(sphere.radius, sphere.subdivisions);
}
/// Takes out the facets whose nodes are all on one of the sides, and the nodes that are left over.
/// Those of a side have the same coordinate, to the last bit.
Mesh without_sides(const Mesh& box, const std::array<bool, 6>& open) {
  Vec3 lower = box.points.front(), upper = lower;
  for (const Vec3& x : box.points) {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  const auto is_open = [&](const std::array<NodeId, 3>& facet) {
    for (int side = 0; side < 6; ++side) {
      const double level = side % 2 == 0 ? lower[side / 2] : upper[side / 2];
      const bool is_on_it = std::all_of(facet.begin(), facet.end(), [&](NodeId node) {
        return box.points[index_of(node)][side / 2] == level;
      });
      if (open[static_cast<std::size_t>(side)] && is_on_it) return true;
    }
    return false;
  };
  Mesh left;
  std::vector<NodeId> renamed(box.points.size(), NodeId{-1});
  for (std::array<NodeId, 3> facet : box.facets) {
    if (is_open(facet)) continue;
    for (NodeId& node : facet) {
      NodeId& name = renamed[index_of(node)];
      if (name == NodeId{-1}) {
        name = geometry::id_at<NodeId>(left.points.size());
        left.points.push_back(box.points[index_of(node)]);
      }
      node = name;
    }
    left.facets.push_back(facet);
  }
  return left;
}

Mesh make(const BoxShape& box) {
  Mesh whole = geometry::box_shell(box.size, box.cells);
  return is_closed(box) ? whole : without_sides(whole, box.open);
}
Lattice make(const geometry::BiaxialGeogrid& grid) {
  return geometry::biaxial_geogrid(grid);
}
Lattice make(const geometry::UniaxialGeogrid& grid) {
  return geometry::uniaxial_geogrid(grid);
}
Lattice make(const geometry::HexagonalNet& net) {
  return geometry::hexagonal_net(net);
}
Lattice make(const geometry::RingNet& net) {
  return geometry::ring_net(net);
}
Lattice make(const geometry::Chain& chain) {
  return geometry::chain(chain);
}
const Lattice& make(const Lattice& lattice) {
  return lattice;
}

MembraneBody body_of(const FacetShape& shape, const MembraneSettings& settings,
                     std::size_t first_node) {
  MembraneBody body = body_of(shape.mesh, settings, first_node);
  const double angle = geometry::smallest_angle(shape.mesh);
  if (!shape.mesh.facets.empty() && angle < geometry::kSmallAngle)
    body.membrane.warnings.push_back(fmt::format(
        "the smallest angle of a facet is {:.3g} deg; needles make small time steps", angle));
  auto& edges = body.membrane.edges;
  for (const auto& [a, b] : shape.bars)
    edges.push_back({geometry::id_at<NodeId>(index_of(a) + first_node),
                     geometry::id_at<NodeId>(index_of(b) + first_node)});
  std::ranges::sort(edges);
  return body;
}
const FacetShape& make(const FacetShape& shape) {
  return shape;
}

/// Of a chain, and of bars anywhere, the ends are the rim, and there is no area.
void make_ends_the_rim(MembraneBody& body, std::size_t first_node) {
  std::vector<int> links(body.on_rim.size(), 0);
  for (const auto& [a, b] : body.membrane.edges) {
    ++links[index_of(a) - first_node];
    ++links[index_of(b) - first_node];
  }
  for (std::size_t i = 0; i < links.size(); ++i) body.on_rim[i] = links[i] == 1;
  body.area = 0.0;
}

}  // namespace

MembraneBody make_membrane_body(const MembraneSettings& settings, std::size_t first_node) {
  if (settings.shape) {
    MembraneBody body =
        std::visit([&](const auto& shape) { return body_of(make(shape), settings, first_node); },
                   *settings.shape);
    if (is_chain(*settings.shape)) make_ends_the_rim(body, first_node);
    return body;
  }
  geometry::ImportedMesh imported = import_unscaled(settings);
  MembraneBody body = body_of(std::move(imported.mesh), settings, first_node);
  body.report = std::move(imported.report);
  return body;
}

void tell_warnings(const std::string& name, const MembraneBody& body,
                   std::vector<std::string>& warnings) {
  for (const std::string& warning : body.membrane.warnings)
    warnings.push_back(name + ": " + warning);
  if (!body.report) return;
  for (const std::string& reason : body.report->reasons) warnings.push_back(name + ": " + reason);
}

}  // namespace plekton::apps
