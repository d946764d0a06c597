// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/bond_stress.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plekton::dynamics {

BondStress bond_stress(const BondForces& forces, const BeamSection& section) noexcept {
  const double radius = std::sqrt(section.area / std::numbers::pi);
  const double moment = std::max(forces.moment_a.norm(), forces.moment_b.norm());
  BondStress stress;
  stress.axial = forces.tension / section.area;
  if (section.second_moment > 0.0) stress.bending = moment * radius / section.second_moment;
  if (section.torsion_constant > 0.0)
    stress.torsion = std::abs(forces.torque) * radius / section.torsion_constant;
  return stress;
}

}  // namespace plekton::dynamics
