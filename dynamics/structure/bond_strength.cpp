// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/bond_strength.hpp"

#include <cmath>
#include <ostream>

namespace plekton::dynamics {
namespace {

constexpr double kSqrt3 = std::numbers::sqrt3;

}  // namespace

void list_problems(const BondStrength& s, std::string_view name, std::ostream& problems) {
  const auto require_positive = [&](const char* what, double value, const char* unit) {
    if (value > 0.0) return;  // infinite: never reached
    problems << name << ": " << what << " is " << value << unit << "; it must be positive\n";
  };
  require_positive("yield stress", s.yield_stress, " Pa");
  require_positive("shear yield stress", s.shear_yield_stress.value_or(1.0), " Pa");
  require_positive("moment ratio", s.moment_ratio, "");
  require_positive("strength", s.strength, " Pa");
  require_positive("shear strength", s.shear_strength.value_or(1.0), " Pa");
  require_positive("rupture strain", s.rupture_strain, "");
  if (!(s.hardening >= 0.0) || !std::isfinite(s.hardening)) {
    problems
        << name << ": hardening is " << s.hardening
        << " Pa; it must be zero or positive, and finite: a bond that gets weaker as it yields "
           "would fail in one place, however small the bonds are\n";
  }
}

BondLimits limits_of(const BondStrength& strength, const BeamBond& bond) noexcept {
  const BeamSection& section = bond.section;
  const double radius = 2.0 * std::sqrt(section.second_moment / section.area);
  const bool is_bar = radius == 0.0;
  const double bending = is_bar ? 0.0 : section.second_moment / radius;
  const double torsion = is_bar ? 0.0 : section.torsion_constant / radius;
  const double shear_yield = strength.shear_yield_stress.value_or(strength.yield_stress / kSqrt3);
  const double per_length = strength.hardening / bond.length;
  const auto limit = [](double modulus, double stress, double hardening) {
    return modulus > 0.0 ? YieldLimit{modulus * stress, hardening}
                         : YieldLimit{BondStrength::kNever, 0.0};
  };
  return {limit(section.area, strength.yield_stress, section.area * per_length),
          limit(bending, strength.moment_ratio * strength.yield_stress,
                2.0 * section.second_moment * per_length),
          limit(torsion, shear_yield, section.torsion_constant * per_length / 3.0),
          section.area,
          bending,
          torsion,
          radius,
          bond.length,
          strength.strength,
          strength.shear_strength.value_or(strength.strength / kSqrt3),
          strength.rupture_strain};
}

}  // namespace plekton::dynamics
