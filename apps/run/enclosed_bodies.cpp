// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/enclosed_bodies.hpp"

#include "geometry/primitives/box.hpp"
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
  std::vector<Vec3> x;  ///< m; none of one that is not there
  geometry::Box box;    ///< m, around them
};

/// The surface of a body over its own nodes alone, so that many bodies take no longer than all of
/// their nodes.
class OwnSurface {
 public:
  OwnSurface(std::span<const geometry::Facet> facets, std::size_t first_node, const Body& body)
      : surface_({}, renumbered(facets, first_node), body.x.size()), query_(surface_, body.x) {}
  OwnSurface(const OwnSurface&) = delete;

  bool is_closed() const { return query_.is_closed(); }
  bool holds(const Vec3& x) const { return query_.side_of(x) == geometry::Side::inside; }

 private:
  static std::vector<geometry::Facet> renumbered(std::span<const geometry::Facet> facets,
                                                 std::size_t first_node) {
    std::vector<geometry::Facet> own(facets.begin(), facets.end());
    for (geometry::Facet& facet : own)
      for (geometry::NodeId& node : facet.nodes)
        node = geometry::id_at<geometry::NodeId>(index_of(node) - first_node);
    return own;
  }

  geometry::Surface surface_;
  geometry::SurfaceQuery query_;
};

bool is_there(const BuiltMembrane& membrane, const dynamics::Scene& scene) {
  return scene.is_there(geometry::id_at<geometry::NodeId>(membrane.first_node));
}

/// m, around points, at least one; no wider than they are.
geometry::Box box_around(const std::vector<Vec3>& x) {
  geometry::Box box{x.front(), x.front()};
  for (const Vec3& point : x) {
    box.lower = box.lower.cwiseMin(point);
    box.upper = box.upper.cwiseMax(point);
  }
  return box;
}

std::vector<Body> bodies_of(const BuiltScene& built, const dynamics::Scene& scene) {
  const std::vector<Vec3>& x = scene.state.position;
  std::vector<Body> bodies;
  for (const BuiltMembrane& membrane : built.membranes) {
    const auto first = x.begin() + static_cast<std::ptrdiff_t>(membrane.first_node);
    Body& body = bodies.emplace_back(Body{
        (membrane.is_rigid ? "rigid_bodies." : "membranes.") + membrane.name, "nodes", {}, {}});
    if (is_there(membrane, scene))
      body.x.assign(first, first + static_cast<std::ptrdiff_t>(membrane.nodes));
  }
  std::size_t sphere = 0;
  for (const BuiltGrains& grains : built.grains) {
    Body& body = bodies.emplace_back(
        Body{(grains.is_rigid ? "rigid_bodies." : "grains.") + grains.name, "grains", {}, {}});
    for (const std::size_t end = sphere + grains.count; sphere < end; ++sphere)
      body.x.push_back(x[index_of(scene.elements.spheres[sphere].nodes[0])]);
  }
  for (Body& body : bodies)
    if (!body.x.empty()) body.box = box_around(body.x);
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

bool overlap(const geometry::Box& a, const geometry::Box& b) {
  return (a.lower.array() <= b.upper.array()).all() && (b.lower.array() <= a.upper.array()).all();
}

void list_enclosed(const std::vector<Body>& bodies, std::size_t closed, const OwnSurface& membrane,
                   std::vector<EnclosedBody>& enclosed) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (b == closed || bodies[b].x.empty() || !overlap(bodies[b].box, bodies[closed].box)) continue;
    const auto inside = std::count_if(bodies[b].x.begin(), bodies[b].x.end(),
                                      [&](const Vec3& x) { return membrane.holds(x); });
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

bool holds(const geometry::Box& outer, const geometry::Box& inner) {
  return (inner.lower.array() >= outer.lower.array()).all() &&
         (inner.upper.array() <= outer.upper.array()).all();
}

std::string size_of(const geometry::Box& box) {
  const Vec3 size = box.upper - box.lower;
  return fmt::format("{:.3g} m x {:.3g} m x {:.3g} m", size[0], size[1], size[2]);
}

std::string warning_of(const Body& swallowed, const Body& solid) {
  return fmt::format(
      "all {} {} of {} ({}) begin inside of {} ({}), which is a solid: nothing keeps them apart; "
      "is it as large as that? Lengths of a mesh are taken as metres: give it scale (0.001 where "
      "they are millimetres), move them apart, or let it be a shell, filling = \"shell\"",
      swallowed.x.size(), swallowed.parts, swallowed.name, size_of(swallowed.box), solid.name,
      size_of(solid.box));
}

/// Those whose boxes a body's box holds.
std::vector<std::size_t> bodies_in_box(const std::vector<Body>& bodies, std::size_t large) {
  std::vector<std::size_t> held;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (b != large && !bodies[b].x.empty() && holds(bodies[large].box, bodies[b].box))
      held.push_back(b);
  return held;
}

}  // namespace

std::vector<EnclosedBody> enclosed_bodies(const BuiltScene& built, const dynamics::Scene& scene) {
  const std::vector<Body> bodies = bodies_of(built, scene);
  const auto facets = facets_of(built, scene);
  std::vector<EnclosedBody> enclosed;
  for (std::size_t m = 0; m < facets.size(); ++m) {
    if (facets[m].empty()) continue;
    const OwnSurface surface(facets[m], built.membranes[m].first_node, bodies[m]);
    if (surface.is_closed()) list_enclosed(bodies, m, surface, enclosed);
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
    const std::vector<std::size_t> candidates = bodies_in_box(bodies, m);
    if (candidates.empty()) continue;
    const OwnSurface surface(facets[m], built.membranes[m].first_node, bodies[m]);
    if (!surface.is_closed()) continue;
    for (const std::size_t b : candidates)
      if (std::ranges::all_of(bodies[b].x, [&](const Vec3& x) { return surface.holds(x); }))
        warnings.push_back(warning_of(bodies[b], bodies[m]));
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
