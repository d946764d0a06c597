// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/model/ties.hpp"
#include "geometry/primitives/proximity.hpp"

#include <span>

/// How a tie slides along a cable, a chain of straight segments.
namespace plekton::dynamics {

/// The segments of a cable where they are now.
class CableShape {
 public:
  /// @param is_there  by segment; both must outlive this
  CableShape(const Cable& cable, std::span<const char> is_there, geometry::Positions x) noexcept
      : cable_(cable), is_there_(is_there), x_(x) {}

  std::array<NodeId, 2> nodes(std::size_t segment) const noexcept {
    return {cable_.nodes[segment], cable_.nodes[(segment + 1) % cable_.nodes.size()]};
  }
  const Vec3& start(std::size_t segment) const noexcept { return x_[index_of(nodes(segment)[0])]; }
  std::size_t segments() const noexcept { return cable_.segments(); }
  /// m, from the first to the last point of a segment.
  Vec3 chord(std::size_t segment) const noexcept {
    return x_[index_of(nodes(segment)[1])] - start(segment);
  }
  /// The next segment forwards (1) or backwards (-1); the same one where the cable ends or is torn.
  std::size_t beside(std::size_t segment, int direction) const noexcept;

 private:
  const Cable& cable_;
  std::span<const char> is_there_;
  geometry::Positions x_;
};

/// Where on a cable.
struct CablePosition {
  std::size_t segment;
  double along;  ///< 0 to 1
};

/// Where a tie has slid to.
struct Slide {
  CablePosition to;
  double distance;  ///< m, along the cable, > 0 forwards
};

/// Slides to the nearest point of a cable to a point (m), near where it was: on the segment there,
/// or on ones that follow each other, each nearer than the one before. So the distance is continuous
/// as the point goes round a corner, on either side of it.
Slide slide_to_nearest(const CableShape& cable, const Vec3& point, CablePosition from) noexcept;

/// Slides a tie of which k, rest length, friction and slip force are known (Tie), until it holds:
/// the force along the cable is not above friction times the force across it plus slip_force, or
/// the cable ends.
/// @param point  m, of the node that is tied
Slide slide_with_friction(const CableShape& cable, const Tie& tie, const Vec3& point,
                          CablePosition from) noexcept;

}  // namespace plekton::dynamics
