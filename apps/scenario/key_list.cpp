// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/key_list.hpp"

#include "apps/scenario/scenario_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace plekton::apps {
namespace {

using Keys = std::vector<ListedKey>;

/// Keys whose presence changes what the reader asks for, or which default another key has: with
/// these sets away, one after the other, it asks for everything.
const std::vector<std::set<std::string>>& absences() {
  static const std::vector<std::set<std::string>> sets = {
      {"loads[].plane",
       "loads[].grains",
       "loads[].angular_velocity",
       "loads[].turn",
       "membranes[].longest_hole",
       "membranes[].wrap_detail",
       "membranes[].wire",
       "membranes[].ondem",
       "output.reactions[].grains",
       "grains[].centres",
       "grains[].radii",
       "grains[].table",
       "grains[].ondem",
       "loads[].rigid_body",
       "output.reactions[].rigid_body",
       "rigid_bodies[].spheres",
       "rigid_bodies[].mass",
       "rigid_bodies[].longest_hole",
       "rigid_bodies[].wrap_detail",
       "stages[].remove[].grains",
       "stages[].fix[].grains",
       "stages[].free[].grains",
       "stages[].fix[].rigid_body",
       "stages[].free[].rigid_body",
       "stages[].end.displacement.rigid_body",
       "stages[].end.displacement.grains",
       "stages[].end.displacement.plane",
       "stages[].end.force.above",
       "stop.displacement.rigid_body",
       "stop.displacement.grains",
       "stop.displacement.plane",
       "stop.force.above",
       "ties[].from.rigid_body",
       "ties[].to.rigid_body"},
      {"loads[].plane",
       "loads[].membrane",
       "grains[].table",
       "grains[].ondem",
       "output.reactions[].membrane",
       "loads[].rigid_body",
       "output.reactions[].rigid_body",
       "stages[].remove[].membrane",
       "stages[].fix[].membrane",
       "stages[].free[].membrane",
       "stages[].fix[].rigid_body",
       "stages[].free[].rigid_body",
       "stages[].end.displacement.rigid_body",
       "stages[].end.displacement.membrane",
       "stages[].end.displacement.plane",
       "stages[].end.force.above",
       "stop.displacement.rigid_body",
       "stop.displacement.membrane",
       "stop.displacement.plane",
       "stop.force.above"},
      {"grains[].ondem", "stages[].end.displacement.plane", "stages[].end.force.above",
       "stop.displacement.plane", "stop.force.above"},
      {"loads[].plane", "loads[].torque"},
      {"loads[].plane"}};
  return sets;
}

/// "loads[].kind" to "loads[]."; empty if it is not a kind.
std::string parent_of_kind(const ListedKey& key) {
  constexpr std::string_view kKind = "kind";
  return key.path.ends_with(".kind") ? key.path.substr(0, key.path.size() - kKind.size()) : "";
}

/// "loads[].", "materials.NAME.", "simulation."
std::string table_of(const std::string& path) {
  const std::size_t named = path.find("NAME.");
  const std::size_t end = named == std::string::npos ? path.find('.') : named + 4;
  return path.substr(0, end + 1);
}

/// "loads[]." to "[[loads]]", "membranes[].shape." to "[[membranes]] shape".
std::string heading(std::string path) {
  path.pop_back();
  const std::size_t list = path.find("[]");
  if (list == std::string::npos) return fmt::format("[{}]", path);
  std::string rest = path.substr(list + 2);
  std::replace(rest.begin(), rest.end(), '.', ' ');
  return fmt::format("[[{}]]{}", path.substr(0, list), rest);
}

/// Those below a path, but for its kind.
Keys below(const std::string& path, const Keys& keys) {
  Keys found;
  for (const ListedKey& key : keys) {
    if (!key.path.starts_with(path) || key.path == path + "kind") continue;
    found.push_back(key);
    found.back().path.erase(0, path.size());
  }
  return found;
}

/// One group for each kind, in place of the table.
void add_kinds(const ListedKey& kind, std::vector<KeyGroup>& groups) {
  const std::string path = parent_of_kind(kind);
  for (const std::string& word : kind.types.front().words)
    groups.push_back({heading(path), word, below(path, listed_keys({{kind.path, word}}))});
}

}  // namespace

std::vector<ListedKey> listed_keys(const std::map<std::string, std::string>& chosen) {
  Keys all;
  for (const std::set<std::string>& absent : absences()) {
    KeyRecorder recorder(absent, chosen);
    record_keys(recorder);
    for (const ListedKey& key : recorder.keys()) {
      if (std::none_of(all.begin(), all.end(), [&](const auto& k) { return k.path == key.path; }))
        all.push_back(key);
    }
  }
  return all;
}

std::vector<KeyGroup> scenario_keys() {
  const Keys all = listed_keys();
  std::vector<KeyGroup> groups;
  std::set<std::string> kinds;
  for (const ListedKey& key : all) {
    if (const std::string path = parent_of_kind(key); !path.empty()) kinds.insert(path);
  }
  std::set<std::string> done;
  for (const ListedKey& key : all) {
    const std::string table = table_of(key.path);
    if (!done.insert(table).second) continue;
    KeyGroup group{heading(table), "", {}};
    for (const ListedKey& own : below(table, all)) {
      const std::string path = table + own.path;
      const bool is_of_kind = std::any_of(kinds.begin(), kinds.end(),
                                          [&](const auto& kind) { return path.starts_with(kind); });
      if (!is_of_kind) group.keys.push_back(own);
    }
    if (!group.keys.empty()) groups.push_back(std::move(group));
    for (const ListedKey& kind : all) {
      if (!parent_of_kind(kind).empty() && kind.path.starts_with(table)) add_kinds(kind, groups);
    }
  }
  return groups;
}

}  // namespace plekton::apps
