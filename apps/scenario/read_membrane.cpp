// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_sections.hpp"

#include <fmt/format.h>

#include <cmath>
#include <system_error>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

constexpr Range kPoisson{-1.0, 0.5, false, true, " above -1 and at most 0.5"};

fs::path read_mesh_path(Section& section, const Known& known) {
  const std::string name = section.text("mesh");
  if (name.empty()) return {};
  fs::path path = known.folder / name;
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) {
    const std::string_view what = fs::exists(path, ignored) ? "is not a file" : "does not exist";
    section.complain(
        "mesh", fmt::format("\"{}\" {}; expected a mesh (.off, .obj, .stl, .ply, .msh, .vtp), its "
                            "path relative to the scenario",
                            path.string(), what));
  }
  return path;
}

Placement read_placement(Section& section) {
  Placement placement;
  placement.scale = section.quantity("scale", {kNumber, kPositive}, placement.scale);
  placement.translation = section.vector("translate", {kLength}, placement.translation);
  if (auto rotate = section.table("rotate")) {
    placement.axis = rotate->vector("axis", {kNumber}, placement.axis);
    placement.angle = rotate->quantity("angle", {kAngle});
    if (placement.axis.stableNorm() == 0.0)
      rotate->complain("axis", "got a vector of no length; expected a direction");
    placement.axis.stableNormalize();
    rotate->finish();
  }
  return placement;
}

HoldSettings read_hold(Section& section) {
  constexpr std::array<std::string_view, 3> kWords = {"none", "rim", "all"};
  constexpr std::array kMeanings = {HoldWhich::none, HoldWhich::rim, HoldWhich::all};
  HoldSettings hold;
  if (section.is_table("hold")) {
    hold.which = HoldWhich::box;
    hold.box = read_box(*section.table("hold"));
  } else {
    hold.which = kMeanings[section.choice("hold", kWords, 0)];
  }
  hold.rotation = section.truth("hold_rotation", hold.rotation);
  hold.velocity = section.vector("velocity", {kVelocity}, hold.velocity);
  if (hold.which == HoldWhich::none && (hold.rotation || section.has("velocity"))) {
    section.complain("hold", "hold_rotation and velocity say what held nodes do, but none is held");
  }
  return hold;
}

/// Reads one of two keys that say the same in two ways. @returns the first, or nothing if the
/// second is given
std::optional<double> read_either(Section& section, std::pair<std::string_view, Quantity> first,
                                  std::pair<std::string_view, Quantity> second,
                                  double& second_value) {
  const bool has_first = section.has(first.first);
  const bool has_second = section.has(second.first);
  if (has_first == has_second) {
    section.complain(first.first,
                     fmt::format("got {} of {} and {}; expected exactly one of them",
                                 has_first ? "both" : "none", first.first, second.first));
  }
  if (has_second) second_value = section.quantity(second.first, second.second);
  if (has_first) return section.quantity(first.first, first.second);
  return std::nullopt;
}

}  // namespace

MembraneSettings read_membrane(Section section, const Known& known) {
  constexpr std::array<std::string_view, 2> kMassModes = {"edge", "area"};
  MembraneSettings membrane;
  membrane.name = section.text("name", "membrane");
  membrane.mesh = read_mesh_path(section, known);
  membrane.mesh_place = section.place_of("mesh");
  membrane.weld = section.quantity("weld", {kLength, kNotNegative}, membrane.weld);
  membrane.placement = read_placement(section);
  membrane.thickness = section.quantity("thickness", {kLength, kPositive});
  membrane.material = read_material_of(section, known).value_or(0);
  membrane.young_modulus =
      read_either(section, {"young_modulus", {kPressure, kPositive}},
                  {"sheet_stiffness", {kStiffness, kPositive}}, membrane.sheet_stiffness);
  membrane.poisson_ratio =
      section.quantity("poisson_ratio", {kNumber, kPoisson}, membrane.poisson_ratio);
  membrane.mass_mode = static_cast<MassMode>(section.choice("mass_mode", kMassModes, 0));
  membrane.density = read_either(section, {"density", {kDensity, kPositive}},
                                 {"areal_mass", {kArealMass, kPositive}}, membrane.areal_mass);
  membrane.hold = read_hold(section);
  section.finish();
  return membrane;
}

}  // namespace plekton::apps
