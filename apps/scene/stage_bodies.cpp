// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scene/stage_bodies.hpp"

#include "geometry/base/state_archive.hpp"

#include <string>

namespace plekton::apps {

void StageBodies::exchange(const geometry::StateArchive& archive) {
  archive("number", stage);
  std::size_t start_count = starts.size();
  archive("starts", start_count);
  starts.resize(start_count);
  for (std::size_t i = 0; i < start_count; ++i) {
    const auto group = archive.group("start_" + std::to_string(i));
    group("time", starts[i].time);
    group("positions", starts[i].positions);
    group("planes", starts[i].planes);
    group("radii", starts[i].radii);
  }
  std::size_t tables = grains.size();
  archive("tables_of_grains", tables);
  grains.resize(tables);
  for (std::size_t i = 0; i < tables; ++i) archive("radii_" + std::to_string(i), grains[i]);
  archive("held", held);
  archive("is_absent", is_absent);
}

KeptBodies::KeptBodies(const StageBodies& before, const std::vector<bool>& tables,
                       std::span<const geometry::Vec3> positions, const IsOut& is_out)
    : nodes_(positions.size(), 0) {
  std::size_t node = positions.size();
  for (std::size_t table = 0; table < before.grains.size(); ++table)
    if (tables[table]) node -= before.grains[table].size();
  for (std::size_t table = 0; table < before.grains.size(); ++table) {
    bodies_.grains.emplace_back();
    for (const double radius : before.grains[table]) {
      const bool is_gone = tables[table] && is_out(table, positions[node]);
      if (is_gone)
        nodes_[node] = -1;
      else
        bodies_.grains.back().push_back(radius);
      if (tables[table]) ++node;
    }
  }
  std::int32_t next = 0;
  for (std::int32_t& number : nodes_)
    if (number == 0) number = next++;
  bodies_.stage = before.stage;
  bodies_.held = kept(std::span(before.held));
  bodies_.is_absent = before.is_absent;
  for (const StageStart& start : before.starts)
    bodies_.starts.push_back(
        {start.time, kept(std::span(start.positions)), start.planes, start.radii});
  positions_ = kept(positions);
}

}  // namespace plekton::apps
