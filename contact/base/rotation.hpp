// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "geometry/base/pack.hpp"
#include "geometry/base/small_angle.hpp"

namespace plekton::contact {

/// How a contact frame turned during a step: from one normal to the next by the shortest way, then
/// about the new normal by the mean spin of both bodies. Real is double, or a Pack for small twists
/// side by side.
template <class Real>
struct FrameRotationOf {
  using Vector = geometry::Vec3Of<Real>;

  Vector from;  ///< unit normal before
  Vector to;    ///< unit normal now; not opposite to the one before
  Real twist;   ///< rad, about the new normal

  /// Turns a vector that is tangent to the old contact plane; the result is tangent to the new one
  /// and as long.
  ///
  /// Rodrigues' formula with the axis from x to, written without angles; exact, so a revolution of
  /// the pair brings the tangential force back to where it was. (First-order updates grow it by 2
  /// pi² / N in a revolution of N steps.)
  PLEKTON_INLINE Vector operator()(const Vector& tangent) const noexcept {
    const Vector axis = from.cross(to);
    const Real cosine = from.dot(to);
    const Real along_axis = axis.dot(tangent) / (Real(1.0) + cosine);
    const Vector swung = cosine * tangent + axis.cross(tangent) + along_axis * axis;
    const auto [cos_twist, sinc_twist] = geometry::cosine_and_sinc(Real(twist * twist));
    const Vector turned = cos_twist * swung + Real(sinc_twist * twist) * to.cross(swung);
    const Real out_of_plane = turned.dot(to);  // rounding, nothing else
    return turned - out_of_plane * to;
  }
};
using FrameRotation = FrameRotationOf<double>;

}  // namespace plekton::contact
