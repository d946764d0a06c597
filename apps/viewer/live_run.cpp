// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/viewer/live_run.hpp"

#include "apps/viewer/view_error.hpp"

#include <fmt/format.h>

#include <chrono>

namespace plekton::apps {

LiveRun::LiveRun(std::filesystem::path folder, std::size_t limit)
    : folder_(std::move(folder)), limit_(limit), run_(open_run_folder(folder_)) {}

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
  if (run_.frames.size() < told_frames_) {
    packed_ = {};
    told_ = {};
    step_ = 1;
    next_ = 0;
    ++generation_;
    ++version_;
  }
  told_frames_ = run_.frames.size();
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
        fmt::format("every {}th frame is shown: all would be more than the limit of "
                    "{:g} MB (--limit)",
                    step_, 1e-6 * static_cast<double>(limit_)));
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
