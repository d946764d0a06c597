// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/viewer/packed_run.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plekton::apps {

/// A run that may still go on, packed as far as it is.
class LiveRun {
 public:
  /// @param limit  bytes of all blocks; beyond it every second frame of those so far is left out
  /// @throws ViewError for what is no folder of a run
  LiveRun(std::filesystem::path folder, std::size_t limit);

  /// Reads what is new, for a second at most, and a frame at least: call it again for more.
  /// What cannot be read is told in the header, and tried again the next time.
  void refresh();

  /// The header of packed_run.hpp with "version", which changes with everything that does, and
  /// "generation", which changes where frames were left out, so that blocks have other names.
  std::string header() const;

  /// Text of a block; nothing if there is none of that name in that generation.
  std::optional<std::string> block(std::string_view generation, std::string_view name) const;

 private:
  void read_new();
  void leave_out_every_second();

  std::filesystem::path folder_;
  std::size_t limit_;
  RunFolder run_;
  PackedRun packed_;
  std::string problem_;  ///< with what was read last
  std::size_t step_ = 1;
  std::size_t next_ = 0;                          ///< frame of the run
  std::size_t told_frames_ = 0;                   ///< of the run, when it was read last
  std::filesystem::file_time_type told_first_{};  ///< when the first of these was written
  std::size_t generation_;  ///< begins elsewhere in every server: pages outlive them
  std::size_t version_ = 0;
  std::pair<std::size_t, bool> told_{0, false};  ///< rows of histories, and whether it has ended
};

}  // namespace plekton::apps
