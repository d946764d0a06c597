// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/plane_places.hpp"

#include "apps/scenario/staged_scenario.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

namespace plekton::apps {
namespace {

constexpr std::array<dynamics::OutputField, 8> kPlaneFields = {{
    {"point_x", "m", "of a point of the plane, which moves with it"},
    {"point_y", "m", "likewise"},
    {"point_z", "m", "likewise"},
    {"normal_x", "", "of the unit normal into the space of the bodies; of a cylinder its axis"},
    {"normal_y", "", "likewise; all of them 0 of a sphere"},
    {"normal_z", "", "likewise"},
    {"radius", "m", "of the inside of a cylinder or sphere; 0 of a flat plane"},
    {"pressing", "N", "how hard bodies press against its normal, on a container all around"},
}};

}  // namespace

std::span<const dynamics::OutputField> plane_fields() {
  return kPlaneFields;
}

PlanePlaces::PlanePlaces(const std::filesystem::path& folder, const Scenario& scenario,
                         const WrittenFiles* before) {
  const std::vector<std::string> names = plane_names(scenario);
  columns_ = names.size();
  places_ = plane_numbers(scenario);
  HistoryColumns columns;
  for (const std::string& name : names) columns.add(name, kPlaneFields);
  open(folder, kPlanesFile, columns, before);
}

void PlanePlaces::add(const dynamics::Simulation& simulation) {
  if (!is_open()) return;
  constexpr double kNotThere = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> row(1 + kPlaneFields.size() * columns_, kNotThere);
  row[0] = simulation.time();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const contact::Plane& plane = simulation.planes()[i];
    double* const at = &row[1 + kPlaneFields.size() * places_[i]];
    std::copy_n(plane.point.data(), 3, at);
    std::copy_n(plane.direction().data(), 3, at + 3);
    at[6] = plane.radius;
    at[7] = simulation.pressing_on(i);
  }
  add_row(row);
}

}  // namespace plekton::apps
