// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scene/membrane_builder.hpp"

#include "apps/scene/membrane_body.hpp"
#include "apps/scene/node_set.hpp"
#include "dynamics/loads/pressed_rest_state.hpp"
#include "dynamics/structure/lumped_mass.hpp"
#include "geometry/primitives/node_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <tuple>

namespace plekton::apps {
namespace {

using dynamics::Held;
using geometry::index_of;
using geometry::Membrane;

struct EdgeLengths {
  double total = 0.0;     ///< m
  double of_sheet = 0.0;  ///< m, of those that are sides of facets; of all where there is none
  double shortest = std::numeric_limits<double>::infinity();  ///< m
};

EdgeLengths edge_lengths(const dynamics::Scene& scene, const Membrane& membrane) {
  const geometry::NodeSets<2> sides = geometry::set_of_sides(membrane.facets);
  EdgeLengths lengths;
  for (const auto& [a, b] : membrane.edges) {
    const double length =
        (scene.state.position[index_of(b)] - scene.state.position[index_of(a)]).norm();
    lengths.total += length;
    if (sides.empty() || sides.contains({a, b})) lengths.of_sheet += length;
    lengths.shortest = std::min(lengths.shortest, length);
  }
  return lengths;
}

std::vector<bool> held_nodes(const HoldSettings& hold, const MembraneBody& body) {
  if (hold.which == HoldWhich::rim) return body.on_rim;
  std::vector<bool> held(body.on_rim.size(), hold.which == HoldWhich::all);
  if (hold.which != HoldWhich::box) return held;
  const geometry::Box box = with_rounding(hold.box, body.membrane.nodes);
  for (std::size_t i = 0; i < held.size(); ++i) held[i] = is_within(box, body.membrane.nodes[i]);
  return held;
}

/// Whether the structure turns its nodes. Where nothing does, contacts would spin them freely.
bool turns_nodes(const MembraneSettings& settings) {
  return settings.mode != MembraneMode::truss && settings.bending_stiffness != 0.0;
}

/// @returns How many of them are held.
std::size_t add_nodes(const MembraneSettings& settings, const MembraneBody& body,
                      BuiltScene& built) {
  const std::size_t first_node = built.scene.state.size();
  const Held free = turns_nodes(settings) ? Held::nothing : Held::rotation;
  for (const Vec3& position : body.membrane.nodes) built.scene.add_node(position, free);
  const std::vector<bool> held = held_nodes(settings.hold, body);
  for (std::size_t i = 0; i < held.size(); ++i) {
    built.scene.state.velocity[first_node + i] = settings.initial_velocities.empty()
                                                     ? settings.initial_velocity
                                                     : settings.initial_velocities[i];
    if (!held[i]) continue;
    built.scene.properties.held[first_node + i] =
        settings.hold.rotation ? Held::everything : Held::translation | free;
    built.scene.state.velocity[first_node + i] = settings.hold.velocity;
  }
  const auto count = static_cast<std::size_t>(std::count(held.begin(), held.end(), true));
  if (count == 0 && settings.hold.which == HoldWhich::rim) {
    throw InputError(fmt::format(
        "\"{}\" has no rim to hold: {}; hold the nodes in a box{}", settings.name,
        body.membrane.facets.empty() ? "none of its points has one bar only" : "its mesh is closed",
        settings.repair.fill_holes ? ", or fill no hole as long as the rim (longest_hole)" : ""));
  }
  if (count == 0 && settings.hold.which == HoldWhich::box) {
    throw InputError(
        fmt::format("\"{}\" has no node in the box of hold; the box counts in the scene, after "
                    "scale, rotate and translate",
                    settings.name));
  }
  return count;
}

/// Sheet stiffness to modulus of the beams.
///
/// Under a strain e that is the same in all directions each beam of section A stores 1/2 E A L e²,
/// a sheet of stiffness J and Poisson ratio 1/3 (that of a lattice) 1/2 2 J e² / (1 - 1/3) for each
/// of its area; so E = 3 J area / (A sum L). For the equilateral lattice that is J = 2 E A /
/// (sqrt(3) L).
double beam_modulus(double sheet_stiffness, double area, double section_area, double length) {
  return 3.0 * sheet_stiffness * area / (section_area * length);
}

/// Scales, thicknesses and moduli so extreme that nothing can be computed with them.
/// @throws InputError
void require_computable(const BuiltMembrane& built, double shortest_edge) {
  for (const auto& [what, value, unit] :
       {std::tuple{"area", built.facets > 0 ? built.area : 1.0, "m2"},
        std::tuple{"mass", built.mass, "kg"},
        std::tuple{"its Young's modulus", built.young_modulus, "Pa"},
        std::tuple{"length of its shortest edge", shortest_edge, "m"}}) {
    if (std::isnormal(value) && value > 0.0) continue;
    throw InputError(fmt::format(
        "\"{}\": {} is {} {}; expected a positive number that is not extreme; check scale, "
        "translate, thickness, stiffness and density against the size of the mesh",
        built.name, what, value, unit));
  }
}

/// What a membrane weighs, and what its mode makes of that.
struct Masses {
  double total;   ///< kg
  double edges;   ///< kg/m³, of a round bar along each edge; 0 in area mode
  double facets;  ///< kg/m³, of a plate in each facet; 0 in edge mode
};

/// @param section  m², of an edge
Masses masses_of(const MembraneSettings& settings, double area, double section,
                 const EdgeLengths& lengths) {
  const double areal_mass =
      settings.density ? *settings.density * settings.thickness : settings.areal_mass;
  if (settings.mass_mode == MassMode::area)
    return {areal_mass * area, 0.0, areal_mass / settings.thickness};
  const double density =
      settings.density.value_or(areal_mass * area / (section * lengths.of_sheet));
  return {density * (section * lengths.total), density, 0.0};
}

/// The section of all edges of a membrane but for wires.
dynamics::BeamSection section_of(const MembraneSettings& settings, const BuiltMembrane& built) {
  const double radius = 0.5 * settings.thickness;
  return settings.mode == MembraneMode::truss
             ? dynamics::bar_section(radius, built.young_modulus)
             : dynamics::circular_section(radius, built.young_modulus, settings.poisson_ratio);
}

/// Adds the cylinders with their beams, bars or wires.
void add_edges(const MembraneSettings& settings, const MembraneBody& body,
               const BuiltMembrane& built, double density, dynamics::Scene& scene) {
  const double radius = 0.5 * settings.thickness;
  const dynamics::BeamSection section = section_of(settings, built);
  std::vector<std::size_t> plain, twists;
  for (std::size_t i = 0; i < body.membrane.edges.size(); ++i) {
    const auto& [a, b] = body.membrane.edges[i];
    const bool is_twist = settings.twist_wire && body.is_twist[i];
    scene.add_cylinder(a, b, radius, static_cast<contact::MaterialId>(settings.material));
    const std::size_t bond = scene.add_beam(
        a, b, is_twist ? dynamics::wire_section(radius, *settings.twist_wire) : section, density,
        settings.nodal_inertia);
    scene.bonds[bond].length /= 1.0 + settings.prestrain;
    (is_twist ? twists : plain).push_back(bond);
  }
  if (settings.strength) scene.bond_laws.push_back({*settings.strength, plain});
  if (settings.wire) scene.bond_laws.push_back({*settings.wire, std::move(plain)});
  if (!twists.empty()) scene.bond_laws.push_back({*settings.twist_wire, std::move(twists)});
}

/// Adds what resists in the facets of a sheet, and the mass of its edges.
void add_sheet(const MembraneSettings& settings, const Membrane& membrane,
               const BuiltMembrane& built, double density, dynamics::Scene& scene) {
  dynamics::SheetSection section =
      dynamics::solid_sheet(settings.thickness, built.young_modulus, settings.poisson_ratio);
  section.bending_stiffness = settings.bending_stiffness.value_or(section.bending_stiffness);
  section.strength = settings.tear_strength.value_or(section.strength);
  for (const geometry::Facet& facet : membrane.facets) {
    const std::size_t sheet = scene.add_sheet_facet(facet.nodes, section, 0.0);
    for (dynamics::Vec2& corner : scene.sheet_facets[sheet].corners)
      corner /= 1.0 + settings.prestrain;
  }
  for (const auto& edge : membrane.edges) {
    dynamics::add_edge_mass(scene.properties, edge, scene.state.position, 0.5 * settings.thickness,
                            density, settings.nodal_inertia);
  }
}

/// Adds the cylinders, beams and facets, and with them the mass.
void add_elements(const MembraneSettings& settings, const MembraneBody& body,
                  dynamics::Scene& scene, BuiltMembrane& result) {
  const Membrane& membrane = body.membrane;
  const double radius = 0.5 * settings.thickness;
  const double section_area = std::numbers::pi * radius * radius;
  const EdgeLengths lengths = edge_lengths(scene, membrane);
  result.mean_edge = lengths.total / static_cast<double>(membrane.edges.size());
  const bool is_sheet = settings.mode == MembraneMode::continuum;
  result.young_modulus = settings.young_modulus.value_or(
      settings.wire ? settings.wire->first_slope() / section_area
      : is_sheet
          ? settings.sheet_stiffness / settings.thickness
          : beam_modulus(settings.sheet_stiffness, result.area, section_area, lengths.of_sheet));
  const Masses masses = masses_of(settings, result.area, section_area, lengths);
  result.mass = masses.total;

  require_computable(result, lengths.shortest);

  if (is_sheet)
    add_sheet(settings, membrane, result, masses.edges, scene);
  else
    add_edges(settings, body, result, masses.edges, scene);
  for (const geometry::Facet& facet : membrane.facets) {
    scene.add_facet(facet.nodes[0], facet.nodes[1], facet.nodes[2], radius,
                    static_cast<contact::MaterialId>(settings.material));
    dynamics::add_facet_mass(scene.properties, facet, scene.state.position, masses.facets,
                             settings.nodal_inertia);
  }
}

/// Of what was added last. The nodes that the membrane holds are its supports: what loads and stages
/// hold and free comes later, and every stage builds the membrane as it was drawn.
/// @throws InputError where it cannot stand so
void stand_under_pressure(const MembraneSettings& settings, const dynamics::PressedPart& part,
                          BuiltScene& built) {
  if (settings.rest_pressure == 0.0) return;
  try {
    const dynamics::PressedRest rest =
        dynamics::rest_under_pressure(settings.rest_pressure, part, built.scene);
    if (rest.compressed == 0.0) return;
    built.warnings.push_back(fmt::format(
        "{}: under its rest_pressure {:.3g} % of {} is pushed together at the start, where it "
        "may buckle or wrinkle; other curvatures, or a stage with damping that lets it settle, "
        "would have it stretched all over",
        settings.name, 100.0 * rest.compressed,
        settings.mode == MembraneMode::continuum ? "its area" : "the length of its beams or bars"));
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("rest_pressure: {}", error.what()));
  }
}

}  // namespace

BuiltMembrane add_membrane(const MembraneSettings& settings, BuiltScene& built) {
  const std::size_t first_node = built.scene.state.size();
  MembraneBody body = make_membrane_body(settings, first_node);
  tell_warnings(settings.name, body, built.warnings);

  BuiltMembrane result;
  result.name = settings.name;
  result.report = std::move(body.report);
  result.first_node = first_node;
  result.nodes = body.membrane.nodes.size();
  result.facets = body.membrane.facets.size();
  result.cylinders = settings.mode == MembraneMode::continuum ? 0 : body.membrane.edges.size();
  result.beams = result.cylinders;
  result.on_rim = body.on_rim;
  result.area = body.area;
  result.held_nodes = add_nodes(settings, body, built);
  result.turns_nodes = turns_nodes(settings);
  const dynamics::PressedPart part{built.scene.elements.facets.size(),
                                   built.scene.sheet_facets.size(), built.scene.bonds.size()};
  add_elements(settings, body, built.scene, result);
  stand_under_pressure(settings, part, built);
  result.sheet_facets = built.scene.sheet_facets.size() - part.first_sheet;
  return result;
}

}  // namespace plekton::apps
