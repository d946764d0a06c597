// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/csv_writer.hpp"

#include "dynamics/output/text.hpp"

#include <cassert>

namespace plekton::dynamics {
namespace {

constexpr std::size_t kGatheredBytes = 64 * 1024;

/// Quoted after RFC 4180 if the text holds a separator.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted += '"';
}

std::string head_row(std::span<const CsvColumn> columns) {
  std::string row;
  for (const CsvColumn& column : columns) {
    if (!row.empty()) row += ',';
    row += csv_field(column.unit.empty() ? column.name : column.name + " (" + column.unit + ")");
  }
  return row += '\n';
}

}  // namespace

CsvWriter::CsvWriter(const std::filesystem::path& file, std::span<const CsvColumn> columns,
                     Flush flush)
    : column_count_(columns.size()), flush_(flush) {
  OutputFile head(file);
  head.write(head_row(columns));
  head.commit();
  file_.emplace(file, CheckedFile::Mode::append);
}

CsvWriter::~CsvWriter() {
  try {
    close();
  } catch (const OutputError&) {
    // A destructor has nobody to tell; close() does.
  }
}

void CsvWriter::add(std::span<const double> row) {
  assert(row.size() == column_count_ && "one number for each column");
  assert(file_ && "a row after close()");
  for (std::size_t column = 0; column < row.size(); ++column) {
    if (column > 0) gathered_ += ',';
    append_number(gathered_, row[column]);
  }
  gathered_ += '\n';
  if (flush_ == Flush::every_row || gathered_.size() >= kGatheredBytes) flush();
}

void CsvWriter::flush() {
  if (gathered_.empty()) return;
  file_->write(gathered_);
  gathered_.clear();
}

void CsvWriter::close() {
  if (!file_) return;
  flush();
  file_->close();
  file_.reset();
}

}  // namespace plekton::dynamics
