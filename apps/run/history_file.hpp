// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/written_files.hpp"
#include "dynamics/output/csv_writer.hpp"
#include "dynamics/output/output_field.hpp"

#include <filesystem>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace plekton::apps {

/// The columns of a history: the time first, then fields of bodies, behind their names and a dot.
class HistoryColumns {
 public:
  void add(const std::string& name, const dynamics::OutputField& field);
  void add(const std::string& name, std::span<const dynamics::OutputField> fields);
  /// Of vectors: _x, _y and _z of each.
  void add_vectors(const std::string& name, std::span<const dynamics::OutputField> fields);

  std::span<const dynamics::CsvColumn> all() const noexcept { return columns_; }
  /// Whether there is nothing but the time.
  bool empty() const noexcept { return columns_.size() == 1; }

 private:
  std::vector<dynamics::CsvColumn> columns_{{"time", "s"}};
};

/// A CSV file of a run to which rows are added while it goes on, or none.
class HistoryFile {
 public:
  HistoryFile() = default;

  /// Begins the file, or goes on with it where it was then.
  /// @param before  what the run has written so far; nothing: it begins, and what an earlier run has
  ///                left of that name is removed
  /// @throws dynamics::OutputError
  void open(const std::filesystem::path& folder, const std::string& name,
            std::span<const dynamics::CsvColumn> columns, const WrittenFiles* before);
  /// The same; no file if there is nothing but the time.
  void open(const std::filesystem::path& folder, const std::string& name,
            const HistoryColumns& columns, const WrittenFiles* before);
  bool is_open() const noexcept { return writer_ != nullptr; }

  /// Appends a row; rows reach the file in blocks, at flush() and at close().
  /// @throws dynamics::OutputError
  void add_row(std::span<const double> row) { writer_->add(row); }
  void add_row(std::initializer_list<double> row) { writer_->add(row); }
  /// Nothing without a file, as the next two. @throws dynamics::OutputError
  void flush();
  /// @throws dynamics::OutputError
  void close();
  /// After a flush.
  void tell(WrittenFiles& written) const;

 private:
  std::string name_;
  std::unique_ptr<dynamics::CsvWriter> writer_;
};

}  // namespace plekton::apps
