// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/query/region.hpp"

#include <functional>
#include <optional>

namespace plekton::apps {

using geometry::Box;
using geometry::Vec3;

/// The space that grains are placed in: a box, a cylinder, or what a closed surface encloses, whose
/// facets are obstacles beside that (free_space.hpp).
struct Container {
  Box bounds{Vec3::Zero(), Vec3::Zero()};            ///< m, around it
  double volume = 0.0;                               ///< m³
  std::optional<geometry::CylinderRegion> cylinder;  ///< instead of the box
  std::function<bool(const Vec3&)> is_inside;        ///< of a closed surface, instead of both

  /// Whether a ball in the bounds is in it wholly; of a surface, its centre.
  bool holds(const Vec3& centre, double radius) const;
};

Container container_of(const Box& box);
Container container_of(const geometry::CylinderRegion& cylinder);

}  // namespace plekton::apps
