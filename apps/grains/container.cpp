// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/grains/container.hpp"

#include "apps/grains/free_space.hpp"

namespace plekton::apps {

bool Container::holds(const Vec3& centre, double radius) const {
  if (is_inside) return is_inside(centre);
  if (!cylinder) return true;  // the bounds are the box
  const double size = (1.0 - kRounding) * radius;
  const Vec3 axis = (cylinder->to - cylinder->from).normalized();
  const Vec3 from = centre - cylinder->from;
  const double height = axis.dot(from);
  return height >= size && axis.dot(cylinder->to - centre) >= size &&
         (from - height * axis).norm() + size <= cylinder->radius;
}

Container container_of(const Box& box) {
  return {box, geometry::volume(box), {}, {}};
}

Container container_of(const geometry::CylinderRegion& cylinder) {
  return {geometry::bounds(cylinder), geometry::volume(cylinder), cylinder, {}};
}

}  // namespace plekton::apps
