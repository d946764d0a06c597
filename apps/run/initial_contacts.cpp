// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/initial_contacts.hpp"

#include "apps/run/run_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <span>
#include <string_view>
#include <utility>

namespace plekton::apps {
namespace {

using contact::ContactRecord;

/// How many of some contacts are bonds, by table [[contacts]].
std::vector<std::size_t> count_bonds(std::span<const ContactRecord> rows, const BodyTables& bodies,
                                     const std::vector<PairSettings>& tables) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> table_of;
  for (std::size_t i = 0; i < tables.size(); ++i)
    table_of.emplace(std::pair(tables[i].first, tables[i].second), i);
  std::vector<std::size_t> counts(tables.size());
  for (const ContactRecord& row : rows) {
    if (!row.is_bonded) continue;
    const auto table = table_of.find(std::minmax(
        {bodies.material_of(bodies.table_of(row.a)), bodies.material_of(bodies.table_of(row.b))}));
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
std::string refusal_of(std::size_t count, const BodyOverlap& deepest, const Scenario& scenario) {
  const std::string a = path_of(deepest.of[0], scenario);
  const std::string b = path_of(deepest.of[1], scenario);
  const std::string which = count == 1 ? "" : "the deepest ";
  if (deepest.of[1].kind == BodyTable::Kind::plane) {
    const char* const way_out =
        scenario.planes[deepest.of[1].number].is_flat()
            ? "move them to the side that the normal of the plane points to, or move or turn the "
              "plane"
            : "move them inside, or move or widen it";
    return fmt::format("{}: {} of its {} {} behind {}, {}by {}; {}", a, count,
                       deepest.of[0].kind == BodyTable::Kind::grains ? "grains" : "nodes",
                       count == 1 ? "begins" : "begin", b, which, text_of(deepest), way_out);
  }
  return fmt::format("{}: begins in {} at {} {}, deeper than both radii, {}by {}; move them apart",
                     a, b, count, count == 1 ? "place" : "places", which, text_of(deepest));
}

std::string about(const Scenario& scenario, std::size_t table, std::string_view what) {
  const PairSettings& pair = scenario.contacts[table];
  return fmt::format("{}: contacts[{}], {} with {}: {}", to_string(pair.place), table,
                     scenario.materials[pair.first].name, scenario.materials[pair.second].name,
                     what);
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
  return what == nullptr ? "" : about(scenario, table, what);
}

/// A limit of a spring that is not there; a stage may have taken the spring away.
std::vector<std::string> warnings_about_limits(const Scenario& scenario, std::size_t table) {
  std::vector<std::string> warnings;
  if (scenario.stage && scenario.stage->number > 0) return warnings;
  const contact::RollingTwisting::Properties& of = scenario.contacts[table].contact.rolling;
  const auto check = [&](std::string_view motion, double stiffness, double limit) {
    if (stiffness > 0.0 || !std::isfinite(limit)) return;
    warnings.push_back(about(
        scenario, table,
        fmt::format("{0}_limit does nothing without {0}_stiffness; give one, such as 1", motion)));
  };
  check("rolling", of.rolling_stiffness, of.rolling_limit);
  check("twisting", of.twisting_stiffness, of.twisting_limit);
  return warnings;
}

}  // namespace

std::vector<ContactRecord> first_contacts(const dynamics::Simulation& simulation) {
  std::vector<ContactRecord> rows = simulation.contact_rows();
  simulation.contacts().for_each_balanced(simulation.state().position,
                                          [&](const ContactRecord& row) { rows.push_back(row); });
  return rows;
}

InitialContacts initial_contacts(const Scenario& scenario, const BuiltScene& built,
                                 const dynamics::Simulation& simulation,
                                 std::span<const ContactRecord> rows) {
  const BodyTables bodies(scenario, built, simulation);
  InitialContacts contacts;
  contacts.bonds = count_bonds(rows, bodies, scenario.contacts);
  for (const ContactRecord& row : rows) {
    if (const auto overlap = overlap_of(row, bodies, simulation))
      contacts.overlaps.push_back(*overlap);
  }
  std::stable_sort(contacts.overlaps.begin(), contacts.overlaps.end(),
                   [](const BodyOverlap& a, const BodyOverlap& b) { return a.ratio > b.ratio; });
  return contacts;
}

std::vector<std::string> warnings_about(const InitialContacts& contacts, const Scenario& scenario) {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < scenario.contacts.size(); ++i) {
    const std::string warning = warning_about_bonds(scenario, i, contacts.bonds[i]);
    if (!warning.empty()) warnings.push_back(warning);
    std::ranges::copy(warnings_about_limits(scenario, i), std::back_inserter(warnings));
  }
  const auto shallow =
      std::find_if(contacts.overlaps.begin(), contacts.overlaps.end(),
                   [](const BodyOverlap& overlap) { return overlap.ratio <= kDeepOverlap; });
  const auto deep = shallow - contacts.overlaps.begin();
  if (deep == 0) return warnings;
  const BodyOverlap& deepest = contacts.overlaps.front();
  warnings.push_back(fmt::format(
      "{} with an overlap above {:.0f} % of the radius, the deepest {} with {} by "
      "{}; what is in each other flies apart; `plekton check` lists all",
      deep == 1 ? "1 contact begins" : fmt::format("{} contacts begin", deep), 100.0 * kDeepOverlap,
      path_of(deepest.of[0], scenario), path_of(deepest.of[1], scenario), text_of(deepest)));
  return warnings;
}

Problems impossible_starts(const InitialContacts& contacts, const Scenario& scenario) {
  struct Impossible {
    std::size_t count = 0;
    const BodyOverlap* deepest = nullptr;
  };
  std::map<std::array<BodyTable, 2>, Impossible> by_tables;
  for (const BodyOverlap& overlap : contacts.overlaps) {
    if (!overlap.is_impossible) continue;
    Impossible& all = by_tables[overlap.of];
    if (all.count++ == 0) all.deepest = &overlap;
  }
  Problems problems;
  const bool is_later = scenario.stage && scenario.stage->number > 0;
  const std::string stage = is_later ? scenario.stage->path + ": at its start " : "";
  for (const auto& [tables, all] : by_tables)
    problems.add(place_of(tables[0], scenario),
                 stage + refusal_of(all.count, *all.deepest, scenario));
  return problems;
}

void require_possible_start(const InitialContacts& contacts, const Scenario& scenario) {
  impossible_starts(contacts, scenario).throw_if_any();
}

}  // namespace plekton::apps
