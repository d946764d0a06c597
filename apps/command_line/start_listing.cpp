// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/start_listing.hpp"

#include "apps/run/enclosed_bodies.hpp"
#include "apps/scenario/section.hpp"
#include "apps/scenario/staged_scenario.hpp"
#include "geometry/primitives/box.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace plekton::apps {
namespace {

using geometry::Box;
using geometry::index_of;

constexpr std::size_t kMostPlaces = 5;  // of two bodies that overlap, that are listed

/// m, around nothing yet.
Box no_box() {
  const Vec3 infinite = Vec3::Constant(kInfinity);
  return {infinite, -infinite};
}

void include(Box& box, const Vec3& centre, double radius) {
  box.lower = box.lower.cwiseMin((centre.array() - radius).matrix());
  box.upper = box.upper.cwiseMax((centre.array() + radius).matrix());
}

std::string line_of(const NamedBox& body) {
  const Vec3& l = body.box.lower;
  const Vec3& u = body.box.upper;
  const std::string when =
      body.comes_in.empty() ? "" : fmt::format(", which comes in stage {}", body.comes_in);
  return fmt::format("box of {}{}: ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) m\n",
                     body.name, when, l[0], l[1], l[2], u[0], u[1], u[2]);
}

std::string bonds(const Scenario& scenario, const InitialContacts& start) {
  std::string text;
  for (std::size_t i = 0; i < scenario.contacts.size(); ++i) {
    const PairSettings& pair = scenario.contacts[i];
    if (!contact::bonds_of(pair.contact)) continue;
    text +=
        fmt::format("bonds of {} with {}: {} at the start\n", scenario.materials[pair.first].name,
                    scenario.materials[pair.second].name, start.bonds[i]);
  }
  return text;
}

std::string overlaps(const Scenario& scenario, const InitialContacts& start) {
  std::map<std::array<BodyTable, 2>, std::vector<const BodyOverlap*>> by_tables;
  for (const BodyOverlap& overlap : start.overlaps) by_tables[overlap.of].push_back(&overlap);
  std::string text;
  for (const auto& [tables, all] : by_tables) {
    text += fmt::format("overlaps at the start of {} with {}: {}{}\n", path_of(tables[0], scenario),
                        path_of(tables[1], scenario), all.size(),
                        all.size() > kMostPlaces ? ", the deepest" : "");
    for (std::size_t i = 0; i < std::min(all.size(), kMostPlaces); ++i)
      text += fmt::format("  {}\n", text_of(*all[i]));
  }
  return text.empty() ? "overlaps at the start: none\n" : text;
}

}  // namespace

std::vector<NamedBox> boxes_at_start(const Scenario& scenario, const PreparedRun& prepared) {
  const dynamics::Scene& scene = prepared.simulation->scene();
  const auto& x = scene.state.position;
  std::vector<NamedBox> boxes;
  for (std::size_t m = 0; m < prepared.built.membranes.size(); ++m) {
    const BuiltMembrane& membrane = prepared.built.membranes[m];
    Box box = no_box();
    for (std::size_t n = membrane.first_node; n < membrane.first_node + membrane.nodes; ++n)
      include(box, x[n], 0.5 * scenario.membranes[m].thickness);
    const std::string comes_in =
        scenario.membranes[m].is_absent
            ? stage_that_brings(scenario, &Scenario::membranes, m, prepared.bodies.stage)
            : "";
    boxes.push_back({path_of({BodyTable::Kind::membrane, m}, scenario), box, comes_in});
  }
  std::size_t first = 0;
  for (std::size_t g = 0; g < prepared.built.grains.size(); ++g) {
    const BuiltGrains& grains = prepared.built.grains[g];
    if (grains.count == 0) continue;  // of a rigid body that is not there
    Box box = no_box();
    for (std::size_t i = first; i < first + grains.count; ++i) {
      const geometry::Sphere& sphere = scene.elements.spheres[i];
      include(box, x[index_of(sphere.nodes[0])], sphere.radius);
    }
    first += grains.count;
    boxes.push_back({path_of({BodyTable::Kind::grains, g}, scenario), box});
  }
  Box all = no_box();
  for (const NamedBox& body : boxes)
    if (body.comes_in.empty())
      all = {all.lower.cwiseMin(body.box.lower), all.upper.cwiseMax(body.box.upper)};
  boxes.push_back({"everything", all});
  return boxes;
}

std::string listing_of_start(const Scenario& scenario, const PreparedRun& prepared) {
  std::string text;
  for (const NamedBox& body : boxes_at_start(scenario, prepared)) text += line_of(body);
  const dynamics::Scene& scene = prepared.simulation->scene();
  return text + bonds(scenario, prepared.start) + overlaps(scenario, prepared.start) +
         listing_of(enclosed_bodies(prepared.built, scene));
}

}  // namespace plekton::apps
