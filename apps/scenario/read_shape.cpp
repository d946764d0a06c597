// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/closest_word.hpp"
#include "apps/scenario/read_membrane_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace plekton::apps {
namespace {

using geometry::NodeId;

constexpr int kMostCells = 100'000;  // along one direction
/// Of a shape. A facet with its share of nodes and beams takes 1.7 kB in a run, so this is 10 GB.
constexpr double kMostElements = 6e6;
constexpr int kMostSubdivisions = 9;  // 5.2 million facets
constexpr Quantity kPositiveLength{kLength, kPositive};

/// Complains about numbers of cells whose product asks for more than a computer holds.
/// @param elements  Facets or bars, about.
void require_few(Section& section, std::string_view key, double elements) {
  if (elements > kMostElements)
    section.complain(key, fmt::format("asks for about {:.2g} facets or bars; expected at most "
                                      "{:.0e}, which take about 10 GB; use fewer and larger ones",
                                      elements, kMostElements));
}

ShapeSettings read_sheet(Section& section) {
  constexpr std::array<std::string_view, 3> kPatterns = {"diagonal", "alternating", "cross"};
  geometry::PlaneSheet sheet{};
  sheet.width = section.quantity("width", kPositiveLength);
  sheet.length = section.quantity("length", kPositiveLength);
  const auto cells = section.integers("cells", {1, 1}, kMostCells);
  sheet.cells_x = cells[0];
  sheet.cells_y = cells[1];
  sheet.pattern =
      static_cast<geometry::SheetPattern>(section.choice("pattern", kPatterns, std::size_t{1}));
  const double facets_of_cell = sheet.pattern == geometry::SheetPattern::cross ? 4.0 : 2.0;
  require_few(section, "cells", facets_of_cell * cells[0] * cells[1]);
  return sheet;
}

ShapeSettings read_polygon(Section& section) {
  return geometry::Polygon{section.vectors("points", {kLength}, 3)};
}

/// Which of the sides of a shape a key names.
template <std::size_t N>
std::array<bool, N> read_sides(Section& section, std::string_view key,
                               const std::array<std::string_view, N>& sides) {
  std::array<bool, N> named{};
  if (!section.has(key)) return named;
  for (const std::string& side : section.texts(key)) {
    const auto found = std::find(sides.begin(), sides.end(), side);
    if (found == sides.end())
      section.complain(
          key, fmt::format("there is no side \"{}\"; the sides are {}", side, listed(sides)));
    else
      named[static_cast<std::size_t>(found - sides.begin())] = true;
  }
  return named;
}

ShapeSettings read_tube(Section& section) {
  TubeShape shape{};
  shape.tube.radius = section.quantity("radius", kPositiveLength);
  shape.tube.length = section.quantity("length", kPositiveLength);
  const auto cells = section.integers("cells", {3, 1}, kMostCells);
  shape.tube.around = cells[0];
  shape.tube.along = cells[1];
  shape.is_closed = read_sides<2>(section, "closed", {"z_min", "z_max"});
  // A disc has about n² / 6 facets.
  const double discs = static_cast<double>(std::ranges::count(shape.is_closed, true));
  require_few(section, "cells", cells[0] * (2.0 * cells[1] + discs * cells[0] / 6.0));
  return shape;
}

ShapeSettings read_sphere(Section& section) {
  const double radius = section.quantity("radius", kPositiveLength);
  return SphereShape{radius,
                     static_cast<int>(section.integer("subdivisions", 0, kMostSubdivisions))};
}

/// Sides that are left out.
std::array<bool, 6> read_open_sides(Section& section) {
  constexpr std::array<std::string_view, 6> kSides = {"x_min", "x_max", "y_min",
                                                      "y_max", "z_min", "z_max"};
  const std::array<bool, 6> open = read_sides(section, "open", kSides);
  if (std::find(open.begin(), open.end(), false) == open.end())
    section.complain("open", "names all sides, so that nothing is left of the box");
  return open;
}

ShapeSettings read_box_shell(Section& section) {
  BoxShape box{section.vector("size", kPositiveLength), {1, 1, 1}};
  box.open = read_open_sides(section);
  section.tell_default("cells", "[1, 1, 1]");
  if (section.has("cells")) {
    const auto cells = section.integers("cells", {1, 1, 1}, kMostCells);
    box.cells = {cells[0], cells[1], cells[2]};
  }
  const Vec3 n(box.cells[0], box.cells[1], box.cells[2]);
  require_few(section, "cells", 4.0 * (n[0] * n[1] + n[1] * n[2] + n[2] * n[0]));
  return box;
}

ShapeSettings read_biaxial(Section& section) {
  geometry::BiaxialGeogrid grid{};
  grid.pitch_x = section.quantity("rib_pitch", kPositiveLength);
  grid.pitch_y = section.quantity("bar_pitch", kPositiveLength);
  const auto apertures = section.integers("apertures", {1, 1}, kMostCells);
  grid.apertures_x = apertures[0];
  grid.apertures_y = apertures[1];
  grid.rib_divisions =
      static_cast<int>(section.integer("divisions", 1, kMostCells, grid.rib_divisions));
  require_few(section, "apertures", 2.0 * apertures[0] * apertures[1] * grid.rib_divisions);
  return grid;
}

ShapeSettings read_uniaxial(Section& section) {
  geometry::UniaxialGeogrid grid{};
  grid.rib_pitch = section.quantity("rib_pitch", kPositiveLength);
  grid.bar_pitch = section.quantity("bar_pitch", kPositiveLength);
  const auto apertures = section.integers("apertures", {1, 1}, kMostCells);
  grid.apertures_x = apertures[0];
  grid.apertures_y = apertures[1];
  grid.rib_divisions =
      static_cast<int>(section.integer("divisions", 1, kMostCells, grid.rib_divisions));
  require_few(section, "apertures", (1.0 + grid.rib_divisions) * apertures[0] * apertures[1]);
  if (grid.bar_pitch <= grid.rib_pitch) {
    section.complain("bar_pitch",
                     fmt::format("{} m is not above the rib_pitch of {} m; the long side of an "
                                 "aperture is along the ribs; exchange them, or use kind = "
                                 "\"biaxial_geogrid\"",
                                 grid.bar_pitch, grid.rib_pitch));
  }
  return grid;
}

ShapeSettings read_hexagonal(Section& section) {
  geometry::HexagonalNet net{};
  net.mesh_size = section.quantity("mesh_size", kPositiveLength);
  net.twist_length = section.quantity("twist_length", kPositiveLength);
  net.wire_height = section.quantity("wire_height", kPositiveLength);
  const auto meshes = section.integers("meshes", {2, 1}, kMostCells);
  net.meshes_across = meshes[0];
  net.rows = meshes[1];
  require_few(section, "meshes", 3.0 * meshes[0] * meshes[1]);
  return net;
}

ShapeSettings read_ring_net(Section& section) {
  geometry::RingNet net{};
  net.ring_diameter = section.quantity("ring_diameter", kPositiveLength);
  const auto rings = section.integers("rings", {1, 1}, kMostCells);
  net.rings_x = rings[0];
  net.rings_y = rings[1];
  net.arc_divisions =
      static_cast<int>(section.integer("divisions", 1, kMostCells, net.arc_divisions));
  require_few(section, "rings", 4.0 * rings[0] * rings[1] * net.arc_divisions);
  return net;
}

ShapeSettings read_chain(Section& section) {
  geometry::Chain chain;
  chain.points = section.vectors("points", {kLength}, 2);
  chain.divisions = static_cast<int>(section.integer("divisions", 1, kMostCells, chain.divisions));
  require_few(section, "divisions", static_cast<double>(chain.points.size()) * chain.divisions);
  return chain;
}

/// Rows of the key bars between so many points, sorted.
std::vector<std::array<NodeId, 2>> read_pairs(Section& section, std::size_t points) {
  std::vector<std::array<NodeId, 2>> bars;
  const auto ends = section.places("bars", 2, points);
  for (std::size_t i = 0; i < ends.size(); i += 2) {
    const auto [low, high] = std::minmax(ends[i], ends[i + 1]);
    bars.push_back({NodeId{low}, NodeId{high}});
  }
  std::ranges::sort(bars);
  const auto twice = std::ranges::adjacent_find(bars);
  if (twice != bars.end())
    section.complain("bars",
                     fmt::format("two are between the points {} and {}; leave one out",
                                 geometry::index_of((*twice)[0]), geometry::index_of((*twice)[1])));
  require_few(section, "bars", static_cast<double>(bars.size()));
  return bars;
}

/// Bars beside facets, whose sides are bars already.
std::vector<std::array<NodeId, 2>> read_bars_beside(Section& section, const geometry::Mesh& mesh) {
  std::vector<std::array<NodeId, 2>> bars = read_pairs(section, mesh.points.size());
  for (const auto& [a, b, c] : mesh.facets) {
    for (const auto& [first, second] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
      const std::array<NodeId, 2> side{std::min(first, second), std::max(first, second)};
      if (!std::ranges::binary_search(bars, side)) continue;
      section.complain("bars",
                       fmt::format("the one between the points {} and {} is a side of a "
                                   "facet, which is a bar already; leave it out",
                                   geometry::index_of(side[0]), geometry::index_of(side[1])));
      return bars;
    }
  }
  return bars;
}

void refuse_same_corners(Section& section, const geometry::Mesh& mesh) {
  std::vector<std::pair<std::array<NodeId, 3>, std::size_t>> all;
  for (const std::array<NodeId, 3>& facet : mesh.facets) {
    all.emplace_back(facet, all.size());
    std::ranges::sort(all.back().first);
  }
  std::ranges::sort(all);
  const auto same = std::ranges::adjacent_find(
      all, [](const auto& a, const auto& b) { return a.first == b.first; });
  if (same == all.end()) return;
  section.complain("facets", fmt::format("facet {} has the same corners as facet {}; leave one out",
                                         std::next(same)->second, same->second));
}

ShapeSettings read_facets(Section& section) {
  FacetShape shape;
  geometry::Mesh& mesh = shape.mesh;
  mesh.points = section.vectors("points", {kLength}, 3);
  const auto corners = section.places("facets", 3, mesh.points.size());
  for (std::size_t i = 0; i < corners.size(); i += 3)
    mesh.facets.push_back({NodeId{corners[i]}, NodeId{corners[i + 1]}, NodeId{corners[i + 2]}});
  require_few(section, "facets", static_cast<double>(mesh.facets.size()));
  refuse_same_corners(section, mesh);
  if (section.has("bars")) shape.bars = read_bars_beside(section, mesh);
  return shape;
}

/// Sorted, as the bars of every lattice.
ShapeSettings read_bars(Section& section) {
  geometry::Lattice lattice;
  lattice.points = section.vectors("points", {kLength}, 2);
  for (const auto& bar : read_pairs(section, lattice.points.size()))
    lattice.edges.push_back({bar, geometry::LatticePart::link});
  return lattice;
}

constexpr std::array<std::string_view, 12> kShapeKinds = {
    "sheet",         "polygon",  "tube",  "sphere", "box", "biaxial_geogrid", "uniaxial_geogrid",
    "hexagonal_net", "ring_net", "chain", "facets", "bars"};
constexpr std::array<ShapeSettings (*)(Section&), 12> kReaders = {
    read_sheet,    read_polygon,   read_tube,     read_sphere, read_box_shell, read_biaxial,
    read_uniaxial, read_hexagonal, read_ring_net, read_chain,  read_facets,    read_bars};

}  // namespace

std::optional<ShapeSettings> read_shape(Section section) {
  const auto kind = section.known_choice("kind", kShapeKinds);
  if (!kind) return std::nullopt;
  ShapeSettings shape = kReaders[*kind](section);
  section.finish();
  return shape;
}

}  // namespace plekton::apps
