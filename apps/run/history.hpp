// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/frames.hpp"
#include "apps/run/lost_grains.hpp"
#include "apps/run/written_files.hpp"
#include "dynamics/output/csv_writer.hpp"
#include "dynamics/output/output_field.hpp"

#include <span>

namespace plekton::apps {

/// How many bonds have broken so far. Linear in the number of bonds.
std::size_t broken_bonds(const dynamics::Simulation& simulation);

/// How many facets of sheets have torn so far. Linear in their number.
std::size_t torn_facets(const dynamics::Simulation& simulation);

/// The columns of energy.csv.
std::span<const dynamics::OutputField> history_fields();

/// Writes energy.csv: time, the energies and their closure error, contacts, overlap, lost grains.
class History {
 public:
  /// @param before  what the run has written so far, if it goes on
  /// @throws dynamics::OutputError
  explicit History(const std::filesystem::path& folder, const WrittenFiles* before = nullptr);

  /// Appends a row; rows reach the file in blocks, at flush() and at close(). @throws
  /// dynamics::OutputError
  void add(const dynamics::Simulation& simulation, const dynamics::Energy& energy,
           const LostGrains& lost);
  void flush() { writer_->flush(); }
  void close() { writer_->close(); }
  /// After a flush.
  void tell(WrittenFiles& written) const { written.sizes[kHistoryFile] = writer_->size(); }

 private:
  std::unique_ptr<dynamics::CsvWriter> writer_;
};

}  // namespace plekton::apps
