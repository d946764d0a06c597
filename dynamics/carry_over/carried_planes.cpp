// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/carry_over/carried_planes.hpp"

#include "dynamics/carry_over/places.hpp"

#include <cstdint>

namespace plekton::dynamics {

namespace {

/// What moves a plane.
enum class Driver : std::uint8_t { none, motion, servo };

std::vector<Driver> drivers_of(const Scene& scene) {
  std::vector<Driver> drivers(scene.planes.size(), Driver::none);
  for (const PlaneMotion& motion : scene.loads.plane_motions)
    drivers[motion.plane] = Driver::motion;
  for (const PlaneServo& servo : scene.loads.servos) drivers[servo.plane] = Driver::servo;
  return drivers;
}

/// Of the planes of a scene, who drove them in the one before.
std::vector<Driver> drivers_before(const Scene& before, const Scene& now,
                                   const std::vector<std::int32_t>& places) {
  const std::vector<Driver> then = drivers_of(before);
  std::vector<Driver> drivers(now.planes.size(), Driver::none);
  for_each_kept(places, [&](std::size_t i, std::size_t k) { drivers[k] = then[i]; });
  return drivers;
}

/// What the driver of a plane does not set of its pace is as it is made: a motion sets the velocity,
/// a servo that along the normal, or the widening of a container.
void set_rest_of_pace(contact::Plane& plane, const contact::Plane& made, Driver driver,
                      Driver before) {
  const bool is_flat = plane.form == contact::Plane::Form::flat;
  if (driver != Driver::servo) plane.widening = made.widening;
  if (driver == Driver::none || (driver == Driver::servo && !is_flat))
    plane.velocity = made.velocity;
  if (driver == Driver::servo && is_flat && before == Driver::motion)
    plane.velocity =
        made.velocity + (plane.velocity - made.velocity).dot(plane.normal) * plane.normal;
}

}  // namespace

void settle_planes(const Scene& before, const SceneChange& change,
                   const std::vector<contact::Plane>& made, Scene& now) {
  const std::vector<Driver> drivers = drivers_of(now);
  const std::vector<Driver> then = drivers_before(before, now, change.places.planes);
  for (std::size_t i = 0; i < made.size(); ++i) {
    if (!change.moved_planes.empty() && change.moved_planes[i])
      now.planes[i] = made[i];
    else
      set_rest_of_pace(now.planes[i], made[i], drivers[i], then[i]);
  }
}

}  // namespace plekton::dynamics
