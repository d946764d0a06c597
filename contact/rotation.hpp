// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/motion.hpp"

#include <cmath>

namespace plekton::contact {

/// How a contact frame turned during a step: from one normal to the next by the shortest way, then about the new
/// normal by the mean spin of both bodies.
struct FrameRotation {
  Vec3 from;     ///< unit normal before
  Vec3 to;       ///< unit normal now; not opposite to the one before
  double twist;  ///< rad, about the new normal

  /// Turns a vector that is tangent to the old contact plane; the result is tangent to the new one and as long.
  ///
  /// Rodrigues' formula with axis from x to, written without angles: R s = s (from.to) + (from x to) x s + ...; exact,
  /// so a revolution of the pair brings the tangential force back to where it was. (First-order updates grow it by
  /// 2 pi^2 / N in a revolution of N steps.)
  Vec3 operator()(const Vec3& tangent) const noexcept {
    const double length_squared = tangent.squaredNorm();
    if (length_squared == 0.0) return tangent;
    const Vec3 axis = from.cross(to);
    const double cosine = from.dot(to);
    Vec3 turned = cosine * tangent + axis.cross(tangent) + (axis.dot(tangent) / (1.0 + cosine)) * axis;
    turned = std::cos(twist) * turned + std::sin(twist) * to.cross(turned);
    turned -= turned.dot(to) * to;  // rounding only
    const double turned_squared = turned.squaredNorm();
    if (turned_squared == 0.0) return turned;
    return std::sqrt(length_squared / turned_squared) * turned;
  }
};

}  // namespace plekton::contact
