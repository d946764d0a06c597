// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scene/build_scene.hpp"

#include "apps/scenario/closest_word.hpp"
#include "apps/scene/build_loads.hpp"
#include "apps/scene/build_reactions.hpp"
#include "apps/scene/build_ties.hpp"
#include "apps/scene/fixity.hpp"
#include "apps/scene/grain_generator.hpp"
#include "apps/scene/membrane_builder.hpp"
#include "apps/scene/rigid_builder.hpp"
#include "apps/scene/stage_ends.hpp"
#include "apps/scene/taken_space.hpp"
#include "geometry/base/elementary.hpp"
#include "geometry/mesh/io/import.hpp"
#include "geometry/neighbor/space_order.hpp"
#include "geometry/primitives/node_sets.hpp"
#include "geometry/query/surface_query.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

namespace plekton::apps {
namespace {

using geometry::index_of;

void add_materials_and_planes(const Scenario& scenario, dynamics::Scene& scene) {
  for (const MaterialSettings& material : scenario.materials) {
    scene.materials.push_back({material.young_modulus, material.stiffness_ratio,
                               elementary::tan(material.friction_angle), material.poisson_ratio});
  }
  for (const PlaneSettings& plane : scenario.planes) {
    scene.planes.push_back({plane.point, plane.normal, plane.velocity,
                            static_cast<contact::MaterialId>(plane.material), plane.form,
                            plane.radius, plane.axis, plane.angular_velocity});
  }
}

/// Everything in the scene that has a place, for the grains to keep clear of.
/// @param there          what of it is elsewhere than where it was made
/// @param young_modulus  Pa, of the grains
std::vector<Obstacle> obstacles_of(const BuiltScene& built, const BodiesThere& there,
                                   double young_modulus) {
  const dynamics::Scene& scene = built.scene;
  const auto spring_of = [&](contact::MaterialId material, double radius) {
    return scene.materials[index_of(material)].young_modulus * radius / young_modulus;
  };
  std::vector<Vec3> x = scene.state.position;
  std::copy(there.positions.begin(), there.positions.end(), x.begin());
  std::vector<Obstacle> obstacles;
  for (std::size_t i = 0; i < scene.elements.facets.size(); ++i) {
    const geometry::Facet& facet = scene.elements.facets[i];
    if (scene.is_there(facet.nodes[0]))
      obstacles.push_back({geometry::core(facet, x), facet.radius,
                           spring_of(scene.facet_materials[i], facet.radius)});
  }
  const geometry::NodeSets<2> sides = geometry::set_of_sides(scene.elements.facets);
  for (std::size_t i = 0; i < scene.elements.cylinders.size(); ++i) {
    const geometry::Cylinder& cylinder = scene.elements.cylinders[i];
    if (!scene.is_there(cylinder.nodes[0]) || sides.contains(cylinder.nodes)) continue;
    const auto [x0, x1] = geometry::core(cylinder, x);
    obstacles.push_back(
        {{x0, x1, x1}, cylinder.radius, spring_of(scene.cylinder_materials[i], cylinder.radius)});
  }
  for (std::size_t i = 0; i < scene.elements.spheres.size(); ++i) {
    const geometry::Sphere& sphere = scene.elements.spheres[i];
    const std::size_t node = index_of(sphere.nodes[0]);
    if (!there.are_in_the_way && node < there.positions.size()) continue;
    const Vec3& centre = x[node];
    obstacles.push_back({{centre, centre, centre},
                         sphere.radius,
                         spring_of(scene.sphere_materials[i], sphere.radius)});
  }
  return obstacles;
}

/// Its nodes stay where they are, without their elements.
/// @param first  node
void leave_out(std::size_t first, dynamics::Scene& scene) {
  scene.is_absent.resize(first, false);
  scene.is_absent.resize(scene.state.size(), true);
  for (std::size_t node = first; node < scene.state.size(); ++node) {
    dynamics::Held& held = scene.properties.held[node];
    held = held | dynamics::Held::everything;
    scene.state.velocity[node] = scene.state.angular_velocity[node] = Vec3::Zero();
  }
}

/// Points to the step of the repair that failed, or else to the mesh or shape.
void complain(const MembraneSettings& membrane, std::optional<geometry::RepairStep> failed_step,
              const char* what, Problems& problems) {
  const auto key =
      failed_step ? membrane.repair_keys.find(*failed_step) : membrane.repair_keys.end();
  const std::string path = (membrane.rigid_body ? "rigid_bodies." : "membranes.") + membrane.name;
  if (key == membrane.repair_keys.end())
    problems.add(membrane.source_place, fmt::format("{}: {}", path, what));
  else
    problems.add(key->second.place, fmt::format("{}.{}: {}", path, key->second.name, what));
}

/// So that grains near each other are near each other in memory; largest first, as they are placed,
/// they would lie anywhere.
std::vector<PlacedGrain> in_order_of_space(const std::vector<PlacedGrain>& grains) {
  std::vector<geometry::Vec3> centres;
  for (const PlacedGrain& grain : grains) centres.push_back(grain.centre);
  std::vector<PlacedGrain> sorted;
  for (const std::int32_t i : geometry::order_along_curve(centres))
    sorted.push_back(grains[static_cast<std::size_t>(i)]);
  return sorted;
}

/// A table of grains that are there: its nodes come next.
std::vector<PlacedGrain> grains_there(std::size_t table, const BodiesThere& there,
                                      const BuiltScene& built) {
  std::vector<PlacedGrain> grains;
  std::size_t node = built.scene.state.size();
  for (const double radius : there.grains[table])
    grains.push_back({there.positions[node++], radius});
  return grains;
}

/// A closed surface at its place now, and what it encloses.
struct Enclosure {
  std::vector<geometry::Facet> facets;
  geometry::Surface surface;
  std::unique_ptr<geometry::SurfaceQuery> query;
};

std::size_t membrane_called(const std::string& name, const BuiltScene& built) {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < built.membranes.size(); ++i) {
    if (built.membranes[i].name == name) return i;
    names.push_back(built.membranes[i].name);
  }
  throw InputError(fmt::format("inside: there is no membrane or rigid body called \"{}\"; {}", name,
                               names.empty() ? "there are none" : "there are " + listed(names)));
}

/// @param x  m, where nodes are
Container container_inside(const std::string& name, const BuiltScene& built,
                           std::span<const Vec3> x, Enclosure& enclosure) {
  const std::size_t number = membrane_called(name, built);
  std::size_t first = 0;
  for (std::size_t i = 0; i < number; ++i) first += built.membranes[i].facets;
  const auto begin = built.scene.elements.facets.begin() + static_cast<std::ptrdiff_t>(first);
  enclosure.facets.assign(begin,
                          begin + static_cast<std::ptrdiff_t>(built.membranes[number].facets));
  enclosure.surface = geometry::Surface({}, enclosure.facets, x.size());
  enclosure.query = std::make_unique<geometry::SurfaceQuery>(enclosure.surface, x);
  if (!enclosure.query->is_closed())
    throw InputError(
        fmt::format("inside: \"{}\" is not closed; expected a surface without a rim, "
                    "or a box or cylinder in which the grains are placed",
                    name));
  if (!built.scene.is_there(enclosure.facets.front().nodes[0]))
    throw InputError(fmt::format(
        "inside: \"{}\" is not there in this stage; expected grains that come with what "
        "holds them, or after it",
        name));
  Container container;
  std::vector<Vec3> corners;
  for (const geometry::Facet& facet : enclosure.facets) {
    const auto core = geometry::core(facet, x);
    corners.insert(corners.end(), core.begin(), core.end());
  }
  container.bounds = geometry::bounding_box(corners, 0.0);
  const Vec3& origin = container.bounds.lower;
  double area = 0.0;
  for (const geometry::Facet& facet : enclosure.facets) {
    const auto [a, b, c] = geometry::core(facet, x);
    container.volume += (a - origin).dot((b - origin).cross(c - origin)) / 6.0;
    area += 0.5 * (b - a).cross(c - a).norm();
  }
  // Up to the inner face.
  container.volume = std::abs(container.volume) - area * enclosure.facets.front().radius;
  container.is_inside = [query = enclosure.query.get()](const Vec3& point) {
    return query->side_of(point) == geometry::Side::inside;
  };
  return container;
}

/// In their space, clear of all that is there.
std::vector<PlacedGrain> made_grains(const GrainSettings& settings, double young_modulus,
                                     const BodiesThere& there, const BuiltScene& built,
                                     const HearSetUp& hear) {
  const std::vector<Obstacle> obstacles = obstacles_of(built, there, young_modulus);
  std::vector<double> plane_moduli;
  for (const contact::Plane& plane : built.scene.planes)
    plane_moduli.push_back(built.scene.materials[index_of(plane.material)].young_modulus /
                           young_modulus);
  Enclosure enclosure;
  std::optional<Container> container;
  if (!settings.inside.empty()) {
    std::vector<Vec3> x = built.scene.state.position;
    std::copy(there.positions.begin(), there.positions.end(), x.begin());
    container = container_inside(settings.inside, built, x, enclosure);
  }
  const bool packs = settings.placement == GrainPlacement::packed;
  const auto tell = [&](double share) {
    if (hear) hear((packs ? "packing grains " : "placing grains ") + settings.name, share);
  };
  return in_order_of_space(
      generate_grains(settings,
                      {obstacles, built.scene.planes, container ? &*container : nullptr,
                       young_modulus, plane_moduli},
                      tell));
}

/// Where it is told, in that order; or in their space.
std::vector<PlacedGrain> placed_grains(const GrainSettings& settings, double young_modulus,
                                       const BodiesThere& there, const BuiltScene& built,
                                       const HearSetUp& hear) {
  if (settings.centres.empty()) return made_grains(settings, young_modulus, there, built, hear);
  std::vector<PlacedGrain> grains;
  for (std::size_t i = 0; i < settings.centres.size(); ++i) {
    const double radius =
        settings.radii.empty() ? 0.5 * settings.sizes.largest_diameter() : settings.radii[i];
    grains.push_back({settings.centres[i], radius});
  }
  return grains;
}

BuiltGrains add_grains(const GrainSettings& settings, const std::vector<PlacedGrain>& grains,
                       double density, BuiltScene& built) {
  dynamics::Scene& scene = built.scene;
  BuiltGrains result{settings.name, grains.size(), 0.0, 0.0, 0.0};
  if (!grains.empty()) result.smallest = result.largest = grains.front().radius;
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const PlacedGrain& grain = grains[i];
    const auto id = scene.add_sphere(grain.centre, grain.radius, density,
                                     static_cast<contact::MaterialId>(settings.material));
    const geometry::Sphere& sphere = scene.elements.spheres[index_of(id)];
    const double inertia =
        density * geometry::volume(sphere) * grain.radius * grain.radius;  // but for a factor
    if (!std::isnormal(inertia)) {
      throw InputError(
          fmt::format("{}: a grain of {:.4g} m radius and {:.4g} kg/m3 has no mass or "
                      "moment of inertia that can be computed with; check the units",
                      settings.name, grain.radius, density));
    }
    scene.state.velocity[index_of(sphere.nodes[0])] =
        i < settings.velocities.size() ? settings.velocities[i] : settings.velocity;
    scene.state.angular_velocity[index_of(sphere.nodes[0])] = i < settings.angular_velocities.size()
                                                                  ? settings.angular_velocities[i]
                                                                  : settings.angular_velocity;
    if (i < settings.orientations.size())
      scene.state.orientation[index_of(sphere.nodes[0])] = settings.orientations[i];
    result.mass += density * geometry::volume(sphere);
    result.smallest = std::min(result.smallest, grain.radius);
    result.largest = std::max(result.largest, grain.radius);
  }
  return result;
}

