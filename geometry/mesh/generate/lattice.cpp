// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/generate/lattice.hpp"

#include "geometry/base/elementary.hpp"
#include "geometry/mesh/generate/generator_checks.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace plekton::geometry {
namespace {

NodeId add_point(Lattice& lattice, const Vec3& point) {
  lattice.points.push_back(point);
  return id_at<NodeId>(lattice.points.size() - 1);
}

void add_edge(Lattice& lattice, NodeId a, NodeId b, LatticePart part) {
  lattice.edges.push_back({{std::min(a, b), std::max(a, b)}, part});
}

/// Joins two nodes by a straight row of elements with new nodes between them.
void add_row(Lattice& lattice, std::array<NodeId, 2> ends, int divisions, LatticePart part) {
  const Vec3 x0 = lattice.points[index_of(ends[0])], x1 = lattice.points[index_of(ends[1])];
  NodeId last = ends[0];
  for (int k = 1; k < divisions; ++k) {
    const NodeId next = add_point(lattice, x0 + (static_cast<double>(k) / divisions) * (x1 - x0));
    add_edge(lattice, last, next, part);
    last = next;
  }
  add_edge(lattice, last, ends[1], part);
}

/// Edges in ascending order, the plane's middle at the origin.
Lattice finished(Lattice lattice) {
  std::sort(lattice.edges.begin(), lattice.edges.end(),
            [](const LatticeEdge& a, const LatticeEdge& b) { return a.nodes < b.nodes; });
  Vec3 lower = lattice.points.front(), upper = lower;
  for (const Vec3& point : lattice.points) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  const Vec3 middle = 0.5 * (lower + upper);
  for (Vec3& point : lattice.points) point -= middle;
  return lattice;
}

/// A grid of junctions, joined along both axes.
struct Grid {
  double pitch_x, pitch_y;
  int apertures_x, apertures_y;
  int rib_divisions, bar_divisions;
};

Lattice rectangular(const Grid& grid) {
  require_length(grid.pitch_x, "a pitch of ribs");
  require_length(grid.pitch_y, "a pitch of bars");
  require_at_least(1, grid.apertures_x, "apertures of a geogrid along x");
  require_at_least(1, grid.apertures_y, "apertures of a geogrid along y");
  require_at_least(1, grid.rib_divisions, "elements of a rib");
  require_numbers_for((grid.apertures_x + 1.0) * (grid.apertures_y + 1.0) *
                          (grid.rib_divisions + static_cast<double>(grid.bar_divisions)),
                      "a geogrid");
  Lattice lattice;
  const auto junction = [&](int i, int j) {
    return id_at<NodeId>(static_cast<std::size_t>(j) *
                             static_cast<std::size_t>(grid.apertures_x + 1) +
                         static_cast<std::size_t>(i));
  };
  for (int j = 0; j <= grid.apertures_y; ++j)
    for (int i = 0; i <= grid.apertures_x; ++i)
      add_point(lattice, {i * grid.pitch_x, j * grid.pitch_y, 0.0});
  for (int j = 0; j <= grid.apertures_y; ++j) {
    for (int i = 0; i <= grid.apertures_x; ++i) {
      if (i < grid.apertures_x)
        add_row(lattice, {junction(i, j), junction(i + 1, j)}, grid.bar_divisions,
                LatticePart::bar);
      if (j < grid.apertures_y)
        add_row(lattice, {junction(i, j), junction(i, j + 1)}, grid.rib_divisions,
                LatticePart::rib);
    }
  }
  return finished(std::move(lattice));
}

/// A row of nodes across a net: every node at a multiple of D, or half of D beside it.
struct NetRow {
  int first;  ///< position of the first node, in halves of D
  std::vector<NodeId> nodes;
};

NetRow add_net_row(Lattice& lattice, const HexagonalNet& net, int first, int count, double y) {
  NetRow row{first, {}};
  for (int i = 0; i < count; ++i)
    row.nodes.push_back(add_point(lattice, {0.5 * (first + 2 * i) * net.mesh_size, y, 0.0}));
  return row;
}

/// Single wires between nodes of two rows, each to those half a mesh to its left and right. The
/// rows are half a mesh apart themselves, so the halves of D between their firsts are odd.
void add_wires(Lattice& lattice, const NetRow& lower, const NetRow& upper) {
  const auto count = static_cast<std::ptrdiff_t>(upper.nodes.size());
  for (std::size_t i = 0; i < lower.nodes.size(); ++i) {
    const std::ptrdiff_t halves = lower.first - upper.first + 2 * static_cast<std::ptrdiff_t>(i);
    for (const std::ptrdiff_t k : {(halves - 1) / 2, (halves + 1) / 2}) {
      if (k < 0 || k >= count) continue;
      add_edge(lattice, lower.nodes[i], upper.nodes[static_cast<std::size_t>(k)],
               LatticePart::wire);
    }
  }
}

/// The four arcs of a ring between its joints, counterclockwise from the one along x.
void add_ring(Lattice& lattice, const Vec3& centre, const std::array<NodeId, 4>& joints,
              int divisions) {
  for (std::size_t quarter = 0; quarter < 4; ++quarter) {
    const NodeId end = joints[(quarter + 1) % 4];
    const Vec3 from = lattice.points[index_of(joints[quarter])] - centre;
    const Vec3 to = lattice.points[index_of(end)] - centre;
    NodeId last = joints[quarter];
    for (int k = 1; k < divisions; ++k) {
      const double angle = k * (std::numbers::pi / 2.0) / divisions;
      const NodeId next =
          add_point(lattice, centre + elementary::cos(angle) * from + elementary::sin(angle) * to);
      add_edge(lattice, last, next, LatticePart::ring);
      last = next;
    }
    add_edge(lattice, last, end, LatticePart::ring);
  }
}

}  // namespace

