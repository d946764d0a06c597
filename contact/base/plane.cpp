// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/base/plane.hpp"

#include <Eigen/Geometry>

namespace plekton::contact {

Vec3 Plane::normal_in_the_middle() const noexcept {
  return form == Form::cylinder ? Vec3(axis.unitOrthogonal()) : Vec3(Vec3::UnitZ());
}

}  // namespace plekton::contact
