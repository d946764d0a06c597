// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/body_tables.hpp"

#include "apps/scenario/staged_scenario.hpp"
#include "geometry/critical/product_features.hpp"

namespace plekton::apps {

using contact::BodyKind;
using contact::ContactBody;
using geometry::index_of;

std::string path_of(const BodyTable& table, const Scenario& scenario) {
  switch (table.kind) {
    case BodyTable::Kind::plane:
      return scenario.planes[table.number].path();
    case BodyTable::Kind::membrane:
      return (scenario.membranes[table.number].rigid_body ? "rigid_bodies." : "membranes.") +
             scenario.membranes[table.number].name;
    case BodyTable::Kind::grains:
      break;
  }
  return (scenario.grains[table.number].rigid_body ? "rigid_bodies." : "grains.") +
         scenario.grains[table.number].name;
}

BodyTables::BodyTables(const Scenario& scenario, const BuiltScene& built,
                       const dynamics::Simulation& simulation)
    : simulation_(simulation),
      plane_numbers_(plane_numbers(scenario)),
      groups_(simulation.state().size(), -1),
      materials_(simulation.state().size(), -1) {
  const auto add_materials = [&](BodyTable::Kind kind, const auto& tables) {
    for (const auto& table : tables)
      material_of_[static_cast<std::size_t>(kind)].push_back(table.material);
  };
  add_materials(BodyTable::Kind::grains, scenario.grains);
  add_materials(BodyTable::Kind::membrane, scenario.membranes);
  add_materials(BodyTable::Kind::plane, scenario.planes);
  for (std::size_t m = 0; m < built.membranes.size(); ++m) {
    const BuiltMembrane& membrane = built.membranes[m];
    for (std::size_t n = membrane.first_node; n < membrane.first_node + membrane.nodes; ++n)
      set_node(n, {BodyTable::Kind::membrane, m});
  }
  for (std::size_t g = 0; g < built.grains.size(); ++g) {
    const std::size_t first = first_grain_.back();
    first_grain_.push_back(first + built.grains[g].count);
    for (std::size_t i = first; i < first_grain_.back(); ++i)
      set_node(index_of(simulation.elements().spheres[i].nodes[0]), {BodyTable::Kind::grains, g});
  }
}

void BodyTables::set_node(std::size_t node, const BodyTable& table) {
  groups_[node] = static_cast<std::int32_t>(table.number);
  materials_[node] = static_cast<std::int32_t>(material_of(table));
}

BodyTable BodyTables::table_of(const ContactBody& body) const {
  const auto i = static_cast<std::size_t>(body.index);
  switch (body.kind) {
    case BodyKind::plane:
      return {BodyTable::Kind::plane, i};
    case BodyKind::structure: {
      const std::size_t node = index_of(nodes_of(simulation_.surface(), body.feature).ids[0]);
      return {BodyTable::Kind::membrane, static_cast<std::size_t>(groups_[node])};
    }
    case BodyKind::sphere:
      break;
  }
  const std::size_t node = index_of(simulation_.elements().spheres[i].nodes[0]);
  return {BodyTable::Kind::grains, static_cast<std::size_t>(groups_[node])};
}

std::size_t BodyTables::grain_of(const ContactBody& body) const {
  return body.kind == BodyKind::sphere
             ? static_cast<std::size_t>(body.index) - first_grain_[table_of(body).number]
             : 0;
}

std::size_t BodyTables::material_of(const BodyTable& table) const {
  return material_of_[static_cast<std::size_t>(table.kind)][table.number];
}

dynamics::ContactLabels BodyTables::labels_of(const contact::ContactRecord& contact) const {
  const BodyTable a = table_of(contact.a);
  const BodyTable b = table_of(contact.b);
  return {number_of(a), number_of(b), static_cast<std::int32_t>(material_of(a)),
          static_cast<std::int32_t>(material_of(b))};
}

}  // namespace plekton::apps
