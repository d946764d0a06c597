// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/initial_contacts.hpp"

#include "apps/run/run_warnings.hpp"
#include "geometry/closest/core_pair.hpp"
#include "geometry/product_features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>

namespace plekton::apps {
namespace {

using contact::BodyKind;
using contact::ContactBody;
using contact::ContactRow;
using geometry::index_of;

/// Says of the bodies of contacts which tables they are from, and what they are.
class Bodies {
 public:
  Bodies(const Scenario& scenario, const BuiltScene& built, const dynamics::Simulation& simulation)
      : scenario_(scenario), simulation_(simulation) {
    for (const BuiltGrains& grains : built.grains)
      first_grain_.push_back(first_grain_.back() + grains.count);
    const geometry::Surface& surface = simulation.surface();
    membrane_of_.resize(surface.structure_count());
    for (std::size_t m = 0; m < built.membranes.size(); ++m) {
      const BuiltMembrane& membrane = built.membranes[m];
      for (std::size_t n = membrane.first_node; n < membrane.first_node + membrane.nodes; ++n) {
        const auto structure = surface.structure_of(geometry::id_at<geometry::NodeId>(n));
        if (structure != geometry::StructureId{-1}) membrane_of_[index_of(structure)] = m;
      }
    }
  }

  BodyTable table_of(const ContactBody& body) const {
    const auto i = static_cast<std::size_t>(body.index);
    if (body.kind == BodyKind::plane) return {BodyTable::Kind::plane, i};
    if (body.kind == BodyKind::structure) return {BodyTable::Kind::membrane, membrane_of_[i]};
    const auto above = std::upper_bound(first_grain_.begin(), first_grain_.end(), i);
    return {BodyTable::Kind::grains, static_cast<std::size_t>(above - first_grain_.begin()) - 1};
  }

  /// Its number in the table of grains; 0 of other bodies.
  std::size_t grain_of(const ContactBody& body) const {
    return body.kind == BodyKind::sphere
               ? static_cast<std::size_t>(body.index) - first_grain_[table_of(body).number]
               : 0;
  }

  /// m; nothing for a plane.
  std::optional<double> radius_of(const ContactBody& body) const {
    const auto i = static_cast<std::size_t>(body.index);
    if (body.kind == BodyKind::plane) return std::nullopt;
    if (body.kind == BodyKind::sphere) return simulation_.elements().spheres[i].radius;
    return simulation_.surface().radius(geometry::id_at<geometry::StructureId>(i));
  }

  /// m. Where structures touch over an area the gap of their contact stands for all of it; how far
  /// they are in each other is seen where they are deepest.
  double depth_of(const ContactRow& row) const {
    if (row.a.kind != BodyKind::structure || row.b.kind != BodyKind::structure) return -row.gap;
    const double distance = closest_points(core_of(row.a), core_of(row.b)).distance;
    return radius_of(row.a).value() + radius_of(row.b).value() - distance;
  }

  std::size_t material_of(const ContactBody& body) const {
    const auto [kind, number] = table_of(body);
    switch (kind) {
      case BodyTable::Kind::plane:
        return scenario_.planes[number].material;
      case BodyTable::Kind::membrane:
        return scenario_.membranes[number].material;
      case BodyTable::Kind::grains:
        break;
    }
    return scenario_.grains[number].material;
  }

 private:
  geometry::Core core_of(const ContactBody& body) const {
    const geometry::FeatureNodes nodes = nodes_of(simulation_.surface(), body.feature);
    geometry::Core core;
    for (std::size_t i = 0; i < nodes.count; ++i)
      core.x[core.count++] = simulation_.state().position[index_of(nodes.ids[i])];
    return core;
  }

