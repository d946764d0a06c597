// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/history_file.hpp"

#include <system_error>

namespace plekton::apps {

void HistoryColumns::add(const std::string& name, const dynamics::OutputField& field) {
  columns_.push_back({name + "." + std::string(field.name), std::string(field.unit)});
}

void HistoryColumns::add(const std::string& name, std::span<const dynamics::OutputField> fields) {
  for (const dynamics::OutputField& field : fields) add(name, field);
}

void HistoryColumns::add_vectors(const std::string& name,
                                 std::span<const dynamics::OutputField> fields) {
  for (const dynamics::OutputField& field : fields) {
    for (const char* axis : {"_x", "_y", "_z"})
      columns_.push_back({name + "." + std::string(field.name) + axis, std::string(field.unit)});
  }
}

void HistoryFile::open(const std::filesystem::path& folder, const std::string& name,
                       std::span<const dynamics::CsvColumn> columns, const WrittenFiles* before) {
  using dynamics::CsvWriter;
  constexpr auto kFlush = CsvWriter::Flush::on_request;
  name_ = name;
  if (before != nullptr) {
    if (const auto kept = before->sizes.find(name); kept != before->sizes.end()) {
      writer_ = std::make_unique<CsvWriter>(folder / name, columns, kFlush, kept->second);
      return;
    }
  }
  writer_ = std::make_unique<CsvWriter>(folder / name, columns, kFlush);
}

void HistoryFile::open(const std::filesystem::path& folder, const std::string& name,
                       const HistoryColumns& columns, const WrittenFiles* before) {
  std::error_code ignored;
  if (before == nullptr) std::filesystem::remove(folder / name, ignored);
  if (!columns.empty()) open(folder, name, columns.all(), before);
}

void HistoryFile::flush() {
  if (writer_) writer_->flush();
}

void HistoryFile::close() {
  if (writer_) writer_->close();
}

void HistoryFile::tell(WrittenFiles& written) const {
  if (writer_) written.sizes[name_] = writer_->size();
}

}  // namespace plekton::apps
