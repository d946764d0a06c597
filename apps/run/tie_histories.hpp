// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/written_files.hpp"
#include "apps/scene/build_scene.hpp"
#include "dynamics/output/csv_writer.hpp"
#include "dynamics/output/output_field.hpp"
#include "dynamics/simulation.hpp"

#include <filesystem>
#include <span>
#include <vector>

namespace plekton::apps {

/// What ties.csv has of every table of ties, behind its name and a dot.
std::span<const dynamics::OutputField> tie_fields();
/// What it has of each tie of a table with `each`, behind its name, its number and a dot.
std::span<const dynamics::OutputField> single_tie_fields();

/// Writes ties.csv, if there are ties.
class TieHistories {
 public:
  /// Removes the file of an earlier run, unless that goes on. @throws dynamics::OutputError
  TieHistories(const std::filesystem::path& folder, const BuiltScene& built,
               const WrittenFiles* before = nullptr);

  /// Appends a row; rows reach the file in blocks, at flush() and at close(). @throws
  /// dynamics::OutputError
  void add(const dynamics::Simulation& simulation);
  void flush();
  void close();
  /// After a flush.
  void tell(WrittenFiles& written) const;

 private:
  std::vector<BuiltTies> tables_;
  std::unique_ptr<dynamics::CsvWriter> writer_;
};

}  // namespace plekton::apps
