// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/enclosed_bodies.hpp"

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

std::vector<Body> bodies_of(const PreparedRun& prepared) {
  const dynamics::Scene& scene = prepared.simulation->scene();
  const std::vector<Vec3>& x = scene.state.position;
  std::vector<Body> bodies;
  for (const BuiltMembrane& membrane : prepared.built.membranes) {
    const auto first = x.begin() + static_cast<std::ptrdiff_t>(membrane.first_node);
    bodies.push_back({(membrane.is_rigid ? "rigid_bodies." : "membranes.") + membrane.name,
                      "nodes",
                      {first, first + static_cast<std::ptrdiff_t>(membrane.nodes)}});
  }
  std::size_t sphere = 0;
  for (const BuiltGrains& grains : prepared.built.grains) {
    Body& body = bodies.emplace_back(
        Body{(grains.is_rigid ? "rigid_bodies." : "grains.") + grains.name, "grains", {}});
    for (const std::size_t end = sphere + grains.count; sphere < end; ++sphere)
      body.x.push_back(x[index_of(scene.elements.spheres[sphere].nodes[0])]);
  }
  return bodies;
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

}  // namespace

std::vector<EnclosedBody> enclosed_bodies(const PreparedRun& prepared) {
  const dynamics::Scene& scene = prepared.simulation->scene();
  const std::vector<Body> bodies = bodies_of(prepared);
  std::vector<EnclosedBody> enclosed;
  std::size_t first = 0;  // facet of the membrane
  for (std::size_t m = 0; m < prepared.built.membranes.size(); ++m) {
    const auto facets =
        std::span(scene.elements.facets).subspan(first, prepared.built.membranes[m].facets);
    first += facets.size();
    if (facets.empty()) continue;
    const geometry::Surface surface({}, facets, scene.state.size());
    const geometry::SurfaceQuery query(surface, scene.state.position);
    if (query.is_closed()) list_enclosed(bodies, m, query, enclosed);
  }
  return enclosed;
}

std::string listing_of(const std::vector<EnclosedBody>& bodies) {
  std::string text;
  for (const EnclosedBody& body : bodies)
    text += fmt::format("inside at the start: {} of {} {} of {} in {}\n", body.inside, body.all,
                        body.parts, body.name, body.in);
  return text;
}

}  // namespace plekton::apps
