// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/elements.hpp"
#include "geometry/primitives/proximity.hpp"

namespace plekton::geometry {

/// The feature of a closed cell (a facet with its rim, an edge with its ends) that holds the point
/// nearest to a point. Exact; a tie goes to the lower-dimensional feature, so the answer is unique.
/// A facet without area, or an edge without length, answers with the lowest of the features that
/// hold the point, whatever the order of its nodes.
Feature closest_feature(const Surface& surface, Feature cell, const Vec3& point,
                        Positions x) noexcept;

/// The foot point of a point on a feature that holds it (as closest_feature() says).
struct SurfaceFoot {
  CorePoint core;
  Vec3 direction;   ///< unit, from the point to the foot
  double distance;  ///< m
};
SurfaceFoot foot_on(const Surface& surface, Feature feature, const Vec3& point,
                    Positions x) noexcept;

/// The cell whose closed part comes nearer to a point; the first one of a tie.
Feature nearer_cell(const Surface& surface, Feature first, Feature second, const Vec3& point,
                    Positions x) noexcept;

/// A cell next to a feature that holds a nearer point than the feature's own foot, by exact signs.
/// Of several it is the one that comes nearest, so that the walk does not depend on the order in
/// which cells were created (but for ties). The feature itself if it is a minimum.
Feature downhill_from(const Surface& surface, Feature feature, const Vec3& point,
                      Positions x) noexcept;

/// Walks downhill over the surface from a feature to a minimum of the distance to a point.
///
/// Every step goes downhill_from() where it is: to a cell whose closed part holds a nearer point,
/// by exact signs, so the walk cannot cycle and stays inside the connected part of {distance < d}
/// it started in. It is how a contact follows its surface: the foot of the last step leads to that
/// of this one, across any number of primitives.
Feature descend(const Surface& surface, Feature start, const Vec3& point, Positions x) noexcept;

}  // namespace plekton::geometry
