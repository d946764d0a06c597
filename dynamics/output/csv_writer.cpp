// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/csv_writer.hpp"

#include "dynamics/output/text.hpp"

#include <fstream>
#include <stdexcept>
#include <system_error>

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

/// @param head  first row of the file that is asked for
/// @throws OutputError if the file has other columns or ends before what is kept of it
void require_goes_on(const std::filesystem::path& file, const std::string& head,
                     std::uint64_t kept) {
  std::string row;
  std::getline(std::ifstream(file, std::ios::binary), row);
  row += '\n';
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error || size < kept || kept < row.size())
    throw OutputError(file,
                      "is not the file that the run has written so far; put it back, or go on in "
                      "another folder");
  if (row != head)
    throw OutputError(file,
                      "has other columns than the run writes now, as where a reaction or a measure "
                      "is another; ask for the same ones, or go on in another folder");
}

}  // namespace

CsvWriter::CsvWriter(const std::filesystem::path& file, std::span<const CsvColumn> columns,
                     Flush flush)
    : column_count_(columns.size()), flush_(flush) {
  const std::string row = head_row(columns);
  OutputFile head(file);
  head.write(row);
  head.commit();
  size_ = row.size();
  file_.emplace(file, CheckedFile::Mode::append);
}

CsvWriter::CsvWriter(const std::filesystem::path& file, std::span<const CsvColumn> columns,
                     Flush flush, std::uint64_t kept)
    : column_count_(columns.size()), flush_(flush), size_(kept) {
  require_goes_on(file, head_row(columns), kept);
  cut_back(file, kept);
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
  if (!file_) throw std::logic_error("CsvWriter: a row after close()");
  if (row.size() != column_count_)
    throw std::logic_error("CsvWriter: a row of " + std::to_string(row.size()) +
                           " numbers; there are " + std::to_string(column_count_) + " columns");
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
  size_ += gathered_.size();
  gathered_.clear();
}

void CsvWriter::close() {
  if (!file_) return;
  flush();
  file_->close();
  file_.reset();
}

}  // namespace plekton::dynamics