  const Scenario& scenario_;
  const dynamics::Simulation& simulation_;
  std::vector<std::size_t> first_grain_{0};  ///< by table, and their end
  std::vector<std::size_t> membrane_of_;     ///< by StructureId
};

/// Between structures a bond has a row of its own beside that of the contact.
bool is_bond_alone(const ContactRow& row) {
  return row.is_bonded && row.a.kind == BodyKind::structure && row.b.kind == BodyKind::structure;
}

/// What a depth may be off by (m): centres and their distance are rounded.
double rounding_of(const ContactRow& row) {
  constexpr double kRoundings = 8.0;
  const double furthest =
      std::max(row.point_a.cwiseAbs().maxCoeff(), row.point_b.cwiseAbs().maxCoeff());
  return kRoundings * std::numeric_limits<double>::epsilon() * (furthest + std::abs(row.gap));
}

std::optional<InitialOverlap> overlap_of(const ContactRow& row, const Bodies& bodies) {
  const double depth = bodies.depth_of(row);
  if (is_bond_alone(row) || !(depth > rounding_of(row))) return std::nullopt;
  const double radius_a = bodies.radius_of(row.a).value();  // Only b may be a plane.
  const double radius_b = bodies.radius_of(row.b).value_or(radius_a);
  InitialOverlap overlap;
  overlap.of = {bodies.table_of(row.a), bodies.table_of(row.b)};
  overlap.grains = {bodies.grain_of(row.a), bodies.grain_of(row.b)};
  if (std::pair(overlap.of[1], overlap.grains[1]) < std::pair(overlap.of[0], overlap.grains[0])) {
    std::swap(overlap.of[0], overlap.of[1]);
    std::swap(overlap.grains[0], overlap.grains[1]);
  }
  overlap.depth = depth;
  overlap.ratio = depth / std::min(radius_a, radius_b);
  overlap.place = row.point;
  const bool is_own =
      overlap.of[0] == overlap.of[1] && overlap.of[0].kind == BodyTable::Kind::membrane;
  overlap.is_impossible = !is_own && depth > std::max(radius_a, radius_b);
  return overlap;
}

/// How many of some contacts are bonds, by table [[contacts]].
std::vector<std::size_t> count_bonds(std::span<const ContactRow> rows, const Bodies& bodies,
                                     const std::vector<PairSettings>& tables) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> table_of;
  for (std::size_t i = 0; i < tables.size(); ++i)
    table_of.emplace(std::pair(tables[i].first, tables[i].second), i);
  std::vector<std::size_t> counts(tables.size());
  for (const ContactRow& row : rows) {
    if (!row.is_bonded) continue;
    const auto table =
        table_of.find(std::minmax({bodies.material_of(row.a), bodies.material_of(row.b)}));
    if (table != table_of.end()) ++counts[table->second];
  }
  return counts;
}

/// Of a table that is none of planes.
const Place& place_of(const BodyTable& table, const Scenario& scenario) {
  return table.kind == BodyTable::Kind::membrane ? scenario.membranes[table.number].source_place
                                                 : scenario.grains[table.number].place;
}

/// @param count    of impossible overlaps of these two tables
/// @param deepest  of them
std::string refusal_of(std::size_t count, const InitialOverlap& deepest, const Scenario& scenario) {
  const std::string a = path_of(deepest.of[0], scenario);
  const std::string b = path_of(deepest.of[1], scenario);
  const std::string which = count == 1 ? "" : "the deepest ";
  if (deepest.of[1].kind == BodyTable::Kind::plane) {
    return fmt::format(
        "{}: {} of its {} begin behind {}, {}by {}; move them to the side that the normal of the "
        "plane points to, or move or turn the plane",
        a, count, deepest.of[0].kind == BodyTable::Kind::grains ? "grains" : "nodes", b, which,
        text_of(deepest));
  }
  return fmt::format("{}: begins in {} at {} {}, deeper than both radii, {}by {}; move them apart",
                     a, b, count, count == 1 ? "place" : "places", which, text_of(deepest));
}

/// Empty if the rule of a table [[contacts]] glues something, or nothing by its nature.
/// @param count  of its bonds at the start
std::string warning_about_bonds(const Scenario& scenario, std::size_t table, std::size_t count) {
  const PairSettings& pair = scenario.contacts[table];
  const auto bonds = contact::bonds_of(pair.contact);
  const char* what = nullptr;
  if (bonds == contact::Bonds::none)
    what =
        "its bonds have no strength and glue nothing; give tensile_strength or shear_strength, or "
        "another law";
  if (bonds == contact::Bonds::at_start && count == 0)
    what =
        "bonds = \"start\" glues nothing: no such bodies touch at the start; let them overlap a "
        "little, or take bonds = \"new\"";
  if (what == nullptr) return "";
  return fmt::format("{}: contacts[{}], {} with {}: {}", to_string(pair.place), table,
                     scenario.materials[pair.first].name, scenario.materials[pair.second].name,
                     what);
}

}  // namespace

