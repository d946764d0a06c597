// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/frames.hpp"
#include "apps/run/history_file.hpp"
#include "apps/run/lost_grains.hpp"

#include <span>

namespace plekton::apps {

/// How many bonds have broken so far. Linear in the number of bonds.
std::size_t broken_bonds(const dynamics::Simulation& simulation);

/// How many facets of sheets have torn so far. Linear in their number.
std::size_t torn_facets(const dynamics::Simulation& simulation);

/// The columns of energy.csv.
std::span<const dynamics::OutputField> history_fields();

/// Writes energy.csv: time, the energies and their closure error, contacts, overlap, lost grains.
class History : public HistoryFile {
 public:
  /// @param before  what the run has written so far, if it goes on
  /// @throws dynamics::OutputError
  explicit History(const std::filesystem::path& folder, const WrittenFiles* before = nullptr);

  /// Appends a row. @throws dynamics::OutputError
  void add(const dynamics::Simulation& simulation, const dynamics::Energy& energy,
           const LostGrains& lost);
};

}  // namespace plekton::apps
