// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/output/file.hpp"

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>

namespace plekton::dynamics {

/// Head of a column: "name (unit)".
struct CsvColumn {
  std::string name;
  std::string unit;  ///< empty for a number without unit
};

/// A history file: a head row, then a row of numbers for each moment, readable while it grows.
/// Numbers have the fewest digits that read back as the same double. A file of that name from
/// before is replaced. After an error the file ends with a whole row.
class CsvWriter {
 public:
  /// When rows reach the file: each at once, or gathered until flush() or 64 kB.
  enum class Flush : std::uint8_t { every_row, on_request };

  /// Writes the head row; if that fails there is no new file. @throws OutputError
  CsvWriter(const std::filesystem::path& file, std::span<const CsvColumn> columns,
            Flush flush = Flush::every_row);
  /// Goes on with a file of an earlier writer of the same columns: keeps so many bytes of it, which
  /// end a row, and cuts off what was written after these.
  /// @param kept  size() of that writer after a flush()
  /// @throws OutputError if the file is another one or shorter
  CsvWriter(const std::filesystem::path& file, std::span<const CsvColumn> columns, Flush flush,
            std::uint64_t kept);
  CsvWriter(const CsvWriter&) = delete;
  CsvWriter& operator=(const CsvWriter&) = delete;
  /// Writes the gathered rows without a check: call close() to hear of an error.
  ~CsvWriter();

  /// Appends a row, one number for each column.
  /// @throws OutputError if gathered rows cannot be written; they stay gathered, this one too, and
  /// flush() tries again. @throws std::logic_error for a row of another length, or after close().
  void add(std::span<const double> row);
  void add(std::initializer_list<double> row) { add(std::span(row.begin(), row.size())); }

  /// Bytes in the file: all rows that were flushed.
  std::uint64_t size() const noexcept { return size_; }

  /// Writes the gathered rows. @throws OutputError, and the rows stay gathered.
  void flush();

  /// Writes the gathered rows and closes the file; no rows after that. @throws OutputError
  void close();

 private:
  std::size_t column_count_;
  Flush flush_;
  std::optional<CheckedFile> file_;
  std::string gathered_;
  std::uint64_t size_ = 0;  ///< bytes in the file
};

}  // namespace plekton::dynamics
