// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/viewer/packed_run.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace plekton::apps {

/// A run as it goes into a page.
struct PageData {
  PackedRun packed;
  std::vector<std::string> notes;  ///< what is to be known about it, for people
};

/// Reads and packs a run. Where all frames would be more than a limit, only every second is taken,
/// or every third, and so on, and the last one; a note says so.
/// @param limit  bytes of all blocks
/// @throws ViewError also for a run without frames
PageData pack_run(const RunFolder& run, std::size_t limit);

/// Which of many are shown: "every second" of a step of 2, "every 5th".
std::string every(std::size_t step);

/// The page of a run that ended or was stopped: one file that needs no other and no network.
/// @returns its size in bytes
/// @throws dynamics::OutputError; InputError for a file that is there and is no such page
std::size_t write_page(const std::filesystem::path& file, const RunFolder& run,
                       const PageData& data);

/// The page that asks its server for the run (server.hpp).
std::string live_page();

}  // namespace plekton::apps
