// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/pvd_series.hpp"

#include "dynamics/output/text.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

namespace plekton::dynamics {

namespace {

constexpr std::string_view kHead =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n  <Collection>\n";
constexpr std::string_view kTail = "  </Collection>\n</VTKFile>\n";
constexpr std::size_t kLeastRoom = 4096;  // bytes, some forty entries
constexpr std::string_view kMarkup = "<&";

}  // namespace

void PvdSeries::add(const std::vector<SeriesEntry>& entries) {
  const std::size_t parts_before = parts_.size();
  const std::size_t lines_before = lines_.size();
  try {
    std::string added;
    for (const SeriesEntry& entry : entries) added += line(entry);
    if (added.size() <= room_ && is_as_left()) {
      write_in_place(added);
      lines_ += added;
    } else {
      lines_ += added;
      make_room();
      write_whole();
    }
  } catch (...) {
    parts_.resize(parts_before);
    lines_.resize(lines_before);
    throw;
  }
}

void PvdSeries::go_on(const std::vector<SeriesEntry>& entries) {
  for (const SeriesEntry& entry : entries) {
    const std::string added = line(entry);
    lines_ += added;
    if (added.size() <= room_)
      room_ -= added.size();
    else
      make_room();
  }
  write_whole();
}

std::string PvdSeries::line(const SeriesEntry& entry) {
  std::error_code ignored;
  if (!goes_nowhere(file_) && !std::filesystem::is_regular_file(entry.file, ignored)) {
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

/// Whether the file is there and as long as it was left; somebody may have moved it away.
bool PvdSeries::is_as_left() const {
  std::error_code error;
  const auto size = std::filesystem::file_size(file_, error);
  return !error && size == kHead.size() + lines_.size() + room_ + kTail.size();
}

void PvdSeries::write_in_place(const std::string& added) {
  // After an error the room is of unknown content, and the next add() replaces the file.
  const std::size_t room = std::exchange(room_, 0);
  overwrite(file_, writes_in_place(added, kHead.size() + lines_.size()));
  room_ = room - added.size();
}

void PvdSeries::make_room() noexcept {
  room_ = std::max(kLeastRoom, lines_.size() / 2);
}

void PvdSeries::write_whole() {
  OutputFile out(file_);
  out.write(kHead);
  out.write(lines_);
  out.write(std::string(room_, ' '));
  out.write(kTail);
  out.commit();
}

std::vector<PlacedBytes> writes_in_place(std::string_view lines, std::size_t position) {
  std::string text(lines);
  for (char& c : text)
    if (kMarkup.find(c) != std::string_view::npos) c = ' ';
  std::vector<PlacedBytes> writes = {{position, std::move(text)}};
  for (std::size_t i = lines.size(); i-- > 0;)
    if (kMarkup.find(lines[i]) != std::string_view::npos)
      writes.push_back({position + i, std::string(1, lines[i])});
  return writes;
}

}  // namespace plekton::dynamics
