// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scene/taken_space.hpp"

#include "apps/grains/container.hpp"
#include "apps/grains/free_space.hpp"
#include "apps/grains/random.hpp"
#include "geometry/primitives/node_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace plekton::apps {
namespace {

constexpr int kPlaces = 1000;

/// m, centres of grains at random that lie in the space wholly; none where a grain is larger.
std::vector<Vec3> places_in(const GrainSettings& settings, double radius) {
  const Container space =
      settings.cylinder ? container_of(*settings.cylinder) : container_of(settings.box);
  const Vec3 lower = space.bounds.lower.array() + radius;
  const Vec3 upper = space.bounds.upper.array() - radius;
  std::vector<Vec3> places;
  if ((lower.array() > upper.array()).any()) return places;
  Random random(0);
  for (int i = 0; i < kPlaces; ++i) {
    const Vec3 place = random.in_box(lower, upper);
    if (space.holds(place, radius)) places.push_back(place);
  }
  return places;
}

/// The part of some places that something takes up.
double part_of(const std::vector<Vec3>& places, const std::function<bool(const Vec3&)>& is_taken) {
  return static_cast<double>(std::count_if(places.begin(), places.end(), is_taken)) /
         static_cast<double>(places.size());
}

/// The triangles and segments of a membrane.
std::vector<std::array<Vec3, 3>> cores_of(const BuiltMembrane& membrane,
                                          const dynamics::Scene& scene, std::span<const Vec3> x) {
  const std::size_t end = membrane.first_node + membrane.nodes;
  const auto is_its = [&](geometry::NodeId node) {
    return geometry::index_of(node) >= membrane.first_node && geometry::index_of(node) < end;
  };
  std::vector<std::array<Vec3, 3>> cores;
  for (const geometry::Facet& facet : scene.elements.facets)
    if (is_its(facet.nodes[0])) cores.push_back(geometry::core(facet, x));
  const geometry::NodeSets<2> sides = geometry::set_of_sides(scene.elements.facets);
  for (const geometry::Cylinder& cylinder : scene.elements.cylinders) {
    if (!is_its(cylinder.nodes[0]) || sides.contains(cylinder.nodes)) continue;
    const auto [x0, x1] = geometry::core(cylinder, x);
    cores.push_back({x0, x1, x1});
  }
  return cores;
}

/// What takes up a part of the space, and what to do.
struct Taking {
  double part = 0.0;
  std::string advice;
};

Taking of_plane(std::size_t i, const Scenario& scenario, const contact::Plane& plane,
                const std::vector<Vec3>& places, double radius) {
  const std::string path = scenario.planes[i].path();
  const double part = part_of(places, [&](const Vec3& x) { return plane.height(x) < radius; });
  if (!scenario.planes[i].is_flat())
    return {part,
            fmt::format("{:.0f} % of it is outside of {}: move or widen that", 100.0 * part, path)};
  return {part,
          fmt::format("{:.0f} % of it is behind {}: turn its normal, which points to the side "
                      "where bodies may be, or move it",
                      100.0 * part, path)};
}

Taking of_membrane(std::size_t i, const Scenario& scenario, const BuiltScene& built,
                   std::span<const Vec3> x, const std::vector<Vec3>& places, double radius) {
  const BuiltMembrane& membrane = built.membranes[i];
  const double thickness = scenario.membranes[i].thickness;
  const auto cores = cores_of(membrane, built.scene, x);
  const double reach = radius + 0.5 * thickness;
  const double part = part_of(places, [&](const Vec3& place) {
    return std::any_of(cores.begin(), cores.end(),
                       [&](const auto& core) { return distance_to_triangle(place, core) < reach; });
  });
  return {part, fmt::format("{:.0f} % of it is taken up by {}.{} with its thickness of {:.3g} m: "
                            "make that thinner, or move it",
                            100.0 * part, membrane.is_rigid ? "rigid_bodies" : "membranes",
                            membrane.name, thickness)};
}

}  // namespace

std::string what_takes_up(const GrainSettings& settings, const Scenario& scenario,
                          const BuiltScene& built, std::span<const Vec3> x) {
  if (!settings.inside.empty()) return "";
  const double radius = 0.5 * settings.sizes.largest_diameter();
  const std::vector<Vec3> places = places_in(settings, radius);
  if (places.empty()) return "";
  Taking most{0.5, ""};
  const auto note = [&](Taking taking) {
    if (taking.part >= most.part && (most.advice.empty() || taking.part > most.part))
      most = std::move(taking);
  };
  for (std::size_t i = 0; i < built.scene.planes.size(); ++i)
    note(of_plane(i, scenario, built.scene.planes[i], places, radius));
  for (std::size_t i = 0; i < built.membranes.size(); ++i)
    if (!scenario.membranes[i].is_absent) note(of_membrane(i, scenario, built, x, places, radius));
  return most.advice.empty() ? "" : "; " + most.advice;
}

}  // namespace plekton::apps
