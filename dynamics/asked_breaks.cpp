// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/asked_breaks.hpp"

#include "dynamics/measures/energy_ledger.hpp"
#include "dynamics/model/exchange_scene.hpp"
#include "dynamics/model/require_index.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/structure/sheet_facets.hpp"
#include "geometry/primitives/node_sets.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace plekton::dynamics {

namespace {

/// Whether any element is on these nodes, in whatever order.
/// @param sorted  ascending
template <class Element, class Nodes>
bool has_element_on(const std::vector<Element>& elements, const Nodes& sorted) {
  return std::ranges::any_of(
      elements, [&](const Element& element) { return geometry::sorted(element.nodes) == sorted; });
}

}  // namespace

void AskedBreaks::ask_bond(std::size_t bond, std::size_t bond_count) {
  require_index("break_bond", "bond", bond, bond_count);
  parts_.bonds.push_back(bond);
}

void AskedBreaks::ask_cylinder(NodeId a, NodeId b, const Scene& scene) {
  for (const NodeId node : {a, b}) require_node("break_cylinder", node, scene.state.size());
  const auto nodes = geometry::sorted(std::array{a, b});
  if (!has_element_on(scene.elements.cylinders, nodes)) {
    throw std::invalid_argument("there is no cylinder between nodes " +
                                std::to_string(static_cast<std::int32_t>(a)) + " and " +
                                std::to_string(static_cast<std::int32_t>(b)) +
                                "; elements() are those that are left");
  }
  parts_.cylinders.push_back(nodes);
  for (std::size_t i = 0; i < scene.bonds.size(); ++i) {
    if (geometry::sorted(scene.bonds[i].nodes) == nodes) parts_.bonds.push_back(i);
  }
}

void AskedBreaks::ask_facet(const std::array<NodeId, 3>& nodes, const Scene& scene) {
  for (const NodeId node : nodes) require_node("break_facet", node, scene.state.size());
  const auto corners = geometry::sorted(nodes);
  if (!has_element_on(scene.elements.facets, corners)) {
    std::string text = "there is no facet on nodes";
    for (const NodeId node : nodes) text += " " + std::to_string(static_cast<std::int32_t>(node));
    throw std::invalid_argument(text + "; elements() are those that are left");
  }
  parts_.facets.push_back(corners);
}

void AskedBreaks::break_all(BeamBonds& bonds, SheetFacets& sheets, const NodeState& state,
                            double drift, EnergyLedger& ledger) const {
  for (const std::size_t bond : parts_.bonds) {
    ledger.add_broken(bonds.lost_by_break(bond, bonds.spring(bond), state, drift));
    bonds.break_bond(bond);
  }
  for (const auto& nodes : parts_.facets) {
    for (std::size_t i = 0; i < sheets.size(); ++i) {
      if (geometry::sorted(sheets.nodes(i)) == nodes) sheets.break_facet(i, state, drift);
    }
  }
}

void AskedBreaks::add_broken(const YieldingBonds& yielding_bonds, const SheetFacets& sheets) {
  const std::span<const std::size_t> yielded = yielding_bonds.broken();
  parts_.bonds.insert(parts_.bonds.end(), yielded.begin(), yielded.end());
  for (const std::size_t facet : sheets.broken()) parts_.facets.push_back(sheets.nodes(facet));
}

void AskedBreaks::exchange(const geometry::StateArchive& archive, std::size_t bond_count,
                           std::size_t node_count) {
  archive("bonds", parts_.bonds);
  archive("cylinders", parts_.cylinders);
  archive("facets", parts_.facets);
  for (const std::size_t bond : parts_.bonds) archive.require(bond < bond_count, "bonds");
  for (const auto& nodes : parts_.cylinders)
    archive.require(are_nodes(nodes, node_count), "cylinders");
  for (const auto& nodes : parts_.facets) archive.require(are_nodes(nodes, node_count), "facets");
}

}  // namespace plekton::dynamics
