// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_sections.hpp"

#include <array>

namespace plekton::apps {
namespace {

using Form = contact::Plane::Form;

/// Unit, of a key whose vector may have any length but none.
Vec3 read_direction(Section& section, std::string_view key, const Vec3& fallback,
                    const char* expected) {
  Vec3 direction = section.vector(key, Quantity{kNumber}, fallback);
  const double length = direction.stableNorm();
  if (length == 0.0)
    section.complain(key, std::string("got a vector of no length; expected ") + expected);
  if (length > 0.0) direction.stableNormalize();
  return direction;
}

}  // namespace

PlaneSettings read_plane(Section section, const Known& known, std::size_t number) {
  constexpr std::array<std::string_view, 3> kKinds = {"flat", "cylinder", "sphere"};
  PlaneSettings plane;
  plane.name = section.name("name", "");
  plane.number = number;
  plane.form = static_cast<Form>(section.choice("kind", kKinds, 0));
  plane.point = section.vector("point", {kLength});
  if (plane.is_flat()) {
    plane.normal = read_direction(section, "normal", plane.normal,
                                  "the direction into the space of the bodies");
    plane.axis = plane.normal;
  } else {
    plane.axis = read_direction(section, "axis", plane.axis, "the direction of the axis");
    plane.radius = section.quantity("radius", {kLength, kPositive});
  }
  plane.velocity = section.vector("velocity", {kVelocity}, plane.velocity);
  plane.angular_velocity =
      section.quantity("angular_velocity", {kAngularVelocity}, plane.angular_velocity);
  plane.material = read_material_of(section, known).value_or(0);
  section.finish();
  return plane;
}

}  // namespace plekton::apps
