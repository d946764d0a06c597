// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/output/file.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plekton::dynamics {

/// One data set of a time series.
struct SeriesEntry {
  double time;                 ///< s
  std::string part;            ///< UTF-8; data sets of the same name follow each other in time
  std::filesystem::path file;  ///< complete; listed relative to the folder of the series
};

/// A `.pvd` file: the data sets of a time series, opened in ParaView as one. It is valid XML at any
/// moment, also in the middle of a write, while the simulation runs and after it was stopped, and
/// it names complete files only.
///
/// The file keeps room for the next entries: blanks before its closing tags, where added entries
/// are written in place (writes_in_place()). Where they do not fit the file is replaced as a whole,
/// with room for half as many entries more. So the bytes written are at most six for each of the
/// entries in the end, however many there are, and 4 kB.
class PvdSeries {
 public:
  /// Nothing is written before the first add().
  explicit PvdSeries(std::filesystem::path file) : file_(std::move(file)) {}

  /// Appends the data sets of one moment.
  /// @throws OutputError if a data set is not there or the series cannot be written; the series is
  /// then as before.
  void add(const std::vector<SeriesEntry>& entries);

  /// Goes on with a series of so many entries, each added by itself: the file is written anew, as
  /// it was after them. Before the first add(). @throws as add()
  void go_on(const std::vector<SeriesEntry>& entries);

 private:
  std::string line(const SeriesEntry& entry);
  std::size_t part_number(const std::string& name);
  bool is_as_left() const;
  void write_in_place(const std::string& added);
  void write_whole();
  void make_room() noexcept;

  std::filesystem::path file_;
  std::vector<std::string> parts_;  // the number of a part is its position
  std::string lines_;               // XML, one line for each entry
  std::size_t room_ = 0;            // bytes of blanks after them
};

/// Writes that put lines of XML tags into blanks between tags, such that the file is valid XML
/// after every single byte: first as text, without the characters that mean something; then these,
/// one at a time, from the last to the first, so that the one that makes a tag of a line is its
/// last.
/// @param lines     Each one empty-element tag, with references of its own only in attributes.
/// @param position  Of the first blank in the file.
std::vector<PlacedBytes> writes_in_place(std::string_view lines, std::size_t position);

}  // namespace plekton::dynamics
