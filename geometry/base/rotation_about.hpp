// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/elementary.hpp"
#include "geometry/base/types.hpp"

namespace plekton::geometry {

/// The rotation about an axis by an angle (rad): cos I + sin [axis] + (1 - cos) axis axis^T, after
/// Rodrigues. In place of Eigen::AngleAxis, whose sine and cosine are those of the C library.
/// @param axis  unit
inline Mat3 rotation_about(const Vec3& axis, double angle) noexcept {
  const double cosine = elementary::cos(angle);
  const Vec3 turned = elementary::sin(angle) * axis;
  Mat3 rotation = ((1.0 - cosine) * axis) * axis.transpose();
  rotation.diagonal().array() += cosine;
  rotation(1, 0) += turned.z();
  rotation(0, 1) -= turned.z();
  rotation(0, 2) += turned.y();
  rotation(2, 0) -= turned.y();
  rotation(2, 1) += turned.x();
  rotation(1, 2) -= turned.x();
  return rotation;
}

}  // namespace plekton::geometry
