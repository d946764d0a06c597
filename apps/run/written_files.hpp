// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/output/csv_writer.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace plekton::apps {

// The histories of a run.
inline constexpr const char* kHistoryFile = "energy.csv";
inline constexpr const char* kReactionsFile = "reactions.csv";
inline constexpr const char* kPressuresFile = "pressures.csv";
inline constexpr const char* kRigidBodiesFile = "rigid_bodies.csv";
inline constexpr const char* kTiesFile = "ties.csv";
inline constexpr const char* kPlanesFile = "planes.csv";
inline constexpr const char* kMeasuresFolder = "measures";  ///< a file for each
inline constexpr const char* kContactsFile = "contacts.csv";

/// What a run has written at a moment: where it goes on from a checkpoint.
struct WrittenFiles {
  std::map<std::string, std::uint64_t> sizes;  ///< bytes, of histories by their names
  std::vector<double> frames;                  ///< s, the time of each
};

/// Begins a history file, or goes on with it where it was then.
/// @param before  nothing: it begins
/// @throws dynamics::OutputError
inline std::unique_ptr<dynamics::CsvWriter> history_file(
    const std::filesystem::path& folder, const std::string& name,
    std::span<const dynamics::CsvColumn> columns, const WrittenFiles* before) {
  using dynamics::CsvWriter;
  constexpr auto kFlush = CsvWriter::Flush::on_request;
  if (before != nullptr) {
    if (const auto kept = before->sizes.find(name); kept != before->sizes.end())
      return std::make_unique<CsvWriter>(folder / name, columns, kFlush, kept->second);
  }
  return std::make_unique<CsvWriter>(folder / name, columns, kFlush);
}

}  // namespace plekton::apps
