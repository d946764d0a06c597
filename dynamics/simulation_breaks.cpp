// SPDX-License-Identifier: GPL-3.0-or-later
// What breaks in a simulation, and what becomes of it.
#include "dynamics/broken_elements.hpp"
#include "dynamics/model/require_index.hpp"
#include "dynamics/simulation.hpp"
#include "geometry/primitives/node_sets.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace plekton::dynamics {

void Simulation::break_bond(std::size_t bond) {
  require_index("break_bond", "bond", bond, bonds_.size());
  broken_.bonds.push_back(bond);
}

void Simulation::break_cylinder(NodeId a, NodeId b) {
  for (const NodeId node : {a, b}) require_node("break_cylinder", node, scene_.state.size());
  const auto nodes = geometry::sorted(std::array{a, b});
  const auto& all = scene_.elements.cylinders;
  const bool is_there = std::any_of(all.begin(), all.end(), [&](const auto& cylinder) {
    return geometry::sorted(cylinder.nodes) == nodes;
  });
  if (!is_there) {
    throw std::invalid_argument("there is no cylinder between nodes " +
                                std::to_string(static_cast<std::int32_t>(a)) + " and " +
                                std::to_string(static_cast<std::int32_t>(b)) +
                                "; elements() are those that are left");
  }
  broken_.cylinders.push_back(nodes);
  for (std::size_t i = 0; i < scene_.bonds.size(); ++i) {
    if (geometry::sorted(scene_.bonds[i].nodes) == nodes) broken_.bonds.push_back(i);
  }
}

void Simulation::break_facet(const std::array<NodeId, 3>& nodes) {
  for (const NodeId node : nodes) require_node("break_facet", node, scene_.state.size());
  const auto corners = geometry::sorted(nodes);
  const auto& all = scene_.elements.facets;
  const bool is_there = std::any_of(all.begin(), all.end(), [&](const auto& facet) {
    return geometry::sorted(facet.nodes) == corners;
  });
  if (!is_there) {
    std::string text = "there is no facet on nodes";
    for (const NodeId node : nodes) text += " " + std::to_string(static_cast<std::int32_t>(node));
    throw std::invalid_argument(text + "; elements() are those that are left");
  }
  broken_.facets.push_back(corners);
}

/// Before the forces of a step: takes out what hangs on the bonds and sheets that break in it,
/// because they yielded, tore or were asked to. Linear in the scene where elements are gone; that
/// step may allocate.
void Simulation::follow_breaks() {
  const std::span<const std::size_t> yielded = yielding_bonds_.broken();
  if (broken_.empty() && yielded.empty() && sheet_facets_.broken().empty()) return;
  loads_.follow(bonds_, sheet_facets_);
  if (surface_.cell_count() > 0) {
    broken_.bonds.insert(broken_.bonds.end(), yielded.begin(), yielded.end());
    for (const std::size_t facet : sheet_facets_.broken())
      broken_.facets.push_back(sheet_facets_.nodes(facet));
    if (take_out_broken(scene_, broken_, bonds_, sheet_facets_)) follow_surface();
  }
  broken_.clear();
}

/// Before bonds and sheets find what they do where their nodes have come to.
void Simulation::break_asked() {
  for (const std::size_t bond : broken_.bonds) {
    broken_energy_ += bonds_.lost_by_break(bond, bonds_.spring(bond), scene_.state, last_drift_);
    bonds_.break_bond(bond);
  }
  for (const auto& nodes : broken_.facets) {
    for (std::size_t i = 0; i < sheet_facets_.size(); ++i) {
      if (geometry::sorted(sheet_facets_.nodes(i)) == nodes)
        sheet_facets_.break_facet(i, scene_.state, last_drift_);
    }
  }
}

/// The scene's elements have become fewer. Elastic energies of contacts before and after are
/// compared half a drift ago, for the same reason as those of bonds.
void Simulation::follow_surface() {
  const geometry::Surface before =
      change_surface(surface_.left_with(scene_.elements.cylinders, scene_.elements.facets));
  loads_.follow(geometry::SurfaceChange(before, surface_));
  ties_.follow(scene_.elements);
}

/// Contacts go on where their features are there still.
/// @returns the surface of before
geometry::Surface Simulation::change_surface(geometry::Surface next) {
  nodes_.know_all();
  std::swap(next, surface_);
  contacts_->follow(geometry::SurfaceChange(next, surface_), motion(),
                    positions_before(scene_.state, 0.5 * last_drift_), pool_);
  return next;
}

}  // namespace plekton::dynamics
