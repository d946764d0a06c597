// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/enclosed_bodies.hpp"

#include "geometry/query/surface_query.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace plekton::apps {
namespace {

using geometry::index_of;

/// A body with the places of its grains or nodes.
struct Body {
  std::string name;
  const char* parts;
  std::vector<Vec3> x;  ///< m
};

bool is_there(const BuiltMembrane& membrane, const dynamics::Scene& scene) {
  return scene.is_there(geometry::id_at<geometry::NodeId>(membrane.first_node));
}

std::vector<Body> bodies_of(const BuiltScene& built, const dynamics::Scene& scene) {
  const std::vector<Vec3>& x = scene.state.position;
  std::vector<Body> bodies;
  for (const BuiltMembrane& membrane : built.membranes) {
    const auto first = x.begin() + static_cast<std::ptrdiff_t>(membrane.first_node);
    Body& body = bodies.emplace_back(
        Body{(membrane.is_rigid ? "rigid_bodies." : "membranes.") + membrane.name, "nodes", {}});
    if (is_there(membrane, scene))
      body.x.assign(first, first + static_cast<std::ptrdiff_t>(membrane.nodes));
  }
  std::size_t sphere = 0;
  for (const BuiltGrains& grains : built.grains) {
    Body& body = bodies.emplace_back(
        Body{(grains.is_rigid ? "rigid_bodies." : "grains.") + grains.name, "grains", {}});
    for (const std::size_t end = sphere + grains.count; sphere < end; ++sphere)
      body.x.push_back(x[index_of(scene.elements.spheres[sphere].nodes[0])]);
  }
  return bodies;
}

/// By membrane: its facets, none of those that are not there.
std::vector<std::span<const geometry::Facet>> facets_of(const BuiltScene& built,
                                                        const dynamics::Scene& scene) {
  const std::span<const geometry::Facet> all = scene.elements.facets;
  std::vector<std::span<const geometry::Facet>> facets;
  std::size_t first = 0;
  for (const BuiltMembrane& membrane : built.membranes) {
    std::size_t end = first;
    while (end < all.size() && index_of(all[end].nodes[0]) < membrane.first_node + membrane.nodes)
      ++end;
    facets.push_back(is_there(membrane, scene) ? all.subspan(first, end - first)
                                               : std::span<const geometry::Facet>());
    first = end;
  }
  return facets;
}

void list_enclosed(const std::vector<Body>& bodies, std::size_t closed,
                   const geometry::SurfaceQuery& membrane, std::vector<EnclosedBody>& enclosed) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (b == closed) continue;
    const auto inside = std::count_if(bodies[b].x.begin(), bodies[b].x.end(), [&](const Vec3& x) {
      return membrane.side_of(x) == geometry::Side::inside;
    });
    if (inside > 0)
      enclosed.push_back({bodies[b].name, bodies[closed].name, bodies[b].parts,
                          static_cast<std::size_t>(inside), bodies[b].x.size()});
  }
}

/// Whether the mass of a membrane is that of a solid, if it is closed.
bool is_solid(const MembraneSettings& membrane, const Scenario& scenario) {
  if (!membrane.rigid_body) return false;
  const RigidBodySettings& body = scenario.rigid_bodies[*membrane.rigid_body];
  const bool is_told = body.mass && body.inertia && body.centre;
  return (body.density || body.mass) && !is_told && body.filling != RigidFilling::shell;
}

/// m, around points, at least one.
geometry::Box box_around(const std::vector<Vec3>& x) {
  geometry::Box box{x.front(), x.front()};
  for (const Vec3& point : x) {
    box.lower = box.lower.cwiseMin(point);
    box.upper = box.upper.cwiseMax(point);
  }
  return box;
}

bool holds(const geometry::Box& outer, const geometry::Box& inner) {
  return (inner.lower.array() >= outer.lower.array()).all() &&
         (inner.upper.array() <= outer.upper.array()).all();
}

std::string size_of(const geometry::Box& box) {
  const Vec3 size = box.upper - box.lower;
  return fmt::format("{:.3g} m x {:.3g} m x {:.3g} m", size[0], size[1], size[2]);
}

std::string warning_of(const Body& swallowed, const geometry::Box& small, const Body& solid,
                       const geometry::Box& large) {
  return fmt::format(
      "all {} {} of {} ({}) begin inside of {} ({}), which is a solid: nothing keeps them apart; "
      "is it as large as that? Lengths of a mesh are taken as metres: give it scale (0.001 where "
      "they are millimetres), move them apart, or let it be a shell, filling = \"shell\"",
      swallowed.x.size(), swallowed.parts, swallowed.name, size_of(small), solid.name,
      size_of(large));
}

}  // namespace

std::vector<EnclosedBody> enclosed_bodies(const BuiltScene& built, const dynamics::Scene& scene) {
  const std::vector<Body> bodies = bodies_of(built, scene);
  const auto facets = facets_of(built, scene);
  std::vector<EnclosedBody> enclosed;
  for (std::size_t m = 0; m < facets.size(); ++m) {
    if (facets[m].empty()) continue;
    const geometry::Surface surface({}, facets[m], scene.state.size());
    const geometry::SurfaceQuery query(surface, scene.state.position);
    if (query.is_closed()) list_enclosed(bodies, m, query, enclosed);
  }
  return enclosed;
}

std::vector<std::string> warnings_about_solids(const Scenario& scenario, const BuiltScene& built,
                                               const dynamics::Scene& scene) {
  const std::vector<Body> bodies = bodies_of(built, scene);
  const auto facets = facets_of(built, scene);
  std::vector<std::string> warnings;
  for (std::size_t m = 0; m < facets.size(); ++m) {
    if (facets[m].empty() || !is_solid(scenario.membranes[m], scenario)) continue;
    const geometry::Surface surface({}, facets[m], scene.state.size());
    const geometry::SurfaceQuery query(surface, scene.state.position);
    if (!query.is_closed()) continue;
    const geometry::Box large = box_around(bodies[m].x);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (b == m || bodies[b].x.empty()) continue;
      const geometry::Box small = box_around(bodies[b].x);
      if (!holds(large, small)) continue;
      if (std::all_of(bodies[b].x.begin(), bodies[b].x.end(),
                      [&](const Vec3& x) { return query.side_of(x) == geometry::Side::inside; }))
        warnings.push_back(warning_of(bodies[b], small, bodies[m], large));
    }
  }
  return warnings;
}

std::string listing_of(const std::vector<EnclosedBody>& bodies) {
  std::string text;
  for (const EnclosedBody& body : bodies)
    text += fmt::format("inside at the start: {} of {} {} of {} in {}\n", body.inside, body.all,
                        body.parts, body.name, body.in);
  return text;
}

}  // namespace plekton::apps
