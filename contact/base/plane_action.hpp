// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

namespace plekton::contact {

using geometry::Vec3;

/// What bodies did to a plane in a step.
struct PlaneAction {
  Vec3 force = Vec3::Zero();   ///< N
  Vec3 moment = Vec3::Zero();  ///< N m, about Plane::point, where it was in that step
  double push = 0.0;           ///< N, out of the space of the bodies, wherever it acts
};

}  // namespace plekton::contact
