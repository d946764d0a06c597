// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_sections.hpp"

#include <fmt/format.h>

#include <cmath>

namespace plekton::apps {

Known::Known(const Scenario& scenario)
    : materials(scenario.materials),
      folder(scenario.file.parent_path()),
      seed(scenario.simulation.seed) {
  for (std::size_t i = 0; i < materials.size(); ++i) material_places.emplace(materials[i].name, i);
}

ValueType box_type() {
  const ValueType corner = ValueType::of(ValueType::Kind::vector, {kLength});
  ValueType type = ValueType::of(ValueType::Kind::table);
  type.members = {{"min", corner}, {"max", corner}};
  return type;
}

geometry::Box read_box(Section section) {
  const Vec3 lower = section.vector("min", {kLength});
  const Vec3 upper = section.vector("max", {kLength});
  for (int axis = 0; axis < 3; ++axis) {
    if (std::isinf(upper[axis] - lower[axis])) {
      section.complain("max", fmt::format("component {} is {} m, further from {} m of min than any "
                                          "double can hold; expected a smaller box",
                                          "xyz"[axis], upper[axis], lower[axis]));
    }
    if (!(upper[axis] <= lower[axis])) continue;
    section.complain(
        "max",
        fmt::format("component {} is {} m, not above {} m of min; expected the larger corner",
                    "xyz"[axis], upper[axis], lower[axis]));
  }
  section.finish();
  return {lower, upper};
}

}  // namespace plekton::apps
