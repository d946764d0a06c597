// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/viewer/live_run.hpp"

#include "apps/viewer/page.hpp"
#include "apps/viewer/view_error.hpp"

#include <fmt/format.h>

#include <chrono>
#include <system_error>

namespace plekton::apps {
namespace {

/// ms of the clock, far below what a page can count exactly.
std::size_t now_in_milliseconds() {
  using std::chrono::milliseconds;
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::size_t>(std::chrono::duration_cast<milliseconds>(now).count());
}

/// When a file of the first frame was written; of no frame, or where none can be looked at, never.
std::filesystem::file_time_type first_written(const RunFolder& run) {
  std::error_code ignored;
  if (!run.frames.empty())
    for (const std::filesystem::path& file : run.frames.front().of)
      if (!file.empty()) return std::filesystem::last_write_time(file, ignored);
  return {};
}

}  // namespace

LiveRun::LiveRun(std::filesystem::path folder, std::size_t limit)
    : folder_(std::move(folder)),
      limit_(limit),
      run_(open_run_folder(folder_)),
      generation_(now_in_milliseconds()) {}

void LiveRun::refresh() {
  std::string problem;
  try {
    run_ = open_run_folder(folder_);
    read_new();
  } catch (const ViewError& error) {
    problem = error.what();
  }
  if (problem != problem_) ++version_;
  problem_ = std::move(problem);
}

void LiveRun::read_new() {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(1);
  // Another run into the same folder begins from the first frame again.
  const std::filesystem::file_time_type first = first_written(run_);
  if (run_.frames.size() < told_frames_ || (told_frames_ > 0 && first != told_first_)) {
    packed_ = {};
    told_ = {};
    step_ = 1;
    next_ = 0;
    ++generation_;
    ++version_;
  }
  told_frames_ = run_.frames.size();
  told_first_ = first;
  while (next_ < run_.frames.size()) {
    packed_.add(run_.frames[next_], planes_at(run_, run_.frames[next_].time));
    next_ += step_;
    ++version_;
    if (packed_.size() > limit_ && packed_.frames() > 2) leave_out_every_second();
    if (Clock::now() > end) return;
  }
  const auto histories = read_histories(folder_);
  std::size_t rows = 0;
  for (const RecordedHistory& history : histories) rows += history.rows();
  if (const std::pair told{rows, run_.report.has_value()}; told != told_) {
    packed_.set_histories(histories);
    told_ = told;
    ++version_;
  }
}

/// From the files: blocks name each other's arrays, so none can be taken out.
void LiveRun::leave_out_every_second() {
  step_ *= 2;
  next_ = 0;
  packed_ = {};
  told_ = {};
  ++generation_;
}

std::string LiveRun::header() const {
  std::vector<std::string> notes;
  if (step_ > 1)
    notes.push_back(
        fmt::format("{} frame is shown: all would be more than the limit of "
                    "{:g} MB (--limit)",
                    every(step_), 1e-6 * static_cast<double>(limit_)));
  if (!problem_.empty()) notes.push_back(problem_);
  auto header = packed_.header(run_, notes);
  header["generation"] = generation_;
  header["version"] = version_;
  return header.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::optional<std::string> LiveRun::block(std::string_view generation,
                                          std::string_view name) const {
  if (generation != std::to_string(generation_)) return std::nullopt;
  for (const auto& [own, text] : packed_.blocks())
    if (own == name) return text;
  return std::nullopt;
}

}  // namespace plekton::apps
