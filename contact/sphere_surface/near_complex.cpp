// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/near_complex.hpp"

#include "geometry/critical/descent.hpp"

#include <algorithm>
#include <numeric>

namespace plekton::contact {
namespace {

using geometry::CellId;
using geometry::EdgeId;
using geometry::FaceId;
using geometry::FeatureKind;
using geometry::NodeId;
using geometry::Surface;

}  // namespace

void NearComplex::build(const Surface& surface, const Vec3& point, double range,
                        std::span<const CellId> cells, Positions x) {
  list_cells(surface, cells);
  find_feet(surface, point, range, x);
  number_vertices();
  start_levels();
  list_links(surface);
  list_fillings(surface);
}

/// The cells, their sides and their nodes.
void NearComplex::list_cells(const Surface& surface, std::span<const CellId> cells) {
  cells_.clear();
  const auto add = [&](Feature feature) { cells_.push_back({feature, feature, 0}); };
  for (const CellId cell : cells) {
    const Feature feature = surface.feature_of(cell);
    add(feature);
    if (feature.kind == FeatureKind::face) {
      for (const EdgeId side : surface.edges_of(FaceId{feature.id})) add(Feature(side));
    }
    for (const NodeId node : surface.nodes_of(cell)) add(Feature(node));
  }
  std::sort(cells_.begin(), cells_.end());
  const auto same = [](const Cell& a, const Cell& b) { return a.feature == b.feature; };
  cells_.erase(std::unique(cells_.begin(), cells_.end(), same), cells_.end());
}

/// Keeps the cells in range. Every foot is a cell of the list: a cell itself, a side or a node.
void NearComplex::find_feet(const Surface& surface, const Vec3& point, double range, Positions x) {
  vertices_.clear();
  std::size_t kept = 0;
  // Nodes come first, then edges, then facets (FeatureKind): a foot is known before it is asked
  // for, and a cell in range keeps its foot in range.
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    Cell cell = cells_[i];
    cell.foot = closest_feature(surface, cell.feature, point, x);
    if (cell.foot == cell.feature) {
      const auto foot = foot_on(surface, cell.feature, point, x);
      if (!(foot.distance < range)) continue;
      cell.vertex = static_cast<std::uint32_t>(vertices_.size());
      vertices_.push_back({foot.core, foot.direction, foot.distance});
    } else {
      const auto known = std::lower_bound(cells_.begin(), cells_.begin() + static_cast<long>(kept),
                                          Cell{cell.foot, cell.foot, 0});
      if (known == cells_.begin() + static_cast<long>(kept) || known->feature != cell.foot)
        continue;
      cell.vertex = known->vertex;
    }
    cells_[kept++] = cell;
  }
  cells_.resize(kept);
}

/// Nearest first.
void NearComplex::number_vertices() {
  order_.resize(vertices_.size());
  std::iota(order_.begin(), order_.end(), 0U);
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t i, std::uint32_t k) {
    const Vertex& a = vertices_[i];
    const Vertex& b = vertices_[k];
    return a.distance != b.distance ? a.distance < b.distance : a.core.feature < b.core.feature;
  });
  sorted_.clear();
  for (const std::uint32_t i : order_) sorted_.push_back(vertices_[i]);
  vertices_.swap(sorted_);
  place_.resize(order_.size());
  for (std::uint32_t place = 0; place < order_.size(); ++place) place_[order_[place]] = place;
  for (Cell& cell : cells_) cell.vertex = place_[cell.vertex];
}

const NearComplex::Cell* NearComplex::cell_of(Feature feature) const noexcept {
  const auto found = std::lower_bound(cells_.begin(), cells_.end(), Cell{feature, feature, 0});
  return found != cells_.end() && found->feature == feature ? &*found : nullptr;
}

void NearComplex::start_levels() {
  distances_.clear();
  for (const Vertex& vertex : vertices_) distances_.push_back(vertex.distance);
  of_cells_.clear();
  for (const Cell& cell : cells_) of_cells_.push_back(cell.vertex);
  levels_.start(distances_, of_cells_);
}

void NearComplex::add_link(const Cell* side, const Cell& cell) {
  if (side != nullptr) levels_.add_link(place_of(*side), place_of(cell));
}

void NearComplex::list_links(const Surface& surface) {
  for (const Cell& cell : cells_) {
    if (cell.feature.kind == FeatureKind::edge) {
      for (const NodeId end : surface.nodes_of(EdgeId{cell.feature.id}))
        add_link(cell_of(Feature(end)), cell);
    } else if (cell.feature.kind == FeatureKind::face) {
      for (const EdgeId side : surface.edges_of(FaceId{cell.feature.id}))
        add_link(cell_of(Feature(side)), cell);
    }
  }
  levels_.sort_links();
}

/// Around a corner of a facet in range: corner, side, facet, other side.
void NearComplex::list_fillings(const Surface& surface) {
  if (cells_.empty() || cells_.back().feature.kind != FeatureKind::face) return;
  levels_.index_links();
  for (const Cell& facet : cells_) {
    if (facet.feature.kind != FeatureKind::face) continue;
    const FaceId face{facet.feature.id};
    const auto& nodes = surface.nodes_of(face);
    const auto& sides = surface.edges_of(face);  // side k joins corners k and k + 1
    for (std::size_t k = 0; k < 3; ++k) {
      const Cell* corner = cell_of(Feature(nodes[k]));
      if (corner == nullptr) continue;
      const Cell* const first_side = cell_of(Feature(sides[k]));
      const Cell* const last_side = cell_of(Feature(sides[(k + 2) % 3]));
      // At the range a corner may be in it while rounding leaves out the side.
      if (first_side == nullptr || last_side == nullptr) continue;
      levels_.add_filling(place_of(*corner), place_of(*first_side), place_of(facet),
                          place_of(*last_side));
    }
  }
  levels_.sort_fillings();
}

}  // namespace plekton::contact
