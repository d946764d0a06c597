// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/proximity_query.hpp"

#include "geometry/primitive_pairs.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace plekton::geometry {

ProximityQuery::ProximityQuery(Elements elements, std::size_t node_count, double largest_gap, int threads)
    : elements_(std::move(elements)),
      surface_(std::make_unique<Surface>(elements_.cylinders, elements_.facets, node_count)),
      largest_gap_(largest_gap),
      pool_(threads) {
  if (!(largest_gap > 0.0) || !std::isfinite(largest_gap)) {
    throw std::invalid_argument("largest gap is " + std::to_string(largest_gap) + " m; it must be positive");
  }
  // A pair is nearer than the largest gap if it touches with that much more radius of the sphere.
  for (const Sphere& sphere : elements_.spheres) grown_.push_back({sphere.nodes, sphere.radius + largest_gap});
  neighbours_ = std::make_unique<Neighbours>(grown_, *surface_, largest_gap);
}

std::span<const Proximity> ProximityQuery::find(Positions x) {
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
