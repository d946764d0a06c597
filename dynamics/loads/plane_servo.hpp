// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/bodies.hpp"
#include "dynamics/loads/load_step.hpp"
#include "dynamics/loads/loads.hpp"

#include <span>
#include <vector>

namespace plekton::dynamics {

/// What the bodies do to a plane.
struct PlaneReaction {
  Vec3 force = Vec3::Zero();  ///< N, on the plane
  double stiffness = 0.0;     ///< N/m, of all its contacts along the normal
};

/// m², the area of a plate under servo control with the planes where they are.
double plate_area(const PlaneServo& servo, std::span<const contact::Plane> planes);

/// Speed (m/s) along the normal, into the bodies, of a plate under servo control:
///
///     v = gain (wanted - felt) / (k dt), at most largest_speed either way,
///
/// with the forces along the normal and k the stiffness of the plate's contacts. A drift of v dt
/// changes the force by k v dt = gain (wanted - felt) if the bodies stay: the error shrinks by the
/// gain in each step, and further as the bodies give way, without an error that stays. Seen by the
/// bodies that is a plate without mass, pushed by the wanted force through a dashpot of
/// k dt / gain: for any gain up to 1 it takes energy away from what swings.
///
/// Without contacts the plate comes on with largest_speed, or stays where no force is wanted.
/// @param missing    N, wanted - felt
/// @param stiffness  N/m, k, >= 0
/// @param dt         s, length of the drift that begins now
double servo_speed(const PlaneServo& servo, double missing, double stiffness, double dt);

/// Planes that move by a table or under servo control.
class DrivenPlanes {
 public:
  DrivenPlanes(const Loads& loads, std::span<const contact::Plane> at_start);

  bool empty() const noexcept { return motions_.empty() && servos_.empty(); }

  /// Sets the velocities of the drift that begins now. No allocation.
  /// @param reactions  by plane
  /// @returns the work (J) done on the bodies over half of the drift before, as far as the velocity
  ///          there was another one: who counts the whole kick does it with the new velocity
  double act(const LoadStep& step, std::span<const PlaneReaction> reactions,
             std::vector<contact::Plane>& planes) const;

  /// m/s, of all times.
  double largest_speed() const noexcept;

 private:
  std::vector<PlaneMotion> motions_;
  std::vector<Vec3> start_;  // m, of motions_
  std::vector<PlaneServo> servos_;
};

}  // namespace plekton::dynamics
