// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/beam_bond.hpp"

#include "dynamics/structure/beam_rows.hpp"
#include "geometry/base/elementary.hpp"
#include "geometry/base/problems.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <ostream>
#include <sstream>
#include <string>

namespace plekton::dynamics {
namespace {

/// The shortest rotation from the x axis to a chord; half a turn about z where they are opposite.
///
/// For a unit direction (x, y, z) it is (1 + x, 0, -z, y), normalised. Next to x = -1 the sum
/// cancels, so there it is taken from 1 + x = r² / (1 - x) with r² = y² + z², and all is divided by
/// r.
Quat frame_along(const Vec3& chord) {
  const Vec3 direction = chord.stableNormalized();
  const double x = direction[0], y = direction[1], z = direction[2];
  if (x >= 0.0) return Quat(1.0 + x, 0.0, -z, y).normalized();
  const double r = elementary::hypot(y, z);
  if (r == 0.0) return {0.0, 0.0, 0.0, 1.0};
  return Quat(r / (1.0 - x), 0.0, -z / r, y / r).normalized();
}

/// One quantity of a bond that has to be finite and above (or at) zero.
struct Quantity {
  const char* name;
  double value;
  const char* unit;
  bool may_be_zero;
};

void list_quantities(const BeamBond& bond, const std::string& where, std::ostream& problems) {
  const BeamSection& section = bond.section;
  const std::array<Quantity, 6> quantities{{
      {"length at rest", bond.length, " m", false},
      {"Young's modulus", section.young_modulus, " Pa", false},
      {"shear modulus", section.shear_modulus, " Pa", false},
      {"area", section.area, " m2", false},
      {"second moment", section.second_moment, " m4", true},
      {"torsion constant", section.torsion_constant, " m4", true},
  }};
  for (const Quantity& q : quantities) {
    const bool is_good = std::isfinite(q.value) && (q.may_be_zero ? q.value >= 0.0 : q.value > 0.0);
    if (is_good) continue;
    problems << where << ": " << q.name << " is " << q.value << q.unit << "; it must be "
             << (q.may_be_zero ? "zero or positive" : "positive") << " and finite\n";
  }
}

}  // namespace

BeamSection circular_section(double radius, double young_modulus, double poisson_ratio) noexcept {
  const double area = std::numbers::pi * radius * radius;
  const double second_moment = 0.25 * area * radius * radius;
  return {young_modulus, 0.5 * young_modulus / (1.0 + poisson_ratio), area, second_moment,
          2.0 * second_moment};
}

BeamSection bar_section(double radius, double young_modulus) noexcept {
  return {young_modulus, 0.5 * young_modulus, std::numbers::pi * radius * radius, 0.0, 0.0};
}

void list_problems(const BeamBond& bond, std::size_t node_count, std::string_view name,
                   std::ostream& problems) {
  const auto a = static_cast<std::int32_t>(bond.nodes[0]);
  const auto b = static_cast<std::int32_t>(bond.nodes[1]);
  std::ostringstream prefix;
  prefix << name << " (nodes " << a << ", " << b << ")";
  const std::string where = prefix.str();
  for (const std::int32_t node : {a, b}) {
    if (node >= 0 && static_cast<std::size_t>(node) < node_count) continue;
    problems << where << ": there is no node " << node << ", only " << node_count << " nodes\n";
  }
  if (a == b) problems << where << ": both ends are the same node; delete the bond\n";
  list_quantities(bond, where, problems);
  for (const Quat& rest : {bond.rest_a, bond.rest_b}) {
    constexpr double kTolerance = 1e-9;  // far above rounding, far below any real mistake
    if (std::abs(rest.squaredNorm() - 1.0) < kTolerance) continue;
    problems << where << ": its rotation at rest is not a unit quaternion; normalise it\n";
  }
}

BeamBond make_beam(NodeId a, NodeId b, const NodeState& at_rest, const BeamSection& section) {
  std::ostringstream problems;
  BeamBond bond{{a, b}, 1.0, section, Quat::Identity(), Quat::Identity()};
  list_problems(bond, at_rest.size(), "beam", problems);
  geometry::throw_if_any(problems);

  const Vec3 chord = at_rest.position[index_of(b)] - at_rest.position[index_of(a)];
  const Quat frame = frame_along(chord);
  bond.length = chord.norm();
  bond.rest_a = at_rest.orientation[index_of(a)].conjugate() * frame;
  bond.rest_b = at_rest.orientation[index_of(b)].conjugate() * frame;
  list_problems(bond, at_rest.size(), "beam", problems);
  geometry::throw_if_any(problems);
  return bond;
}

BeamSpringOf<double> spring_of(const BeamBond& bond) noexcept {
  const BeamSection& s = bond.section;
  return {bond.length,
          s.young_modulus * s.area / bond.length,
          s.young_modulus * s.second_moment / bond.length,
          s.shear_modulus * s.torsion_constant / bond.length,
          detail::numbers_of(bond.rest_a),
          detail::numbers_of(bond.rest_b)};
}

}  // namespace plekton::dynamics
