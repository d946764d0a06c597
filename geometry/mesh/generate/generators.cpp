// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/generate/generators.hpp"

#include "geometry/base/elementary.hpp"
#include "geometry/mesh/generate/generator_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

namespace plekton::geometry {
namespace {

NodeId add_point(Mesh& mesh, const Vec3& point) {
  mesh.points.push_back(point);
  return id_at<NodeId>(mesh.points.size() - 1);
}

/// Node of a grid with a number of columns.
NodeId grid_node(int i, int j, int columns) {
  return id_at<NodeId>(static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) +
                       static_cast<std::size_t>(i));
}

/// Corners of a cell, counterclockwise.
using CellNodes = std::array<NodeId, 4>;

void cut_cell(Mesh& mesh, const CellNodes& n, bool rising) {
  if (rising) {
    mesh.facets.push_back({n[0], n[1], n[2]});
    mesh.facets.push_back({n[0], n[2], n[3]});
  } else {
    mesh.facets.push_back({n[0], n[1], n[3]});
    mesh.facets.push_back({n[1], n[2], n[3]});
  }
}

void cross_cell(Mesh& mesh, const CellNodes& n) {
  const Vec3 middle = 0.5 * (mesh.points[index_of(n[0])] + mesh.points[index_of(n[2])]);
  const NodeId centre = add_point(mesh, middle);
  for (std::size_t k = 0; k < 4; ++k) mesh.facets.push_back({n[k], n[(k + 1) % 4], centre});
}

Mesh icosahedron() {
  // Corners (0, ±1, ±phi) and their cyclic permutations; facets counterclockwise from outside.
  const double phi = std::numbers::phi;
  Mesh mesh;
  mesh.points = {{-1, phi, 0}, {1, phi, 0}, {-1, -phi, 0}, {1, -phi, 0},
                 {0, -1, phi}, {0, 1, phi}, {0, -1, -phi}, {0, 1, -phi},
                 {phi, 0, -1}, {phi, 0, 1}, {-phi, 0, -1}, {-phi, 0, 1}};
  constexpr std::array<std::array<int, 3>, 20> kFacets = {{
      {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1},
  }};
  for (const auto& [a, b, c] : kFacets) mesh.facets.push_back({NodeId{a}, NodeId{b}, NodeId{c}});
  return mesh;
}

/// Every facet into four, with a node in the middle of every edge.
Mesh subdivide(const Mesh& coarse) {
  Mesh fine{coarse.points, {}};
  std::map<std::pair<NodeId, NodeId>, NodeId> middles;
  const auto middle = [&](NodeId a, NodeId b) {
    const auto [entry, is_new] = middles.try_emplace(std::minmax({a, b}), NodeId{});
    if (is_new)
      entry->second =
          add_point(fine, 0.5 * (coarse.points[index_of(a)] + coarse.points[index_of(b)]));
    return entry->second;
  };
  for (const auto& [a, b, c] : coarse.facets) {
    const NodeId ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const std::array<NodeId, 3>& facet :
         {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
      fine.facets.push_back(facet);
  }
  return fine;
}

/// A side of a box: the cells at a level of an axis.
struct BoxSide {
  std::size_t axis;
  int level;
};

/// @param node  Gives the node at a position in the grid of cells.
template <class NodeAt>
void add_side(Mesh& mesh, const NodeAt& node, const std::array<int, 3>& divisions,
              const BoxSide& side) {
  const std::size_t u = (side.axis + 1) % 3,
                    v = (side.axis + 2) % 3;  // u x v points along the axis.
  const auto corner = [&](int i, int j) {
    std::array<int, 3> ijk{};
    ijk[side.axis] = side.level;
    ijk[u] = i;
    ijk[v] = j;
    return node(ijk);
  };
  for (int i = 0; i < divisions[u]; ++i) {
    for (int j = 0; j < divisions[v]; ++j) {
      CellNodes cell = {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)};
      if (side.level == 0) std::swap(cell[1], cell[3]);
      cut_cell(mesh, cell, true);
    }
  }
}

}  // namespace