/// Membranes, and surfaces of rigid bodies.
void add_surfaces(const Scenario& scenario, BuiltScene& built, Problems& problems,
                  const HearSetUp& hear) {
  for (const MembraneSettings& membrane : scenario.membranes) {
    if (hear) hear("making membrane " + membrane.name, 0.0);
    const std::size_t first_node = built.scene.state.size();
    try {
      if (membrane.rigid_body)
        add_rigid_surface(scenario.rigid_bodies[*membrane.rigid_body], membrane, built);
      else
        built.membranes.push_back(add_membrane(membrane, built));
      if (membrane.is_absent) leave_out(first_node, built.scene);
    } catch (const geometry::RefusedMesh& error) {
      complain(membrane, error.failed_step, error.what(), problems);
    } catch (const geometry::MeshError& error) {
      complain(membrane, {}, error.what(), problems);
    } catch (const InputError& error) {
      complain(membrane, {}, error.what(), problems);
    }
  }
}

/// Spheres of rigid bodies, whose tables come before those of grains.
void add_clumps(const Scenario& scenario, BuiltScene& built, Problems& problems) {
  for (const GrainSettings& spheres : scenario.grains) {
    if (!spheres.rigid_body) continue;
    const std::size_t first_node = built.scene.state.size();
    try {
      add_rigid_spheres(scenario.rigid_bodies[*spheres.rigid_body], spheres, built);
      if (spheres.is_absent) leave_out(first_node, built.scene);
    } catch (const InputError& error) {
      problems.add(spheres.place, fmt::format("rigid_bodies.{}: {}", spheres.name, error.what()));
    }
  }
}

