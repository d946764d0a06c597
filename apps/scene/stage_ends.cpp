// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scene/stage_ends.hpp"

#include "apps/scene/node_set.hpp"

#include <fmt/format.h>

#include <cmath>

namespace plekton::apps {

void require_apart(const StageEnd& end, const BuiltScene& built) {
  if (!end.strain || !end.strain->are_rigid_bodies) return;
  const BuiltRigidBody& a = rigid_body_of(end.strain->of[0], built);
  const BuiltRigidBody& b = rigid_body_of(end.strain->of[1], built);
  const auto& x = built.scene.state.position;
  const double distance = (x[geometry::index_of(b.node)] - x[geometry::index_of(a.node)]).norm();
  const auto size = [](const BuiltRigidBody& body) {
    return body.mass.mass > 0.0 ? std::sqrt(body.moments.sum() / body.mass.mass) : 0.0;
  };
  constexpr double kRounding = 1e-9;  // of their size, as sides of bodies are found
  if (distance > kRounding * (size(a) + size(b))) return;
  throw InputError(fmt::format(
      "{}: the strain between two bodies: the centres of \"{}\" and \"{}\" are {:.3g} m apart "
      "where it begins, so that there is no length to compare with; name two bodies that lie "
      "apart, "
      "or ask for a displacement",
      to_string(end.strain->place), a.name, b.name, distance));
}

}  // namespace plekton::apps
