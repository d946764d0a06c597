// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/history_file.hpp"
#include "apps/scenario/scenario.hpp"
#include "dynamics/simulation.hpp"

#include <filesystem>
#include <span>
#include <vector>

namespace plekton::apps {

/// What pressures.csv has of every load of kind pressure, behind its name and a dot.
std::span<const dynamics::OutputField> pressure_fields();

/// Writes pressures.csv, if there are loads of kind pressure.
class Pressures : public HistoryFile {
 public:
  /// @throws dynamics::OutputError
  Pressures(const std::filesystem::path& folder, const Scenario& scenario,
            const WrittenFiles* before = nullptr);

  /// Appends a row. @throws dynamics::OutputError
  void add(const dynamics::Simulation& simulation);

 private:
  std::vector<bool> has_volume_;      ///< by load of kind pressure, of all stages
  std::vector<bool> follows_volume_;  ///< likewise: whether it has a volume in this stage
  std::vector<std::size_t> loads_;    ///< likewise: its place among those of now
};

}  // namespace plekton::apps
