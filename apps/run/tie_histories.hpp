// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/history_file.hpp"
#include "apps/scene/build_scene.hpp"
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
class TieHistories : public HistoryFile {
 public:
  /// @throws dynamics::OutputError
  TieHistories(const std::filesystem::path& folder, const BuiltScene& built,
               const WrittenFiles* before = nullptr);

  /// Appends a row. @throws dynamics::OutputError
  void add(const dynamics::Simulation& simulation);

 private:
  std::vector<BuiltTies> tables_;
};

}  // namespace plekton::apps
