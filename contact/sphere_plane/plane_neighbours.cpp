// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_plane/plane_neighbours.hpp"

#include <algorithm>

namespace plekton::contact {

bool PlaneNeighbours::is_due(std::span<const Plane> planes) const noexcept {
  const auto has_moved = [this](const Plane& now, const Plane& then) {
    if (now.form != Plane::Form::flat)
      return 2.0 * ((now.point - then.point).norm() + std::abs(now.radius - then.radius)) >= skin_;
    return now.normal != then.normal ||
           2.0 * std::abs((now.point - then.point).dot(then.normal)) >= skin_;
  };
  return expired_ ||
         !std::equal(planes.begin(), planes.end(), built_for_.begin(), built_for_.end(),
                     [&](const Plane& now, const Plane& then) { return !has_moved(now, then); });
}

bool PlaneNeighbours::update(std::span<const SphereBody> spheres, std::span<const Plane> planes,
                             Positions x) {
  if (!is_due(planes)) return false;
  pairs_.clear();
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    for (std::size_t p = 0; p < planes.size(); ++p) {
      const double height = planes[p].height(x[index_of(spheres[i].node)]);
      if (height < spheres[i].radius + reach_ + 1.5 * skin_) {
        pairs_.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(p)});
      }
    }
  }
  built_for_.assign(planes.begin(), planes.end());
  expired_ = false;
  return true;
}

/// The list itself: it was made while the spheres were anywhere on their way.
void PlaneNeighbours::exchange(const geometry::StateArchive& archive, std::size_t sphere_count,
                               std::size_t plane_count) {
  archive("skin", skin_);
  archive("expired", expired_);
  archive.rows("built_for", built_for_, [](geometry::RowFields& row, Plane& plane) {
    row("point", plane.point);
    row("normal", plane.normal);
    row("radius", plane.radius);
  });
  archive.rows("pairs", pairs_, [&](geometry::RowFields& row, geometry::IndexPair& pair) {
    row("sphere", pair.a);
    row("plane", pair.b);
    row.require(pair.a >= 0 && static_cast<std::size_t>(pair.a) < sphere_count, "sphere");
    row.require(pair.b >= 0 && static_cast<std::size_t>(pair.b) < plane_count, "plane");
  });
}

}  // namespace plekton::contact
