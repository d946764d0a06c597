// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/written_files.hpp"
#include "apps/scenario/scenario.hpp"
#include "dynamics/output/csv_writer.hpp"
#include "dynamics/output/output_field.hpp"
#include "dynamics/simulation.hpp"

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace plekton::apps {

/// What planes.csv has of every plane, behind its name (or "planes[0]" without one) and a dot.
std::span<const dynamics::OutputField> plane_fields();

/// Writes planes.csv, if there are planes: where they are at the time of every frame.
class PlanePlaces {
 public:
  /// Removes the file of an earlier run, unless that goes on. @throws dynamics::OutputError
  PlanePlaces(const std::filesystem::path& folder, const Scenario& scenario,
              const WrittenFiles* before = nullptr);

  /// Appends a row; rows reach the file in blocks, at flush() and at close(). @throws
  /// dynamics::OutputError
  void add(const dynamics::Simulation& simulation);
  void flush();
  void close();
  /// After a flush.
  void tell(WrittenFiles& written) const;

 private:
  std::unique_ptr<dynamics::CsvWriter> writer_;
  std::vector<std::size_t> places_;  // by plane, among the columns
  std::size_t columns_ = 0;          // planes
};

}  // namespace plekton::apps
