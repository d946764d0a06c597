// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/history_file.hpp"
#include "apps/scenario/scenario.hpp"
#include "dynamics/simulation.hpp"

#include <filesystem>
#include <span>
#include <vector>

namespace plekton::apps {

/// What planes.csv has of every plane, behind its name (or "planes[0]" without one) and a dot.
std::span<const dynamics::OutputField> plane_fields();

/// Writes planes.csv, if there are planes: where they are at the time of every frame, and how hard
/// bodies press on them.
class PlanePlaces : public HistoryFile {
 public:
  /// @throws dynamics::OutputError
  PlanePlaces(const std::filesystem::path& folder, const Scenario& scenario,
              const WrittenFiles* before = nullptr);

  /// Appends a row. @throws dynamics::OutputError
  void add(const dynamics::Simulation& simulation);

 private:
  std::vector<std::size_t> places_;  // by plane, among the columns
  std::size_t columns_ = 0;          // planes
};

}  // namespace plekton::apps
