// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/rounding_energy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plekton::dynamics {

double rounding_energy(const MovedScene& scene) {
  constexpr double kEps = std::numeric_limits<double>::epsilon();
  double furthest = 0.0;  // m, from the origin
  double weight = 0.0;    // J, sum of m |g.x|
  double power = 0.0;     // W, sum of |f| |v|
  double moved = 0.0;     // m/s, of what moves as prescribed
  for (std::size_t i = 0; i < scene.state.size(); ++i) {
    const Vec3& x = scene.state.position[i];
    furthest = std::max(furthest, x.cwiseAbs().maxCoeff());
    power += scene.forces.force[i].cwiseAbs().dot(scene.state.velocity[i].cwiseAbs());
    if (holds_translation(scene.properties.held[i])) {
      moved = std::max(moved, scene.state.velocity[i].norm());
      continue;
    }
    weight += scene.properties.mass[i] * scene.gravity.cwiseAbs().dot(x.cwiseAbs());
  }
  const auto steps = static_cast<double>(scene.steps);
  const double stiffness = scene.springs.translation;
  const double springs = stiffness * furthest * furthest + scene.springs.rotation;
  return 0.5 * kEps * kEps * springs * (1.0 + steps) +
         kEps * weight * (static_cast<double>(scene.state.size()) + steps) +
         kEps * power * scene.drift * steps +
         kEps * stiffness * furthest * moved * scene.drift * std::sqrt(steps);
}

}  // namespace plekton::dynamics
