// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/study/run_log.hpp"

#include "dynamics/output/file.hpp"
#include "geometry/base/regular_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <sstream>
#include <string_view>
#include <utility>

namespace plekton::apps {
namespace {

constexpr std::string_view kProgram = "plekton: ";

/// The first problem that `plekton run` has printed; empty if there is none.
std::string problem_in(const std::string& log) {
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(kProgram) || line.starts_with("plekton: warning: ")) continue;
    std::string problem = line.substr(kProgram.size());
    // "2 problems", and then these.
    if (problem.ends_with(" problems")) std::getline(lines, problem);
    return problem;
  }
  return "";
}

}  // namespace

RunLog::RunLog(std::filesystem::path file)
    : file_(std::move(file)),
      descriptor_(
          ::open(file_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0666)) {
  if (descriptor_ < 0) throw dynamics::OutputError(file_, "open", errno);
  is_ours_ = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

RunLog::~RunLog() {
  ::close(descriptor_);
}

void RunLog::clear() const {
  std::ignore = ::ftruncate(descriptor_, 0);
}

std::string RunLog::reason(const ProgramEnd& end) const {
  const std::string problem = problem_in_log(file_);
  if (!problem.empty()) return problem;
  return fmt::format("ended with {}; see {}", text_of(end), file_.string());
}

void RunLog::record(const std::string& problem) const {
  if (!problem_in_log(file_).empty()) return;
  const std::string line = fmt::format("{}{}\n", kProgram, problem);
  std::ignore = ::write(descriptor_, line.data(), line.size());
}

std::string problem_in_log(const std::filesystem::path& file) {
  try {
    return problem_in(geometry::read_regular_file(file, "a log"));
  } catch (const geometry::UnreadableFile&) {
    return "";
  }
}

}  // namespace plekton::apps
