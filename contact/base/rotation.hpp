// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "geometry/base/pack.hpp"
#include "geometry/base/small_angle.hpp"

#include <type_traits>

namespace plekton::contact {

/// Whether a normal turned by more than 120 degrees in one step. Bodies roll around each other
/// little by little: the core of one went through that of the other.
inline bool is_turned_over(const Vec3& last, const Vec3& normal) noexcept {
  return last.dot(normal) < -0.5;
}

/// How a contact frame turned during a step: from one normal to the next by the shortest way, then
/// about the new normal by the mean spin of both bodies. Real is double, or a Pack for small twists
/// of normals that do not turn over, side by side.
///
/// Where cores went through each other the normal turned over, but nothing that lies in the contact
/// plane did: the frame is mirrored, not turned, and the springs in it go on.
template <class Real>
struct FrameRotationOf {
  using Vector = geometry::Vec3Of<Real>;

  Vector from;  ///< unit normal before
  Vector to;    ///< unit normal now
  Real twist;   ///< rad, about the new normal

  /// Turns a vector that is tangent to the old contact plane; the result is tangent to the new one
  /// and as long.
  PLEKTON_INLINE Vector operator()(const Vector& tangent) const noexcept {
    const Vector swung = is_mirrored() ? mirrored(tangent) : this->swung(tangent);
    const auto [cos_twist, sinc_twist] = geometry::cosine_and_sinc(Real(twist * twist));
    const Vector turned = cos_twist * swung + Real(sinc_twist * twist) * to.cross(swung);
    const Real out_of_plane = turned.dot(to);  // rounding, nothing else
    return turned - out_of_plane * to;
  }

  /// What the same force or moment along the normal is along the new one.
  PLEKTON_INLINE Real along_normal(const Real& before) const noexcept {
    return is_mirrored() ? Real(-before) : before;
  }

 private:
  PLEKTON_INLINE bool is_mirrored() const noexcept {
    if constexpr (std::is_same_v<Real, double>) {
      return is_turned_over(from, to);
    } else {
      return false;
    }
  }

  /// Rodrigues' formula with the axis from x to, written without angles; exact, so a revolution of
  /// the pair brings the tangential force back to where it was. (First-order updates grow it by 2
  /// pi² / N in a revolution of N steps.)
  PLEKTON_INLINE Vector swung(const Vector& tangent) const noexcept {
    const Vector axis = from.cross(to);
    const Real cosine = from.dot(to);
    const Real along_axis = axis.dot(tangent) / (Real(1.0) + cosine);
    return cosine * tangent + axis.cross(tangent) + along_axis * axis;
  }

  /// Householder's reflection that takes one normal to the other; of opposite ones it leaves the
  /// contact plane as it is.
  PLEKTON_INLINE Vector mirrored(const Vector& tangent) const noexcept {
    const Vector across = from - to;
    return tangent - Real(Real(2.0) * across.dot(tangent) / across.squaredNorm()) * across;
  }
};
using FrameRotation = FrameRotationOf<double>;

}  // namespace plekton::contact