InitialContacts initial_contacts(const Scenario& scenario, const BuiltScene& built,
                                 const dynamics::Simulation& simulation) {
  const Bodies bodies(scenario, built, simulation);
  InitialContacts contacts;
  const std::vector<ContactRow> rows = simulation.contact_rows();
  contacts.bonds = count_bonds(rows, bodies, scenario.contacts);
  for (const ContactRow& row : rows) {
    if (const auto overlap = overlap_of(row, bodies)) contacts.overlaps.push_back(*overlap);
  }
  std::stable_sort(
      contacts.overlaps.begin(), contacts.overlaps.end(),
      [](const InitialOverlap& a, const InitialOverlap& b) { return a.ratio > b.ratio; });
  return contacts;
}

std::string path_of(const BodyTable& table, const Scenario& scenario) {
  switch (table.kind) {
    case BodyTable::Kind::plane: {
      const std::string& name = scenario.planes[table.number].name;
      return name.empty() ? fmt::format("planes[{}]", table.number) : "planes." + name;
    }
    case BodyTable::Kind::membrane:
      return "membranes." + scenario.membranes[table.number].name;
    case BodyTable::Kind::grains:
      break;
  }
  return "grains." + scenario.grains[table.number].name;
}

std::string text_of(const InitialOverlap& overlap) {
  std::string who;
  for (std::size_t side = 0; side < 2; ++side) {
    if (overlap.of[side].kind != BodyTable::Kind::grains) continue;
    who += fmt::format("{} grain {}", who.empty() ? " of" : " and", overlap.grains[side]);
  }
  const Vec3& x = overlap.place;
  return fmt::format("{:.3g} mm ({:.3g} % of the radius){} at ({:.4g}, {:.4g}, {:.4g}) m",
                     1e3 * overlap.depth, 100.0 * overlap.ratio, who, x[0], x[1], x[2]);
}

std::vector<std::string> warnings_about(const InitialContacts& contacts, const Scenario& scenario) {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < scenario.contacts.size(); ++i) {
    const std::string warning = warning_about_bonds(scenario, i, contacts.bonds[i]);
    if (!warning.empty()) warnings.push_back(warning);
  }
  const auto shallow =
      std::find_if(contacts.overlaps.begin(), contacts.overlaps.end(),
                   [](const InitialOverlap& overlap) { return overlap.ratio <= kDeepOverlap; });
  const auto deep = shallow - contacts.overlaps.begin();
  if (deep == 0) return warnings;
  const InitialOverlap& deepest = contacts.overlaps.front();
  warnings.push_back(fmt::format(
      "{} contacts begin with an overlap above {:.0f} % of the radius, the deepest {} with {} by "
      "{}; what is in each other flies apart; `plekton check` lists all",
      deep, 100.0 * kDeepOverlap, path_of(deepest.of[0], scenario),
      path_of(deepest.of[1], scenario), text_of(deepest)));
  return warnings;
}

void require_possible_start(const InitialContacts& contacts, const Scenario& scenario) {
  struct Impossible {
    std::size_t count = 0;
    const InitialOverlap* deepest = nullptr;
  };
  std::map<std::array<BodyTable, 2>, Impossible> by_tables;
  for (const InitialOverlap& overlap : contacts.overlaps) {
    if (!overlap.is_impossible) continue;
    Impossible& all = by_tables[overlap.of];
    if (all.count++ == 0) all.deepest = &overlap;
  }
  Problems problems;
  for (const auto& [tables, all] : by_tables)
    problems.add(place_of(tables[0], scenario), refusal_of(all.count, *all.deepest, scenario));
  problems.throw_if_any();
}

}  // namespace plekton::apps
