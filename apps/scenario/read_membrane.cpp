// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_membrane_source.hpp"
#include "apps/scenario/read_membrane_strength.hpp"
#include "apps/scenario/read_placement.hpp"
#include "geometry/base/rotation_about.hpp"

#include <fmt/format.h>

namespace plekton::apps {
namespace {

constexpr Range kPrestrain{-0.5, 0.5, true, true, " from -0.5 to 0.5"};
constexpr Range kPoisson{-1.0, 0.5, false, true, " above -1 and at most 0.5"};

HoldSettings read_hold(Section& section) {
  constexpr std::array<std::string_view, 3> kWords = {"none", "rim", "all"};
  constexpr std::array kMeanings = {HoldWhich::none, HoldWhich::rim, HoldWhich::all};
  HoldSettings hold;
  if (section.is_table("hold", box_type())) {
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

/// How it is stretched at the start.
void read_rest(Section& section, MembraneSettings& membrane) {
  membrane.prestrain = section.quantity("prestrain", {kStrain, kPrestrain}, membrane.prestrain);
  membrane.rest_pressure = section.quantity("rest_pressure", {kPressure}, membrane.rest_pressure);
  if (!section.has("rest_pressure")) return;
  if (section.has("prestrain"))
    section.complain("rest_pressure",
                     "prestrain says already how it is stretched at the start; leave one of them "
                     "out");
  if (membrane.shape && is_net(*membrane.shape))
    section.complain("rest_pressure",
                     "a net has no facets for a pressure to act on; give a prestrain");
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

/// Keys that do not go with the mode.
void require_mode(Section& section, const MembraneSettings& membrane) {
  if (membrane.mode != MembraneMode::continuum) {
    if (section.has("bending_stiffness"))
      section.complain("bending_stiffness",
                       "goes with mode = \"continuum\"; in a lattice it follows from the beams, "
                       "and a truss has none");
    return;
  }
  if (membrane.shape && has_bars(*membrane.shape))
    section.complain("mode", "the bars beside the facets are beams; use \"lattice\" or \"truss\"");
  if (membrane.shape && is_net(*membrane.shape))
    section.complain("mode",
                     "a net has no facets that could be a sheet; use \"lattice\" or \"truss\"");
}

/// A velocity for each point of a shape that tells its points.
void read_initial_velocities(Section& section, MembraneSettings& membrane) {
  // Instead of those of an ON-DEM file.
  if (section.has("initial_velocity")) membrane.initial_velocities.clear();
  if (!section.has("initial_velocities")) return;
  if (section.has("initial_velocity"))
    section.complain("initial_velocity",
                     "initial_velocities says how each node moves; leave one of them out");
  const std::size_t points = membrane.shape ? told_points(*membrane.shape) : 0;
  membrane.initial_velocities = section.vectors("initial_velocities", {kVelocity}, 1);
  if (points == 0)
    section.complain("initial_velocities",
                     "goes with a shape of kind facets or bars, one for each of its points");
  else if (!membrane.initial_velocities.empty() && membrane.initial_velocities.size() != points)
    section.complain("initial_velocities",
                     fmt::format("got a list of {}; expected one for each of the {} points",
                                 membrane.initial_velocities.size(), points));
}

/// Keys that ask for what a net, a closed shape or a wrapped mesh does not have.
void require_parts(Section& section, const MembraneSettings& membrane) {
  if (membrane.shape && is_net(*membrane.shape)) {
    if (section.has("sheet_stiffness"))
      section.complain(
          "sheet_stiffness",
          "a net is no sheet; give the young_modulus of its bars: of bars at a pitch p "
          "that together have the stiffness J, E = J p / (pi thickness^2 / 4)");
    if (is_chain(*membrane.shape) && section.has("areal_mass"))
      section.complain("areal_mass",
                       "a chain has no area, nor have single bars; give their density");
    if (membrane.mass_mode == MassMode::area)
      section.complain("mass_mode",
                       "a net has no facets to weigh; leave mass_mode out: half the mass of each "
                       "bar goes to either end");
  }
  if (membrane.shape && has_bars(*membrane.shape) && membrane.mass_mode == MassMode::area)
    section.complain("mass_mode", "the bars beside the facets would have no mass; use \"edge\"");
  const bool closed = membrane.shape ? is_closed(*membrane.shape) : membrane.repair.wrap;
  if (closed && membrane.hold.which == HoldWhich::rim)
    section.complain("hold", fmt::format("a {} is closed and has no rim; hold the nodes in a box, "
                                         "hold = {{ min = [...], max = [...] }}",
                                         membrane.shape ? "sphere or box" : "wrapped mesh"));
}

}  // namespace

MembraneSettings read_membrane(Section section, const Known& known) {
  constexpr std::array<std::string_view, 2> kMassModes = {"edge", "area"};
  constexpr std::array<std::string_view, 2> kNodalInertias = {"ball", "length"};
  constexpr std::array<std::string_view, 3> kModes = {"lattice", "truss", "continuum"};
  MembraneSettings membrane;
  membrane.name = section.name("name", "membrane");
  read_membrane_source(section, known, membrane);
  membrane.placement = read_placement(section);
  // Of an ON-DEM file: what is turned moves on as it did.
  const geometry::Mat3 rotation =
      geometry::rotation_about(membrane.placement.axis, membrane.placement.angle);
  for (Vec3& velocity : membrane.initial_velocities) velocity = rotation * velocity;
  membrane.mode = static_cast<MembraneMode>(section.choice("mode", kModes, 0));
  const bool is_sheet = membrane.mode == MembraneMode::continuum;
  membrane.thickness = section.quantity("thickness", {kLength, kPositive});
  membrane.material = read_material_of(section, known).value_or(0);
  read_membrane_strength(section, membrane);
  if (!section.has("wire")) {
    membrane.young_modulus =
        read_either(section, {"young_modulus", {kPressure, kPositive}},
                    {"sheet_stiffness", {kStiffness, kPositive}}, membrane.sheet_stiffness);
  }
  membrane.poisson_ratio =
      section.quantity("poisson_ratio", {kNumber, kPoisson}, membrane.poisson_ratio);
  read_rest(section, membrane);
  if (section.has("bending_stiffness"))
    membrane.bending_stiffness =
        section.quantity("bending_stiffness", {kBendingStiffness, kNotNegative});
  section.tell_default("mass_mode", "\"edge\"; of a continuum \"area\"");
  membrane.mass_mode =
      static_cast<MassMode>(section.choice("mass_mode", kMassModes, is_sheet ? 1 : 0));
  membrane.nodal_inertia =
      static_cast<dynamics::NodalInertia>(section.choice("nodal_inertia", kNodalInertias, 0));
  membrane.density = read_either(section, {"density", {kDensity, kPositive}},
                                 {"areal_mass", {kArealMass, kPositive}}, membrane.areal_mass);
  membrane.hold = read_hold(section);
  membrane.initial_velocity =
      section.vector("initial_velocity", {kVelocity}, membrane.initial_velocity);
  read_initial_velocities(section, membrane);
  require_parts(section, membrane);
  require_mode(section, membrane);
  section.finish();
  return membrane;
}

}  // namespace plekton::apps
