// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/ties/cable_slide.hpp"

#include <algorithm>
#include <cmath>

namespace plekton::dynamics {
namespace {

/// A point seen from a segment.
struct Footing {
  double length;  ///< m, of the segment
  double along;   ///< m, from the first point of the segment to the foot of the point
  double across;  ///< m, from the line of the segment to the point
};

Footing footing_of(const Vec3& point, const Vec3& start, const Vec3& chord) noexcept {
  const double length = chord.norm();
  const Vec3 from_start = point - start;
  if (!(length > 0.0)) return {0.0, 0.0, from_start.norm()};
  const Vec3 direction = chord / length;
  const double along = from_start.dot(direction);
  return {length, along, (from_start - along * direction).norm()};
}

/// By how much (N) the force along the cable is above what friction holds, at a distance along it
/// from the foot of the node; below 0: it holds.
double excess_force(const Tie& tie, double along, double across) noexcept {
  const double distance = std::sqrt(along * along + across * across);
  const double stretch = distance - tie.rest_length;
  if (!(stretch > 0.0)) return -tie.slip_force;
  const double pull_by_distance = tie.stiffness * stretch / distance;
  return pull_by_distance * (along - tie.friction * across) - tie.slip_force;
}

/// m, >= 0, distance along the cable from the foot of the node at which friction just holds the tie.
/// @param along  m, one at which it does not
double holding_distance(const Tie& tie, double along, double across) noexcept {
  const double slack = std::sqrt(
      std::max(0.0, tie.rest_length * tie.rest_length - across * across));  // within: no force
  double low = std::max(tie.friction * across, slack);
  if (tie.slip_force == 0.0) return std::min(low, along);
  if (tie.rest_length == 0.0)
    return std::min(tie.friction * across + tie.slip_force / tie.stiffness, along);
  double high = along;
  constexpr int kHalvings = 60;  // below the rounding of a length
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (excess_force(tie, middle, across) > 0.0 ? high : low) = middle;
  }
  return low;
}

/// @param direction  1 or -1, along the cable
Slide slide_towards(int direction, const CableShape& cable, const Tie& tie, const Vec3& point,
                    CablePosition from) noexcept {
  const double end = direction > 0 ? 1.0 : 0.0;
  Slide slide{from, 0.0};
  CablePosition& at = slide.to;
  // Each turn ends at a corner; segments without length need not bring it nearer.
  for (std::size_t turn = 0; turn < 2 * cable.segments() + 2; ++turn) {
    if (at.along == end) {
      const std::size_t next = cable.beside(at.segment, direction);
      if (next == at.segment) return slide;
      const Footing ahead = footing_of(point, cable.start(next), cable.chord(next));
      const double left = direction > 0 ? ahead.along : ahead.length - ahead.along;
      if (ahead.length > 0.0 && !(excess_force(tie, left, ahead.across) > 0.0 && left > 0.0))
        return slide;
      at = {next, 1.0 - end};
    }
    const Footing foot = footing_of(point, cable.start(at.segment), cable.chord(at.segment));
    if (foot.length == 0.0) {
      at.along = end;
      continue;
    }
    const double left = direction * (foot.along - at.along * foot.length);
    if (!(left > 0.0 && excess_force(tie, left, foot.across) > 0.0)) return slide;
    const double way = left - holding_distance(tie, left, foot.across);
    const double to_end = foot.length * std::abs(end - at.along);
    slide.distance += direction * std::min(way, to_end);
    if (way < to_end) {
      at.along = std::clamp(at.along + direction * way / foot.length, 0.0, 1.0);
      return slide;
    }
    at.along = end;
  }
  return slide;
}

/// The nearest point on a segment.
struct SegmentFoot {
  CablePosition at;
  double squared;  ///< m², distance
};

SegmentFoot foot_on(const CableShape& cable, std::size_t segment, const Vec3& point) noexcept {
  const Vec3& start = cable.start(segment);
  const Vec3 chord = cable.chord(segment);
  const double squared = chord.squaredNorm();
  const double along =
      squared > 0.0 ? std::clamp((point - start).dot(chord) / squared, 0.0, 1.0) : 0.0;
  return {{segment, along}, (point - start - along * chord).squaredNorm()};
}

}  // namespace

std::size_t CableShape::beside(std::size_t segment, int direction) const noexcept {
  const std::size_t count = cable_.segments();
  const bool is_last = direction > 0 ? segment + 1 == count : segment == 0;
  if (is_last && !cable_.is_closed) return segment;
  const std::size_t next = (segment + (direction > 0 ? 1 : count - 1)) % count;
  return is_there_[next] != 0 ? next : segment;
}

Slide slide_to_nearest(const CableShape& cable, const Vec3& point, CablePosition from) noexcept {
  SegmentFoot nearest = foot_on(cable, from.segment, point);
  double distance = (nearest.at.along - from.along) * cable.chord(from.segment).norm();
  for (;;) {
    const CablePosition here = nearest.at;
    int direction = 0;
    for (const int beside : {-1, 1}) {
      const SegmentFoot foot = foot_on(cable, cable.beside(here.segment, beside), point);
      if (!(foot.squared < nearest.squared)) continue;
      nearest = foot;
      direction = beside;
    }
    if (direction == 0) return {nearest.at, distance};
    const double end = direction > 0 ? 1.0 : 0.0;
    distance += (end - here.along) * cable.chord(here.segment).norm() +
                (nearest.at.along - (1.0 - end)) * cable.chord(nearest.at.segment).norm();
  }
}

Slide slide_with_friction(const CableShape& cable, const Tie& tie, const Vec3& point,
                          CablePosition from) noexcept {
  const Slide forwards = slide_towards(1, cable, tie, point, from);
  if (forwards.distance != 0.0) return forwards;
  return slide_towards(-1, cable, tie, point, from);
}

}  // namespace plekton::dynamics
