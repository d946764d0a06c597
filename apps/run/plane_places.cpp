// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/plane_places.hpp"

#include "apps/scenario/staged_scenario.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <system_error>
#include <vector>

namespace plekton::apps {
namespace {

constexpr std::array<dynamics::OutputField, 6> kFields = {{
    {"point_x", "m", "of a point of the plane, which moves with it"},
    {"point_y", "m", "likewise"},
    {"point_z", "m", "likewise"},
    {"normal_x", "", "of the unit normal into the space of the bodies"},
    {"normal_y", "", "likewise"},
    {"normal_z", "", "likewise"},
}};

}  // namespace

std::span<const dynamics::OutputField> plane_fields() {
  return kFields;
}

PlanePlaces::PlanePlaces(const std::filesystem::path& folder, const Scenario& scenario,
                         const WrittenFiles* before) {
  std::error_code ignored;
  if (before == nullptr) std::filesystem::remove(folder / kPlanesFile, ignored);
  const std::vector<std::string> names = plane_names(scenario);
  columns_ = names.size();
  places_ = plane_numbers(scenario);
  if (names.empty()) return;
  std::vector<dynamics::CsvColumn> columns{{"time", "s"}};
  for (const std::string& name : names) {
    for (const dynamics::OutputField& field : kFields)
      columns.push_back({name + "." + std::string(field.name), std::string(field.unit)});
  }
  writer_ = history_file(folder, kPlanesFile, columns, before);
}

void PlanePlaces::add(const dynamics::Simulation& simulation) {
  if (!writer_) return;
  constexpr double kNotThere = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> row(1 + kFields.size() * columns_, kNotThere);
  row[0] = simulation.time();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const contact::Plane& plane = simulation.planes()[i];
    double* const at = &row[1 + kFields.size() * places_[i]];
    std::copy_n(plane.point.data(), 3, at);
    std::copy_n(plane.normal.data(), 3, at + 3);
  }
  writer_->add(row);
}

void PlanePlaces::flush() {
  if (writer_) writer_->flush();
}

void PlanePlaces::close() {
  if (writer_) writer_->close();
}

void PlanePlaces::tell(WrittenFiles& written) const {
  if (writer_) written.sizes[kPlanesFile] = writer_->size();
}

}  // namespace plekton::apps