Lattice biaxial_geogrid(const BiaxialGeogrid& grid) {
  return rectangular({grid.pitch_x, grid.pitch_y, grid.apertures_x, grid.apertures_y,
                      grid.rib_divisions, grid.rib_divisions});
}

Lattice uniaxial_geogrid(const UniaxialGeogrid& grid) {
  if (!(grid.bar_pitch > grid.rib_pitch))
    throw MeshError("a uniaxial geogrid with bars " + std::to_string(grid.bar_pitch) +
                    " m apart and ribs " + std::to_string(grid.rib_pitch) +
                    " m apart; expected a larger pitch of the bars (y is the long side of an "
                    "aperture); exchange them or use a biaxial geogrid");
  return rectangular(
      {grid.rib_pitch, grid.bar_pitch, grid.apertures_x, grid.apertures_y, grid.rib_divisions, 1});
}

Lattice hexagonal_net(const HexagonalNet& net) {
  require_length(net.mesh_size, "a mesh size");
  require_length(net.twist_length, "a twist length");
  require_length(net.wire_height, "a height of a single wire");
  require_at_least(2, net.meshes_across, "meshes across a net");
  require_at_least(1, net.rows, "rows of a net");
  require_numbers_for((net.meshes_across + 1.0) * (2.0 * net.rows + 2.0), "a net");

  // Rows of twists are n + 1 and n long by turns; the border rows are nodes where two wires meet.
  Lattice lattice;
  const int n = net.meshes_across;
  NetRow below = add_net_row(lattice, net, 1, n, 0.0);
  double y = net.wire_height;
  for (int r = 0; r < net.rows; ++r) {
    const int first = r % 2, count = n + 1 - first;
    const NetRow lower = add_net_row(lattice, net, first, count, y);
    add_wires(lattice, below, lower);
    y += net.twist_length;
    below = add_net_row(lattice, net, first, count, y);
    for (std::size_t i = 0; i < below.nodes.size(); ++i)
      add_edge(lattice, lower.nodes[i], below.nodes[i], LatticePart::twist);
    y += net.wire_height;
  }
  // Between the twists of the last row.
  const int count = static_cast<int>(below.nodes.size()) - 1;
  add_wires(lattice, below, add_net_row(lattice, net, below.first + 1, count, y));
  return finished(std::move(lattice));
}

Lattice ring_net(const RingNet& net) {
  require_length(net.ring_diameter, "a diameter of rings");
  require_at_least(1, net.rings_x, "rings of a net along x");
  require_at_least(1, net.rings_y, "rings of a net along y");
  require_at_least(1, net.arc_divisions, "elements of a quarter of a ring");
  require_numbers_for(4.0 * net.arc_divisions * net.rings_x * net.rings_y +
                          static_cast<double>(net.rings_x) + net.rings_y,
                      "a ring net");
  Lattice lattice;
  const double radius = 0.5 * net.ring_diameter;
  const auto columns = static_cast<std::size_t>(net.rings_x);
  const auto add_joint = [&](int x, int y) {  // in radii
    return add_point(lattice, {x * radius, y * radius, 0.0});
  };
  std::vector<NodeId> below;  // joints with the row below, by column
  for (int i = 0; i < net.rings_x; ++i) below.push_back(add_joint(2 * i + 1, 0));
  for (int j = 0; j < net.rings_y; ++j) {
    NodeId left = add_joint(0, 2 * j + 1);
    for (std::size_t i = 0; i < columns; ++i) {
      const int x = 2 * static_cast<int>(i) + 1, y = 2 * j + 1;
      const NodeId right = add_joint(x + 1, y), above = add_joint(x, y + 1);
      const Vec3 centre(x * radius, y * radius, 0.0);
      add_ring(lattice, centre, {right, above, left, below[i]}, net.arc_divisions);
      left = right;
      below[i] = above;
    }
  }
  return finished(std::move(lattice));
}

std::vector<Cylinder> cylinders_of(const Lattice& lattice, double radius, std::size_t first_node) {
  require_length(radius, "a radius of bars");
  constexpr auto kMostNodes = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  if (first_node > kMostNodes || lattice.points.size() > kMostNodes - first_node)
    throw MeshError("a lattice of " + std::to_string(lattice.points.size()) +
                    " nodes from number " + std::to_string(first_node) +
                    " on; the numbers of nodes end at 2147483647");
  std::vector<Cylinder> cylinders;
  cylinders.reserve(lattice.edges.size());
  for (const auto& [nodes, part] : lattice.edges)
    cylinders.push_back({{id_at<NodeId>(index_of(nodes[0]) + first_node),
                          id_at<NodeId>(index_of(nodes[1]) + first_node)},
                         radius});
  return cylinders;
}

}  // namespace plekton::geometry
