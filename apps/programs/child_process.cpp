// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/programs/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <tuple>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

constexpr int kNoProgram = 127;  // as a shell says it

/// What mpirun and srun tell the processes that they start of each other, by how its names begin.
constexpr std::array<std::string_view, 8> kOfRanks = {"OMPI_", "PMIX_",  "PMI_",  "PMI2_",
                                                      "PRTE_", "HYDRA_", "HYDI_", "MPI_LOCAL"};

/// Of this program, but that a program which it starts is no rank of a job that this one is of: it
/// would wait for the others, who know nothing of it.
std::vector<char*> environment_for_child() {
  std::vector<char*> kept;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable;
    if (std::ranges::none_of(kOfRanks,
                             [&](std::string_view name) { return text.starts_with(name); }))
      kept.push_back(*variable);
  }
  kept.push_back(nullptr);
  return kept;
}

/// The new process becomes the program. Between fork and exec only what is safe there is called.
[[noreturn]] void become(char* const* argv, char* const* environment, int output, ::pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(kNoProgram);  // the parent has ended before the line above
  std::signal(SIGPIPE, SIG_DFL);
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  ::execve(argv[0], argv, environment);
  const char* const reason = std::strerror(errno);
  std::ignore = ::write(STDERR_FILENO, argv[0], std::strlen(argv[0]));
  std::ignore = ::write(STDERR_FILENO, ": ", 2);
  std::ignore = ::write(STDERR_FILENO, reason, std::strlen(reason));
  std::ignore = ::write(STDERR_FILENO, "\n", 1);
  ::_exit(kNoProgram);
}

}  // namespace

std::optional<fs::path> find_program(std::string_view name) {
  const char* const path = std::getenv("PATH");
  std::string_view rest = path == nullptr ? "" : path;
  while (!rest.empty()) {
    const std::size_t colon = rest.find(':');
    const fs::path candidate = fs::path(rest.substr(0, colon)) / name;
    rest = colon == std::string_view::npos ? "" : rest.substr(colon + 1);
    std::error_code ignored;
    // A relative folder in PATH would be another one after a change of folder.
    if (candidate.is_absolute() && fs::is_regular_file(candidate, ignored) &&
        ::access(candidate.c_str(), X_OK) == 0)
      return candidate;
  }
  return std::nullopt;
}

std::string text_of(const ProgramEnd& end) {
  return end.signal != 0 ? fmt::format("signal {}", end.signal)
                         : fmt::format("exit code {}", end.exit_code);
}

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, int output) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const std::vector<char*> environment = environment_for_child();
  const ::pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ < 0)
    throw std::system_error(errno, std::generic_category(), "cannot start " + arguments.front());
  if (process_ == 0) become(argv.data(), environment.data(), output, parent);
  // Here too: whichever of both processes comes first, the group is there for interrupt().
  ::setpgid(process_, process_);
}

ChildProcess::~ChildProcess() {
  if (end_) return;
  ::kill(process_, SIGKILL);
  wait();
}

std::optional<ProgramEnd> ChildProcess::look(int options) {
  if (end_) return end_;
  int status = 0;
  ::pid_t ended = -1;
  do {
    ended = ::waitpid(process_, &status, options);
  } while (ended < 0 && errno == EINTR);
  if (ended == 0) return std::nullopt;
  end_ = ended == process_ && WIFEXITED(status)
             ? ProgramEnd{WEXITSTATUS(status), 0}
             : ProgramEnd{-1, WIFSIGNALED(status) ? WTERMSIG(status) : SIGKILL};
  return end_;
}

std::optional<ProgramEnd> ChildProcess::poll() {
  return look(WNOHANG);
}

ProgramEnd ChildProcess::wait() {
  return *look(0);
}

void ChildProcess::interrupt() const {
  if (!end_) ::kill(process_, SIGTERM);
}

}  // namespace plekton::apps