void add_all_grains(const Scenario& scenario, const BodiesThere& there, BuiltScene& built,
                    Problems& problems, const HearSetUp& hear) {
  for (const GrainSettings& grains : scenario.grains) {
    if (grains.rigid_body) continue;
    const std::size_t table = built.grains.size();
    const MaterialSettings& material = scenario.materials[grains.material];
    try {
      const std::vector<PlacedGrain> placed =
          table < there.grains.size()
              ? grains_there(table, there, built)
              : placed_grains(grains, material.young_modulus, there, built, hear);
      built.grains.push_back(add_grains(grains, placed, material.density.value(), built));
    } catch (const DoesNotFit& error) {
      std::vector<Vec3> x = built.scene.state.position;
      std::copy(there.positions.begin(), there.positions.end(), x.begin());
      problems.add(grains.place, fmt::format("grains.{}{}", error.what(),
                                             what_takes_up(grains, scenario, built, x)));
    } catch (const InputError& error) {
      problems.add(grains.place, fmt::format("grains.{}", error.what()));
    }
  }
}

}  // namespace

BuiltScene build_scene(const Scenario& scenario, const HearSetUp& hear) {
  BuiltScene built = build_bodies(scenario, {}, hear);
  if (scenario.stage) fix_and_free(*scenario.stage, built, built.scene.properties.held);
  if (const StageEnd* const end = scenario.end()) require_apart(*end, built);
  add_loads(scenario, built);
  hold_as_loaded(scenario, built);
  add_reactions(scenario, built);
  return built;
}

BuiltScene build_bodies(const Scenario& scenario, const BodiesThere& there, const HearSetUp& hear) {
  BuiltScene built;
  Problems problems;
  add_materials_and_planes(scenario, built.scene);
  add_surfaces(scenario, built, problems, hear);
  add_clumps(scenario, built, problems);
  if (problems.empty()) add_ties(scenario, built);
  const auto tell_the_rest_is_there = [&] {
    if (!built.scene.is_absent.empty())
      built.scene.is_absent.resize(built.scene.state.size(), false);
  };
  tell_the_rest_is_there();
  add_all_grains(scenario, there, built, problems, hear);
  problems.throw_if_any();
  tell_the_rest_is_there();
  return built;
}

}  // namespace plekton::apps
