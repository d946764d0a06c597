// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/pressed_points.hpp"

#include <algorithm>

namespace plekton::contact::structure {
namespace {

geometry::CorePoint point_on(const geometry::Surface& surface, const geometry::FeatureNodes& nodes,
                             const Vec3& weights) {
  geometry::CorePoint point{
      {nodes.ids[0], nodes.ids[0], nodes.ids[0]}, weights, geometry::feature_of(surface, nodes)};
  std::copy(nodes.begin(), nodes.end(), point.nodes.begin());
  return point;
}

geometry::Core core_of(const geometry::FeatureNodes& nodes, Positions x) {
  geometry::Core core;
  core.count = nodes.count;
  for (std::size_t i = 0; i < nodes.count; ++i) core.x[i] = x[index_of(nodes.ids[i])];
  return core;
}

/// Of the corners of a, where forces act on them.
Vec3 weights_of(const std::array<Vec3, 3>& forces, const Vec3& total) {
  Vec3 weights;
  for (std::size_t i = 0; i < 3; ++i)
    weights[static_cast<int>(i)] = std::max(0.0, forces[i].dot(total));
  return weights / weights.sum();
}

}  // namespace

Vec3 force_on_a(const PairTerm& term) {
  return term.forces.on_a[0] + term.forces.on_a[1] + term.forces.on_a[2];
}

PressedPoints pressed_points(const geometry::Surface& surface, const PairTerm& term, double range,
                             Positions x) {
  const geometry::Core a = core_of(term.a, x);
  const geometry::Core b = core_of(term.b, x);
  const Vec3 weights = weights_of(term.forces.on_a, force_on_a(term));
  const geometry::Core mean{{position(point_on(surface, term.a, weights), x)}, 1};
  const Vec3 on_b = geometry::closest_points(mean, b).weights_b;
  const geometry::Core beside{{position(point_on(surface, term.b, on_b), x)}, 1};
  const geometry::ClosestPoints opposite = geometry::closest_points(a, beside);
  if (opposite.distance < range)
    return {point_on(surface, term.a, opposite.weights_a), point_on(surface, term.b, on_b)};
  const geometry::ClosestPoints nearest = geometry::closest_points(a, b);
  return {point_on(surface, term.a, nearest.weights_a),
          point_on(surface, term.b, nearest.weights_b)};
}

}  // namespace plekton::contact::structure
