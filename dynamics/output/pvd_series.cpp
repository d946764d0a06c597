// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/pvd_series.hpp"

#include "dynamics/output/file.hpp"
#include "dynamics/output/text.hpp"

#include <algorithm>
#include <system_error>

namespace plekton::dynamics {

void PvdSeries::add(const std::vector<SeriesEntry>& entries) {
  const std::size_t length_before = lines_.size();
  const std::size_t parts_before = parts_.size();
  try {
    for (const SeriesEntry& entry : entries) lines_ += line(entry);
    write();
  } catch (...) {
    lines_.resize(length_before);
    parts_.resize(parts_before);
    throw;
  }
}

std::string PvdSeries::line(const SeriesEntry& entry) {
  if (std::error_code ignored; !std::filesystem::is_regular_file(entry.file, ignored)) {
    throw OutputError(
        file_,
        "cannot list " + entry.file.string() +
            ": there is no such file; do not move or remove results while the simulation runs");
  }
  const auto normal = [](const std::filesystem::path& path) {
    return std::filesystem::absolute(path).lexically_normal();
  };
  const auto relative = normal(entry.file).lexically_relative(normal(file_).parent_path());
  std::string line = "    <DataSet timestep=\"";
  append_number(line, entry.time);
  line += "\" group=\"\" part=\"" + std::to_string(part_number(entry.part));
  line += "\" name=\"" + xml_escaped(entry.part);
  line += "\" file=\"" + xml_escaped(relative.generic_string());
  return line += "\"/>\n";
}

std::size_t PvdSeries::part_number(const std::string& name) {
  const auto found = std::find(parts_.begin(), parts_.end(), name);
  const auto number = static_cast<std::size_t>(found - parts_.begin());
  if (found == parts_.end()) parts_.push_back(name);
  return number;
}

void PvdSeries::write() const {
  OutputFile out(file_);
  out.write(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n  <Collection>\n");
  out.write(lines_);
  out.write("  </Collection>\n</VTKFile>\n");
  out.commit();
}

}  // namespace plekton::dynamics
