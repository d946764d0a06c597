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

/// Of the corners of a, as forces act on them along the whole.
Vec3 parts_of(const std::array<Vec3, 3>& forces, const Vec3& whole) {
  Vec3 parts;
  for (std::size_t i = 0; i < 3; ++i)
    parts[static_cast<int>(i)] = std::max(0.0, forces[i].dot(whole));
  return parts;
}

}  // namespace

Vec3 force_on_a(const PairTerm& term) {
  return term.forces.on_a[0] + term.forces.on_a[1] + term.forces.on_a[2];
}

PressedPoints pressed_points(const geometry::Surface& surface, const PairTerm& term, double range,
                             Positions x) {
  const geometry::Core a = core_of(term.a, x);
  const geometry::Core b = core_of(term.b, x);
  const auto points = [&](const Vec3& on_a, const Vec3& on_b) {
    return PressedPoints{point_on(surface, term.a, on_a), point_on(surface, term.b, on_b)};
  };
  const Vec3 parts = parts_of(term.forces.on_a, force_on_a(term));
  if (const double whole = parts.sum(); whole > 0.0) {
    const geometry::Core mean{{position(point_on(surface, term.a, parts / whole), x)}, 1};
    const Vec3 on_b = geometry::closest_points(mean, b).weights_b;
    const geometry::Core beside{{position(point_on(surface, term.b, on_b), x)}, 1};
    const geometry::ClosestPoints opposite = geometry::closest_points(a, beside);
    if (opposite.distance < range) return points(opposite.weights_a, on_b);
  }
  const geometry::ClosestPoints nearest = geometry::closest_points(a, b);
  return points(nearest.weights_a, nearest.weights_b);
}

}  // namespace plekton::contact::structure
