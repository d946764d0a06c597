// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_sections.hpp"

namespace plekton::apps {

PlaneSettings read_plane(Section section, const Known& known) {
  PlaneSettings plane;
  plane.name = section.name("name", "");
  plane.point = section.vector("point", {kLength});
  plane.normal = section.vector("normal", Quantity{kNumber}, plane.normal);
  plane.velocity = section.vector("velocity", {kVelocity}, plane.velocity);
  plane.material = read_material_of(section, known).value_or(0);
  const double length = plane.normal.stableNorm();
  if (length == 0.0)
    section.complain(
        "normal", "got a vector of no length; expected the direction into the space of the bodies");
  if (length > 0.0) plane.normal.stableNormalize();
  section.finish();
  return plane;
}

}  // namespace plekton::apps
