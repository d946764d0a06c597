// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/proximity_query.hpp"

#include "geometry/primitive_pairs.hpp"
#include "geometry/problems.hpp"

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
    if (!(spheres[i].radius > 0.0 && std::isfinite(spheres[i].radius))) {
      problems << "sphere " << i << " has radius " << spheres[i].radius
               << " m; it must be positive and finite\n";
    }
  }
}

}  // namespace

ProximityQuery::ProximityQuery(Elements elements, std::size_t node_count, double largest_gap,
                               int threads)
    : elements_(std::move(elements)), largest_gap_(largest_gap), pool_(threads) {
  std::ostringstream problems;
  list_sphere_problems(elements_.spheres, node_count, problems);
  if (!(largest_gap > 0.0) || !std::isfinite(largest_gap))
    problems << "largest gap is " << largest_gap << " m; it must be positive and finite\n";
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
  neighbours_->update(x, pool_);
  found_.clear();
  for (const IndexPair& pair : neighbours_->sphere_pairs()) {
    add_if_near(proximity(elements_.spheres[static_cast<std::size_t>(pair.a)],
                          elements_.spheres[static_cast<std::size_t>(pair.b)], x));
  }
  const auto near = neighbours_->near_cells();
  const auto pairs = neighbours_->sphere_structures();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Sphere& sphere = elements_.spheres[static_cast<std::size_t>(pairs[i].a)];
    for (const CellId cell : neighbours_->cells().subspan(near[i].first, near[i].count)) {
      add_if_near(proximity(sphere, *surface_, cell, x));
    }
  }
  return found_;
}

void ProximityQuery::add_if_near(const Proximity& proximity) {
  if (proximity.gap < largest_gap_) found_.push_back(proximity);
}

}  // namespace plekton::geometry
