// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/query/proximity_query.hpp"

#include "geometry/base/largest_coordinate.hpp"
#include "geometry/base/problems.hpp"
#include "geometry/closest/primitive_pairs.hpp"
#include "geometry/query/number_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace plekton::geometry {

namespace {

void list_sphere_problems(std::span<const Sphere> spheres, std::size_t node_count,
                          std::ostream& problems) {
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const auto node = static_cast<std::int32_t>(spheres[i].nodes[0]);
    if (node < 0 || static_cast<std::size_t>(node) >= node_count) {
      problems << "sphere " << i << " names node " << node << ", but there are " << node_count
               << " nodes\n";
    }
    if (!(spheres[i].radius >= 0.0 && spheres[i].radius < kLargestCoordinate)) {
      problems << "sphere " << i << " has radius " << spheres[i].radius
               << " m; it must be at least 0 and below " << kLargestCoordinate << " m\n";
    }
  }
}

void list_gap_problems(double largest_gap, std::ostream& problems) {
  if (!(largest_gap > 0.0) || !std::isfinite(largest_gap)) {
    problems << "largest gap is " << largest_gap << " m; it must be positive and finite\n";
  } else if (largest_gap < kSmallestSkin) {
    problems << "largest gap is " << largest_gap << " m; it must be at least " << kSmallestSkin
             << " m; take a larger one, and leave out what is further away\n";
  }
}

/// @throws std::invalid_argument if distances of nodes cannot be taken
void check_numbers(Positions x) {
  double largest = 0.0;
  for (const Vec3& position : x) largest += position.cwiseAbs().sum();  // NaN stays NaN
  if (largest < kLargestCoordinate) return;
  std::ostringstream problems;
  list_node_problems(x, problems, [](std::size_t) { return true; });
  throw_if_any(problems);
}

}  // namespace

ProximityQuery::ProximityQuery(Elements elements, std::size_t node_count, const PairChoice& choice,
                               int threads)
    : elements_(std::move(elements)),
      choice_(choice),
      pool_(std::make_unique<ThreadPool>(threads)),
      cell_skin_(choice.largest_gap >= kSmallestSkin && std::isfinite(choice.largest_gap)
                     ? choice.largest_gap
                     : 0.0),
      found_by_worker_(static_cast<std::size_t>(threads)) {
  const double largest_gap = choice.largest_gap;
  std::ostringstream problems;
  list_sphere_problems(elements_.spheres, node_count, problems);
  list_gap_problems(largest_gap, problems);
  try {
    surface_ = std::make_unique<Surface>(elements_.cylinders, elements_.facets, node_count);
  } catch (const std::invalid_argument& of_surface) {
    problems << of_surface.what() << '\n';
  }
  throw_if_any(problems);
  // A pair is nearer than the largest gap if it touches with that much more radius of the sphere.
  for (const Sphere& sphere : elements_.spheres)
    grown_.push_back({sphere.nodes, sphere.radius + largest_gap});
  neighbours_ = std::make_unique<Neighbours>(grown_, *surface_, largest_gap);
}

std::span<const Proximity> ProximityQuery::find(Positions x) {
  if (x.size() != surface_->node_count()) {
    throw std::invalid_argument("positions of " + std::to_string(x.size()) +
                                " nodes; this query was made for " +
                                std::to_string(surface_->node_count()));
  }
  check_numbers(x);
  list_candidates(x);
  for (Found& found : found_by_worker_) {
    found.proximities.clear();
    found.elements.clear();
  }
  pool_->for_each_range(candidates_.size(), [&](std::size_t begin, std::size_t end, int worker) {
    Found& found = found_by_worker_[static_cast<std::size_t>(worker)];
    for (std::size_t i = begin; i < end; ++i) {
      const Proximity proximity = proximity_of(candidates_[i], x);
      if (!(proximity.gap < choice_.largest_gap)) continue;
      found.proximities.push_back(proximity);
      found.elements.push_back(candidates_[i]);
    }
  });
  found_.clear();
  found_elements_.clear();
  for (const Found& part : found_by_worker_) {
    found_.insert(found_.end(), part.proximities.begin(), part.proximities.end());
    found_elements_.insert(found_elements_.end(), part.elements.begin(), part.elements.end());
  }
  return found_;
}

void ProximityQuery::list_candidates(Positions x) {
  using Kind = ElementId::Kind;
  neighbours_->update(x, *pool_);
  candidates_.clear();
  for (const IndexPair& pair : neighbours_->sphere_pairs())
    candidates_.push_back({{Kind::sphere, pair.a}, {Kind::sphere, pair.b}});
  const auto near = neighbours_->near_cells();
  const auto pairs = neighbours_->sphere_structures();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (const CellId cell : neighbours_->cells().subspan(near[i].first, near[i].count)) {
      candidates_.push_back(
          {{Kind::sphere, pairs[i].a}, {Kind::cell, static_cast<std::int32_t>(cell)}});
    }
  }
  if (choice_.cells_with_cells || choice_.within_structures) list_cell_pairs(x);
  for (const IndexPair& pair : cell_pairs_)
    candidates_.push_back({{Kind::cell, pair.a}, {Kind::cell, pair.b}});
}

/// Each box carries half the largest gap, and half the skin (skin.hpp).
void ProximityQuery::list_cell_pairs(Positions x) {
  if (!cell_skin_.needs_rebuild(x, *pool_)) return;
  const double margin = 0.5 * choice_.largest_gap + cell_skin_.margin();
  cell_boxes_.clear();
  for (std::size_t c = 0; c < surface_->cell_count(); ++c) {
    const CellId cell = id_at<CellId>(c);
    std::array<Vec3, 3> corners;
    std::size_t count = 0;
    for (const NodeId node : surface_->nodes_of(cell)) corners[count++] = x[index_of(node)];
    const double radius = surface_->radius(surface_->structure_of(cell));
    cell_boxes_.push_back(bounding_box({corners.data(), count}, radius + margin));
  }
  cell_tree_.rebuild(cell_boxes_);
  cell_tree_.self_pairs(cell_pairs_);
  std::erase_if(cell_pairs_,
                [&](const IndexPair& pair) { return !is_chosen(CellId{pair.a}, CellId{pair.b}); });
  cell_skin_.mark_built(x);
}

bool ProximityQuery::is_chosen(CellId a, CellId b) const {
  if (surface_->structure_of(a) != surface_->structure_of(b)) return choice_.cells_with_cells;
  if (!choice_.within_structures) return false;
  const auto of_a = surface_->nodes_of(a);
  const auto of_b = surface_->nodes_of(b);
  return std::find_first_of(of_a.begin(), of_a.end(), of_b.begin(), of_b.end()) == of_a.end();
}

Proximity ProximityQuery::proximity_of(const ElementPair& pair, Positions x) const {
  const auto sphere = [&](const ElementId& id) -> const Sphere& {
    return elements_.spheres[static_cast<std::size_t>(id.id)];
  };
  if (pair.b.kind == ElementId::Kind::sphere) return proximity(sphere(pair.a), sphere(pair.b), x);
  const CellId cell{pair.b.id};
  if (pair.a.kind == ElementId::Kind::sphere) return proximity(sphere(pair.a), *surface_, cell, x);
  return proximity(*surface_, CellId{pair.a.id}, cell, x);
}

}  // namespace plekton::geometry
