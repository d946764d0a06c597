// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/pressures.hpp"

#include "apps/scenario/staged_scenario.hpp"
#include "dynamics/loads/applied_loads.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace plekton::apps {
namespace {

constexpr std::array<dynamics::OutputField, 2> kFields = {{
    {"pressure", "Pa", "over that outside, at the time of the forces"},
    {"volume", "m3", "that the membrane holds then; only where the pressure follows it"},
}};

constexpr std::size_t kNoPressure = static_cast<std::size_t>(-1);
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

std::span<const dynamics::OutputField> pressure_fields() {
  return kFields;
}

Pressures::Pressures(const std::filesystem::path& folder, const Scenario& scenario,
                     const WrittenFiles* before) {
  HistoryColumns columns;
  const std::vector<PressureColumn> own = names_in({&scenario, 1}).pressures;
  for (const PressureColumn& pressure : scenario.stage ? scenario.names_of_stages.pressures : own) {
    const auto place = std::ranges::find(own, pressure.load, &PressureColumn::load);
    loads_.push_back(place == own.end() ? kNoPressure
                                        : static_cast<std::size_t>(place - own.begin()));
    has_volume_.push_back(pressure.has_volume);
    follows_volume_.push_back(place != own.end() && place->has_volume);
    columns.add(pressure.load, kFields[0]);
    if (pressure.has_volume) columns.add(pressure.load, kFields[1]);
  }
  open(folder, kPressuresFile, columns, before);
}

void Pressures::add(const dynamics::Simulation& simulation) {
  if (!is_open()) return;
  std::vector<double> row{simulation.time()};
  for (std::size_t i = 0; i < has_volume_.size(); ++i) {
    const bool is_there = loads_[i] != kNoPressure;
    const auto& surfaces = simulation.loads().pressed_surfaces();
    row.push_back(is_there ? surfaces[loads_[i]].pressure() : kNothing);
    if (has_volume_[i]) row.push_back(follows_volume_[i] ? surfaces[loads_[i]].volume() : kNothing);
  }
  add_row(row);
}

}  // namespace plekton::apps
