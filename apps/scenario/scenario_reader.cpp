// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/scenario_reader.hpp"

#include "apps/scenario/overrides.hpp"
#include "apps/scenario/read_rigid_body.hpp"
#include "apps/scenario/read_sections.hpp"
#include "apps/scenario/stage_tables.hpp"
#include "apps/scenario/staged_scenario.hpp"
#include "apps/scenario/toml_file.hpp"
#include "apps/scenario/toml_text.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

template <class Settings>
std::string name_of_columns(const Settings& settings) {
  return settings.name;
}
std::string name_of_columns(const PlaneSettings& plane) {
  return plane.label();
}

/// Reads the tables of a kind, and complains about a name that an earlier one of them has.
/// @param read  (section), the settings of a table
template <class Settings, class Read>
void read_tables(Section& root, std::string_view key, std::vector<Settings>& all, Read&& read) {
  std::unordered_set<std::string> names;
  for (Section& section : root.tables(key)) {
    all.push_back(read(section));
    const std::string name = name_of_columns(all.back());
    if (name.empty() || names.insert(name).second) continue;
    section.complain(
        "name", section.has("name")
                    ? fmt::format("\"{}\" has this name already; names must differ", name)
                    : fmt::format("missing, and without one it is called \"{}\", as another one is "
                                  "named; give it a name",
                                  name));
  }
}

/// Of a plane or load among all that have come; there are no others without stages.
std::size_t number_of(const std::vector<std::size_t>& numbers, std::size_t i) {
  return i < numbers.size() ? numbers[i] : i;
}

bool is_set(const std::vector<bool>& flags, std::size_t i) {
  return i < flags.size() && flags[i];
}

void mark_absent(const StageOrigins& stage, Scenario& scenario) {
  for (std::size_t i = 0; i < scenario.membranes.size(); ++i)
    scenario.membranes[i].is_absent =
        !scenario.membranes[i].rigid_body && is_set(stage.absent_membranes, i);
  for (std::size_t i = 0; i < scenario.rigid_bodies.size(); ++i) {
    RigidBodySettings& body = scenario.rigid_bodies[i];
    body.is_absent = is_set(stage.absent_rigid_bodies, i);
    if (body.membrane) scenario.membranes[*body.membrane].is_absent = body.is_absent;
    if (body.grains) scenario.grains[*body.grains].is_absent = body.is_absent;
  }
}

void read_bodies(Section& root, const StageOrigins& stage, Scenario& scenario) {
  const Known known(scenario);
  MaterialPairSet taken;
  for (Section& section : root.tables("contacts"))
    scenario.contacts.push_back(read_contact(section, known, taken));
  read_tables(root, "membranes", scenario.membranes,
              [&](Section& section) { return read_membrane(section, known); });
  for (Section& section : root.tables("rigid_bodies")) read_rigid_body(section, known, scenario);
  mark_absent(stage, scenario);
  const std::size_t rigid = scenario.grains.size();
  read_tables(root, "grains", scenario.grains, [&](Section& section) {
    return read_grains(section, known, scenario.grains.size() - rigid);
  });
  require_own_names(root, scenario);
  read_tables(root, "ties", scenario.ties,
              [&](Section& section) { return read_tie(section, scenario, scenario.ties.size()); });
  read_tables(root, "planes", scenario.planes, [&](Section& section) {
    return read_plane(section, known, number_of(stage.plane_numbers, scenario.planes.size()));
  });
  read_tables(root, "loads", scenario.loads, [&](Section& section) {
    return read_load(section, scenario, number_of(stage.load_numbers, scenario.loads.size()));
  });
}

/// All sections, whether the root has a table or a recorder of keys.
Scenario read_root(Section root, const StageOrigins& stage, Problems& problems,
                   const fs::path& path) {
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
  read_bodies(root, stage, scenario);
  const auto output = root.table("output");
  scenario.output =
      read_output(output.value_or(Section(none, root.place(), "output", problems)), scenario);
  if (const auto section = root.table("stop")) scenario.stop = read_stop(*section, scenario);
  for (Section& section : root.tables("stages")) scenario.stage = read_stage(section, scenario);
  root.finish();
  return scenario;
}

/// @param start  where what is missing is said to be
Scenario scenario_of(const Table& table, const StageOrigins& stage, const Place& start,
                     Problems& problems) {
  Scenario scenario = read_root(Section(table, start, "", problems), stage, problems, start.source);
  if (problems.empty() && scenario.membranes.empty() && scenario.grains.empty()) {
    problems.add(start,
                 "nothing to simulate; expected at least one table [[grains]], [[membranes]] or "
                 "[[rigid_bodies]]");
  }
  return scenario;
}

/// All stages; the first one is the scenario itself.
Scenario staged_scenario(const Table& table, const Place& start, Problems& problems) {
  std::vector<Scenario> stages;
  for (StageTable& stage : stage_tables(table, problems)) {
    Problems of_stage;
    stages.push_back(scenario_of(stage.table, stage.origins, start, of_stage));
    const bool is_later = stages.size() > 1 && stages.back().stage;
    problems.add_of_stage(is_later ? stages.back().stage->path : "", of_stage);
    if (!stages.back().stage) continue;
    stages.back().stage->number = stages.size() - 1;
    stages.back().stage->origins = std::move(stage.origins);
  }
  if (!problems.empty()) return {};
  stages.back().stage->is_last = true;
  check_stages(stages, problems);
  const NamesOfStages names = names_in(stages);
  for (Scenario& stage : stages) stage.names_of_stages = names;
  Scenario first = stages.front();
  first.stages = std::move(stages);
  return first;
}

/// @throws InputError of a file that belongs to another command
void refuse_study(const Table& table) {
  const auto* const scenario = table.find("scenario");
  if (scenario == nullptr || table.find("simulation") != nullptr) return;
  Problems problems;
  problems.add(scenario->place,
               "scenario: this file is a study of a scenario; expected a scenario, or run the "
               "study by `plekton study`");
  problems.throw_if_any();
}

/// @param start  where what is missing is said to be
Scenario whole_scenario(const Table& table, const Place& start, std::string_view text,
                        std::span<const std::string> overrides) {
  refuse_study(table);
  Problems problems;
  Scenario scenario = has_stages(table) ? staged_scenario(table, start, problems)
                                        : scenario_of(table, {}, start, problems);
  problems.throw_if_any();
  const auto note_origin = [&](Scenario& of) {
    of.text = text;
    of.overrides.assign(overrides.begin(), overrides.end());
  };
  note_origin(scenario);
  for (Scenario& stage : scenario.stages) note_origin(stage);
  return scenario;
}

}  // namespace

Scenario parse_scenario(std::string_view text, const fs::path& path,
                        std::span<const std::string> overrides) {
  Table table = parse_toml(text, path.string());
  apply_overrides(table, overrides);
  return whole_scenario(table, {path.string(), 1, 1}, text, overrides);
}

Scenario scenario_from(Table table, const fs::path& path, std::span<const std::string> overrides) {
  const std::string text = to_toml(table);
  apply_overrides(table, overrides);
  return whole_scenario(table, {path.string(), 0, 0}, text, overrides);
}

Scenario read_scenario(const fs::path& path, std::span<const std::string> overrides) {
  return parse_scenario(read_toml_text(path),
                        path == kStandardInput ? fs::path(kStandardInputName) : path, overrides);
}

void record_keys(KeyRecorder& recorder) {
  Problems ignored;
  const Table none;
  read_root(Section(none, {}, "", ignored, &recorder), {}, ignored, {});
}

}  // namespace plekton::apps
