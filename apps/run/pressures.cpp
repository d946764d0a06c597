// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/pressures.hpp"

#include <array>
#include <string>
#include <system_error>
#include <variant>

namespace plekton::apps {
namespace {

constexpr std::array<dynamics::OutputField, 2> kFields = {{
    {"pressure", "Pa", "over that outside, at the time of the forces"},
    {"volume", "m3", "that the membrane holds then; only where the pressure follows it"},
}};

dynamics::CsvColumn column_of(const std::string& load, const dynamics::OutputField& field) {
  return {load + "." + std::string(field.name), std::string(field.unit)};
}

}  // namespace

std::span<const dynamics::OutputField> pressure_fields() {
  return kFields;
}

Pressures::Pressures(const std::filesystem::path& folder, const Scenario& scenario,
                     const WrittenFiles* before) {
  std::error_code ignored;
  if (before == nullptr) std::filesystem::remove(folder / kPressuresFile, ignored);
  std::vector<dynamics::CsvColumn> columns{{"time", "s"}};
  for (const LoadSettings& load : scenario.loads) {
    const auto* const pressure = std::get_if<PressureSettings>(&load.load);
    if (pressure == nullptr) continue;
    has_volume_.push_back(pressure->load.gas || pressure->load.by_volume);
    columns.push_back(column_of(load.name, kFields[0]));
    if (has_volume_.back()) columns.push_back(column_of(load.name, kFields[1]));
  }
  if (!has_volume_.empty()) writer_ = history_file(folder, kPressuresFile, columns, before);
}

void Pressures::add(const dynamics::Simulation& simulation) {
  if (!writer_) return;
  std::vector<double> row{simulation.time()};
  for (std::size_t i = 0; i < has_volume_.size(); ++i) {
    const dynamics::PressedSurface& surface = simulation.loads().pressed_surfaces()[i];
    row.push_back(surface.pressure());
    if (has_volume_[i]) row.push_back(surface.volume());
  }
  writer_->add(row);
}

void Pressures::flush() {
  if (writer_) writer_->flush();
}

void Pressures::close() {
  if (writer_) writer_->close();
}

void Pressures::tell(WrittenFiles& written) const {
  if (writer_) written.sizes[kPressuresFile] = writer_->size();
}

}  // namespace plekton::apps