Mesh plane_sheet(const PlaneSheet& sheet) {
  require_length(sheet.width, "a sheet width");
  require_length(sheet.length, "a sheet length");
  require_at_least(1, sheet.cells_x, "cells along the width of a sheet");
  require_at_least(1, sheet.cells_y, "cells along the length of a sheet");
  const double nodes_of_cell = sheet.pattern == SheetPattern::cross ? 2.0 : 1.0;
  require_numbers_for(nodes_of_cell * (sheet.cells_x + 1.0) * (sheet.cells_y + 1.0), "a sheet");

  Mesh mesh;
  const int columns = sheet.cells_x + 1;
  for (int j = 0; j <= sheet.cells_y; ++j)
    for (int i = 0; i < columns; ++i)
      add_point(mesh, {sheet.width * (static_cast<double>(i) / sheet.cells_x - 0.5),
                       sheet.length * (static_cast<double>(j) / sheet.cells_y - 0.5), 0.0});
  for (int j = 0; j < sheet.cells_y; ++j) {
    for (int i = 0; i < sheet.cells_x; ++i) {
      const CellNodes nodes = {grid_node(i, j, columns), grid_node(i + 1, j, columns),
                               grid_node(i + 1, j + 1, columns), grid_node(i, j + 1, columns)};
      if (sheet.pattern == SheetPattern::cross)
        cross_cell(mesh, nodes);
      else
        cut_cell(mesh, nodes, sheet.pattern == SheetPattern::diagonal || (i + j) % 2 == 0);
    }
  }
  return mesh;
}

Mesh tube(const Tube& tube) {
  require_length(tube.radius, "a tube radius");
  require_length(tube.length, "a tube length");
  require_at_least(3, tube.around, "cells around a tube");
  require_at_least(1, tube.along, "cells along a tube");
  require_numbers_for(tube.around * (tube.along + 1.0), "a tube");

  Mesh mesh;
  for (int j = 0; j <= tube.along; ++j) {
    for (int i = 0; i < tube.around; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + 0.5 * (j % 2)) / tube.around;
      add_point(mesh, {tube.radius * elementary::cos(angle), tube.radius * elementary::sin(angle),
                       tube.length * j / tube.along});
    }
  }
  for (int j = 0; j < tube.along; ++j) {
    for (int i = 0; i < tube.around; ++i) {
      const int next = (i + 1) % tube.around;
      const CellNodes nodes = {grid_node(i, j, tube.around), grid_node(next, j, tube.around),
                               grid_node(next, j + 1, tube.around),
                               grid_node(i, j + 1, tube.around)};
      // The upper ring is half a cell ahead of an even ring and half a cell behind an odd one.
      cut_cell(mesh, nodes, j % 2 == 1);
    }
  }
  return mesh;
}

Mesh icosphere(double radius, int subdivisions) {
  require_length(radius, "a sphere radius");
  require_at_least(0, subdivisions, "subdivisions of a sphere");
  constexpr int kMost = 12;  // 335 million facets
  if (subdivisions > kMost)
    throw MeshError("subdivisions of a sphere: " + std::to_string(subdivisions) +
                    "; expected at most 12");

  Mesh mesh = icosahedron();
  for (int k = 0; k < subdivisions; ++k) {
    mesh = subdivide(mesh);
    for (Vec3& point : mesh.points) point.normalize();
  }
  for (Vec3& point : mesh.points) point = radius * point.normalized();
  return mesh;
}

Mesh box_shell(const Vec3& size, const std::array<int, 3>& divisions) {
  for (std::size_t k = 0; k < 3; ++k) {
    require_length(size[static_cast<Eigen::Index>(k)], "a box side");
    require_at_least(1, divisions[k], "cells along a box side");
  }
  const Vec3 n(divisions[0], divisions[1], divisions[2]);
  require_numbers_for(2.0 * (n[0] * n[1] + n[1] * n[2] + n[2] * n[0] + 1.0), "a box");
  Mesh mesh;
  std::map<std::array<int, 3>, NodeId> nodes;
  const auto node = [&](const std::array<int, 3>& ijk) {
    const auto [entry, is_new] = nodes.try_emplace(ijk, NodeId{});
    if (is_new)
      entry->second =
          add_point(mesh, {size[0] * ijk[0] / divisions[0], size[1] * ijk[1] / divisions[1],
                           size[2] * ijk[2] / divisions[2]});
    return entry->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int level : {0, divisions[axis]}) add_side(mesh, node, divisions, {axis, level});
  return mesh;
}

}  // namespace plekton::geometry
