// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scene/rigid_builder.hpp"

#include "apps/scene/membrane_body.hpp"
#include "dynamics/loads/surface_pressure_check.hpp"
#include "dynamics/model/scene_figures.hpp"
#include "dynamics/rigid/bar_moments.hpp"
#include "dynamics/rigid/sphere_union.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace plekton::apps {
namespace {

using dynamics::MassProperties;
using dynamics::VolumeMoments;
using geometry::NodeId;

/// The volume of a body, and what that is.
struct BodyVolume {
  VolumeMoments moments;
  Vec3 origin = Vec3::Zero();  ///< m, about which they are
  std::string what;
};

/// What a solid of this size (m) encloses at least, below which it is none: beyond rounding.
double least_volume(double size) {
  constexpr double kRounding = 1e-12;
  return kRounding * size * size * size;
}

/// Whether nothing follows from the shape.
bool is_told(const RigidBodySettings& body) {
  return body.mass && body.inertia && body.centre;
}

using Bars = std::vector<std::array<NodeId, 2>>;

/// What is bars of a body of bars, or of facets and bars beside them.
Bars bars_of(const MembraneSettings& settings, const geometry::Membrane& surface,
             std::size_t first_node) {
  if (surface.facets.empty()) return surface.edges;
  Bars bars;
  if (!settings.shape || !has_bars(*settings.shape)) return bars;
  for (const auto& [a, b] : std::get<FacetShape>(*settings.shape).bars)
    bars.push_back({geometry::id_at<NodeId>(index_of(a) + first_node),
                    geometry::id_at<NodeId>(index_of(b) + first_node)});
  return bars;
}

/// Of facets, without the bars beside them.
BodyVolume volume_of_facets(const RigidBodySettings& body, const geometry::Membrane& surface,
                            double thickness, const dynamics::Scene& scene) {
  std::vector<std::array<NodeId, 3>> corners;
  for (const geometry::Facet& facet : surface.facets) corners.push_back(facet.nodes);
  const bool is_closed = dynamics::are_closed(surface.facets);
  // Without a mass the middle of the facets is as good a centre as any.
  const bool has_mass = body.density || body.mass;
  const bool is_solid = has_mass && (body.filling == RigidFilling::solid ||
                                     (body.filling == RigidFilling::by_itself && is_closed));
  BodyVolume volume;
  Vec3 lower = surface.nodes.front(), upper = lower;
  for (const Vec3& x : surface.nodes) {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  volume.origin = 0.5 * (lower + upper);
  const geometry::Positions x = scene.state.position;
  if (is_told(body) || surface.facets.empty()) return volume;
  if (!is_solid) {
    volume.what = fmt::format("a shell of {:.4g} m", thickness);
    volume.moments = dynamics::shell_moments(x, corners, thickness, volume.origin);
    return volume;
  }
  if (!is_closed)
    throw InputError(
        "its mesh is open and encloses no volume; close it (fill_holes), or let it be a shell, "
        "filling = \"shell\"");
  volume.what =
      "a solid of the volume that its mesh encloses, without half its thickness around it";
  volume.moments = dynamics::solid_moments(x, corners, volume.origin);
  if (!(volume.moments.volume > least_volume((upper - lower).norm())))
    throw InputError(
        "its mesh encloses no volume, so that it has no mass; expected a closed surface around "
        "one, or mass, inertia and centre, or filling = \"shell\"");
  return volume;
}

/// @param thickness  m, of facets, and diameter of bars
BodyVolume volume_of(const RigidBodySettings& body, const geometry::Membrane& surface,
                     const Bars& bars, double thickness, const dynamics::Scene& scene) {
  BodyVolume volume = volume_of_facets(body, surface, thickness, scene);
  if (is_told(body) || bars.empty()) return volume;
  volume.what += fmt::format("{}solid bars of {:.4g} m, without their round ends",
                             volume.what.empty() ? "" : ", and ", thickness);
  volume.moments +=
      dynamics::bar_moments(scene.state.position, bars, 0.5 * thickness, volume.origin);
  return volume;
}

MassProperties mass_properties(const RigidBodySettings& body, const BodyVolume& volume) {
  if (is_told(body)) return {*body.mass, *body.centre, body.inertia->asDiagonal()};
  // A density of 1 for the centre, where nothing is told as nothing may move.
  MassProperties mass =
      dynamics::mass_of(volume.moments, body.density.value_or(1.0), volume.origin);
  if (body.mass) mass = dynamics::scaled_to(mass, *body.mass);
  if (body.inertia) mass.inertia = body.inertia->asDiagonal();
  if (body.centre) mass.centre = *body.centre;
  if (!body.mass && !body.density) {
    mass.mass = 0.0;
    mass.inertia.setZero();
  }
  const bool is_sound = mass.centre.allFinite() && mass.inertia.allFinite();
  const bool has_mass = std::isnormal(mass.mass) && std::isnormal(mass.inertia.trace());
  if (is_sound && (has_mass || (!body.mass && !body.density))) return mass;
  throw InputError(
      fmt::format("its mass is {} kg, from which nothing can be computed; check "
                  "scale, thickness and density against its size",
                  mass.mass));
}

/// @param table  of the body, among [[rigid_bodies]]
void add_body(const RigidBodySettings& body, std::size_t table, const std::vector<NodeId>& nodes,
              const BodyVolume& volume, BuiltScene& built) {
  const MassProperties mass = mass_properties(body, volume);
  const std::size_t number = built.scene.add_rigid_body(nodes, mass, body.held);
  const NodeId reference = built.scene.rigid_bodies[number].node;
  built.scene.state.velocity[index_of(reference)] = body.velocity;
  built.scene.state.angular_velocity[index_of(reference)] = body.angular_velocity;
  built.rigid_bodies.push_back({table, body.name, reference,
                                built.scene.state.orientation[index_of(reference)], body.held, mass,
                                built.scene.rigid_bodies[number].moments,
                                body.inertia ? "as told" : volume.what, body.is_absent});
}

}  // namespace

void add_rigid_surface(const RigidBodySettings& body, const MembraneSettings& settings,
                       BuiltScene& built) {
  dynamics::Scene& scene = built.scene;
  const std::size_t first_node = scene.state.size();
  MembraneBody surface = make_membrane_body(settings, first_node);
  tell_warnings(settings.name, surface, built.warnings);
  std::vector<NodeId> nodes;
  for (const Vec3& place : surface.membrane.nodes)
    nodes.push_back(scene.add_node(place, dynamics::Held::everything));
  const auto material = static_cast<contact::MaterialId>(settings.material);
  for (const geometry::Facet& facet : surface.membrane.facets)
    scene.add_facet(facet.nodes[0], facet.nodes[1], facet.nodes[2], facet.radius, material);
  const Bars bars = bars_of(settings, surface.membrane, first_node);
  for (const auto& [a, b] : bars) scene.add_cylinder(a, b, 0.5 * settings.thickness, material);
  add_body(body, settings.rigid_body.value(), nodes,
           volume_of(body, surface.membrane, bars, settings.thickness, scene), built);

  BuiltMembrane result;
  result.name = settings.name;
  result.report = std::move(surface.report);
  result.first_node = first_node;
  result.nodes = nodes.size();
  result.facets = surface.membrane.facets.size();
  result.cylinders = bars.size();
  result.on_rim = std::move(surface.on_rim);
  result.held_nodes = nodes.size();
  result.area = surface.area;
  result.mass = built.rigid_bodies.back().mass.mass;
  result.mean_edge = settings.thickness;
  result.is_rigid = true;
  built.membranes.push_back(std::move(result));
}

void add_rigid_spheres(const RigidBodySettings& body, const GrainSettings& spheres,
                       BuiltScene& built) {
  dynamics::Scene& scene = built.scene;
  std::vector<NodeId> nodes;
  for (std::size_t i = 0; i < spheres.centres.size(); ++i) {
    if (spheres.is_absent) {
      nodes.push_back(scene.add_node(spheres.centres[i]));
      continue;
    }
    const auto sphere = scene.add_sphere(spheres.centres[i], spheres.radii[i], 0.0,
                                         static_cast<contact::MaterialId>(spheres.material));
    nodes.push_back(scene.elements.spheres[index_of(sphere)].nodes[0]);
  }
  BodyVolume volume;
  volume.origin = spheres.centres.front();
  const dynamics::SphereUnion all =
      dynamics::sphere_union(spheres.centres, spheres.radii, volume.origin);
  volume.moments = all.moments;
  volume.what =
      fmt::format("a solid of what its spheres cover, to {:.1g}", std::max(all.error, 1e-13));
  add_body(body, spheres.rigid_body.value(), nodes, volume, built);
  const auto [smallest, largest] = std::minmax_element(spheres.radii.begin(), spheres.radii.end());
  const std::size_t count = spheres.is_absent ? 0 : spheres.radii.size();
  built.grains.push_back(
      {spheres.name, count, built.rigid_bodies.back().mass.mass, *smallest, *largest, true});
}

void hold_as_loaded(const Scenario& scenario, BuiltScene& built) {
  Problems problems;
  const dynamics::Scene scene = dynamics::held_as_prescribed(built.scene);
  for (BuiltRigidBody& body : built.rigid_bodies) {
    const RigidBodySettings& settings = scenario.rigid_bodies[body.table];
    body.held = scene.properties.held[index_of(body.node)];
    const bool is_free =
        !dynamics::holds_translation(body.held) || !dynamics::holds_rotation(body.held);
    if (settings.density || settings.mass || !is_free) continue;
    problems.add(settings.place,
                 fmt::format("{}.density: got none of density and mass; expected one of them: the "
                             "body is not held or moved along and about all axes",
                             settings.path));
  }
  problems.throw_if_any();
}

}  // namespace plekton::apps
