// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/scenario.hpp"
#include "apps/scenario/section.hpp"

#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

/// One function for each kind of table of a scenario. Each reads all its keys and finishes the
/// section.
namespace plekton::apps {

/// What tables refer to.
struct Known {
  /// @param scenario  with its materials; must outlive this
  explicit Known(const Scenario& scenario);

  const std::vector<MaterialSettings>& materials;
  std::unordered_map<std::string_view, std::size_t> material_places;  ///< by name
  std::filesystem::path folder;                                       ///< of the scenario
  std::uint64_t seed;                                                 ///< of the scenario
};

/// Pairs of materials, the lower one first.
using MaterialPairSet = std::set<std::pair<std::size_t, std::size_t>>;

SimulationSettings read_simulation(Section section);
MaterialSettings read_material(const std::string& name, Section section);
/// @param taken  the pairs of earlier tables; takes up this one
PairSettings read_contact(Section section, const Known& known, MaterialPairSet& taken);
MembraneSettings read_membrane(Section section, const Known& known);
/// @param number  Position among the tables: grains without a seed of their own differ by it.
GrainSettings read_grains(Section section, const Known& known, std::size_t number);
/// @param number  among all planes that have come, in any stage
PlaneSettings read_plane(Section section, const Known& known, std::size_t number);
/// @param scenario  with its duration, from which the intervals have their defaults, and its bodies
OutputSettings read_output(Section section, const Scenario& scenario);
/// @param scenario  with its bodies, planes, loads and output
StageEnd read_stop(Section section, const Scenario& scenario);
/// @param scenario  of the stage, with its bodies, planes and loads
StageSettings read_stage(Section section, const Scenario& scenario);

/// @param scenario  with its membranes, grains and planes
/// @param number    among all loads that have come, in any stage, for those without a name
LoadSettings read_load(Section section, const Scenario& scenario, std::size_t number);

/// @param scenario  with its membranes and rigid bodies
/// @param number    Position among the tables, for those without a name.
TieSettings read_tie(Section section, const Scenario& scenario, std::size_t number);

/// The material that a key names; nothing after a problem.
std::optional<std::size_t> read_material_of(Section& section, const Known& known,
                                            std::string_view key = "material");
/// A box from the keys min and max of a table.
geometry::Box read_box(Section section);
/// What read_box() takes.
ValueType box_type();

}  // namespace plekton::apps
