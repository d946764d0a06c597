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
  }
  std::size_t tables = grains.size();
  archive("tables_of_grains", tables);
  grains.resize(tables);
  for (std::size_t i = 0; i < tables; ++i) archive("radii_" + std::to_string(i), grains[i]);
  archive("held", held);
  archive("is_absent", is_absent);
}

}  // namespace plekton::apps
