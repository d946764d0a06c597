// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_membrane_strength.hpp"

#include <fmt/format.h>

#include <array>
#include <sstream>
#include <string_view>

namespace plekton::apps {
namespace {

constexpr std::array<std::string_view, 4> kStrengthKeys = {"yield_stress", "hardening", "strength",
                                                           "rupture_strain"};

/// Keys that say what happens beyond the yield stress, without one.
void require_yield(Section& section, std::string_view key) {
  if (!section.has(key) || section.has("yield_stress")) return;
  section.complain(key, "says how a bar goes on beyond its yield stress; give yield_stress");
}

std::optional<dynamics::BondStrength> read_strength(Section& section) {
  bool is_given = false;
  for (const std::string_view key : kStrengthKeys) is_given = section.has(key) || is_given;
  if (!is_given) return std::nullopt;
  dynamics::BondStrength strength;
  constexpr double kNever = dynamics::BondStrength::kNever;
  strength.yield_stress = section.quantity("yield_stress", {kPressure, kPositive}, kNever);
  strength.hardening = section.quantity("hardening", {kPressure, kNotNegative}, 0.0);
  strength.strength = section.quantity("strength", {kPressure, kPositive}, kNever);
  strength.rupture_strain = section.quantity("rupture_strain", {kStrain, kPositive}, kNever);
  require_yield(section, "hardening");
  require_yield(section, "rupture_strain");
  if (section.has("yield_stress") && strength.strength < strength.yield_stress)
    section.complain(
        "strength", fmt::format("{:g} Pa is below the yield_stress of {:g} Pa: it breaks before it "
                                "yields; leave yield_stress out, or give a strength above it",
                                strength.strength, strength.yield_stress));
  return strength;
}

/// Of a sheet (Pa), without what only beams and bars have.
std::optional<double> read_tear_strength(Section& section) {
  for (const std::string_view key : {"yield_stress", "hardening", "rupture_strain"}) {
    if (section.has(key))
      section.complain(key,
                       "is of beams and bars; a continuum stays elastic until it tears at its "
                       "strength; use mode = \"lattice\" or \"truss\"");
  }
  if (!section.has("strength")) return std::nullopt;
  return section.quantity("strength", {kPressure, kPositive});
}

/// Nothing if there is no such key, or after a problem.
std::optional<dynamics::WireCurve> read_curve(Section& section, std::string_view key) {
  if (!section.has(key)) return std::nullopt;
  dynamics::WireCurve curve;
  for (const auto& [strain, force] :
       section.rising_rows(key, {kStrain, kPositive}, {kForce, kNotNegative}))
    curve.points.push_back({strain, force});
  if (curve.points.empty()) return std::nullopt;
  std::ostringstream problems;
  dynamics::list_problems(curve, "the curve", problems);
  if (problems.str().empty()) return curve;
  std::istringstream lines(problems.str());
  for (std::string line; std::getline(lines, line);) section.complain(key, line);
  return std::nullopt;
}

/// Keys that do not go with the curve of a wire.
void require_wire_alone(Section& section, const MembraneSettings& membrane) {
  if (membrane.mode != MembraneMode::truss)
    section.complain("wire",
                     "a wire is pulled and nothing else; use mode = \"truss\" (beams of mode = "
                     "\"lattice\" have yield_stress and strength)");
  for (const std::string_view key : {"young_modulus", "sheet_stiffness"}) {
    if (section.has(key))
      section.complain(key,
                       "the stiffness of wires follows from the first row of wire; leave it out");
  }
  for (const std::string_view key : kStrengthKeys) {
    if (section.has(key))
      section.complain(key, "the curve of wire says where it yields and breaks; leave it out");
  }
}

}  // namespace

void read_membrane_strength(Section& section, MembraneSettings& membrane) {
  if (membrane.mode == MembraneMode::continuum)
    membrane.tear_strength = read_tear_strength(section);
  else
    membrane.strength = read_strength(section);
  membrane.wire = read_curve(section, "wire");
  membrane.twist_wire = read_curve(section, "twist_wire");
  if (section.has("wire")) require_wire_alone(section, membrane);
  if (section.has("twist_wire")) {
    const bool has_twists =
        membrane.shape && std::holds_alternative<geometry::HexagonalNet>(*membrane.shape);
    if (!has_twists)
      section.complain("twist_wire", "only a hexagonal_net has twists; use wire alone");
    if (!section.has("wire"))
      section.complain("twist_wire", "goes with wire, the curve of the single wires; give both");
  }
}

}  // namespace plekton::apps
