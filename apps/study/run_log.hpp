// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/programs/child_process.hpp"

#include <filesystem>
#include <string>

namespace plekton::apps {

/// The file that takes what a run says, and keeps the run for one process: whoever has it open and
/// locked, and the run that writes to it. The lock ends with the last of both, however they end.
/// File systems without locks are not guarded.
class RunLog {
 public:
  /// @throws dynamics::OutputError
  explicit RunLog(std::filesystem::path file);
  RunLog(const RunLog&) = delete;
  RunLog& operator=(const RunLog&) = delete;
  ~RunLog();

  /// Whether nobody else has it.
  bool is_ours() const noexcept { return is_ours_; }
  int descriptor() const noexcept { return descriptor_; }
  void clear() const;
  /// What it says was wrong, in a line; or how the run ended.
  std::string reason(const ProgramEnd& end) const;
  /// Adds what was wrong, if it says nothing of it, for those who read it later.
  void record(const std::string& problem) const;

 private:
  std::filesystem::path file_;
  int descriptor_;
  bool is_ours_ = false;
};

/// What a run that has ended says was wrong; empty if there is no log, or nothing of it in there:
/// the run was never begun, was interrupted, or goes on.
std::string problem_in_log(const std::filesystem::path& file);

}  // namespace plekton::apps
