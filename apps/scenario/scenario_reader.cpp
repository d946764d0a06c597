// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/scenario_reader.hpp"

#include "apps/scenario/overrides.hpp"
#include "apps/scenario/read_sections.hpp"
#include "apps/scenario/toml_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

/// Complains about a name that an earlier table of the same kind has.
template <class Settings>
void require_new_name(const std::vector<Settings>& earlier, const Settings& added,
                      Section& section) {
  const bool taken = std::any_of(earlier.begin(), earlier.end(),
                                 [&](const Settings& s) { return s.name == added.name; });
  if (taken && !added.name.empty())
    section.complain("name",
                     fmt::format("\"{}\" has this name already; names must differ", added.name));
}

void read_bodies(Section& root, Scenario& scenario) {
  const Known known{scenario.materials, scenario.file.parent_path(), scenario.simulation.seed};
  for (Section& section : root.tables("contacts"))
    scenario.contacts.push_back(read_contact(section, known, scenario.contacts));
  for (Section& section : root.tables("membranes")) {
    MembraneSettings membrane = read_membrane(section, known);
    require_new_name(scenario.membranes, membrane, section);
    scenario.membranes.push_back(std::move(membrane));
  }
  for (Section& section : root.tables("grains")) {
    GrainSettings grains = read_grains(section, known, scenario.grains.size());
    require_new_name(scenario.grains, grains, section);
    scenario.grains.push_back(std::move(grains));
  }
  for (Section& section : root.tables("planes")) {
    PlaneSettings plane = read_plane(section, known);
    require_new_name(scenario.planes, plane, section);
    scenario.planes.push_back(std::move(plane));
  }
  for (Section& section : root.tables("loads")) {
    LoadSettings load = read_load(section, scenario, scenario.loads.size());
    require_new_name(scenario.loads, load, section);
    scenario.loads.push_back(std::move(load));
  }
}

/// All sections, whether the root has a table or a recorder of keys.
Scenario read_root(Section root, Problems& problems, const fs::path& path) {
  Scenario scenario;
  scenario.file = path;
  const Table none;

  if (const auto section = root.table("simulation")) {
    scenario.simulation = read_simulation(*section);
  } else if (!root.has("simulation")) {
    problems.add(root.place(),
                 "simulation: missing; a scenario needs a table [simulation] with a duration");
  }
  if (auto section = root.table("materials")) {
    for (auto& [name, material] : section->all_tables())
      scenario.materials.push_back(read_material(name, material));
  }
  read_bodies(root, scenario);
  const auto output = root.table("output");
  scenario.output =
      read_output(output.value_or(Section(none, root.place(), "output", problems)), scenario);
  if (const auto section = root.table("stop")) scenario.stop = read_stop(*section);
  root.finish();
  return scenario;
}

Scenario scenario_of(const Table& table, const fs::path& path) {
  Problems problems;
  const Place start{path.string(), 1, 1};
  Scenario scenario = read_root(Section(table, start, "", problems), problems, path);
  if (problems.empty() && scenario.membranes.empty() && scenario.grains.empty()) {
    problems.add(start,
                 "nothing to simulate; expected at least one table [[grains]] or [[membranes]]");
  }
  problems.throw_if_any();
  return scenario;
}

}  // namespace

Scenario parse_scenario(std::string_view text, const fs::path& path,
                        std::span<const std::string> overrides) {
  Table table = parse_toml(text, path.string());
  apply_overrides(table, overrides);
  return scenario_of(table, path);
}

Scenario read_scenario(const fs::path& path, std::span<const std::string> overrides) {
  Table table = read_toml_file(path);
  apply_overrides(table, overrides);
  return scenario_of(table, path);
}

void record_keys(KeyRecorder& recorder) {
  Problems ignored;
  const Table none;
  read_root(Section(none, {}, "", ignored, &recorder), ignored, {});
}

}  // namespace plekton::apps
