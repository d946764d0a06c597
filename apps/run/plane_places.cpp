// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/plane_places.hpp"

#include <fmt/format.h>

#include <array>
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
  if (scenario.planes.empty()) return;
  std::vector<dynamics::CsvColumn> columns{{"time", "s"}};
  for (std::size_t i = 0; i < scenario.planes.size(); ++i) {
    const std::string& own = scenario.planes[i].name;
    const std::string name = own.empty() ? fmt::format("planes[{}]", i) : own;
    for (const dynamics::OutputField& field : kFields)
      columns.push_back({name + "." + std::string(field.name), std::string(field.unit)});
  }
  writer_ = history_file(folder, kPlanesFile, columns, before);
}

void PlanePlaces::add(const dynamics::Simulation& simulation) {
  if (!writer_) return;
  std::vector<double> row{simulation.time()};
  for (const contact::Plane& plane : simulation.planes()) {
    row.insert(row.end(), plane.point.data(), plane.point.data() + 3);
    row.insert(row.end(), plane.normal.data(), plane.normal.data() + 3);
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
