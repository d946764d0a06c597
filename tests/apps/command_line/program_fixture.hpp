// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/command_line/command_line.hpp"
#include "tests/support/temporary_folder.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

namespace plekton::apps {

/// How a run of the program ended.
struct Outcome {
  int exit_code = -1;  ///< -1 if a signal ended it
  std::string out;
  std::string err;
};

/// The program in a process of its own, without an executable: a fork of the test that calls it.
class Program {
 public:
  /// @param prepare  Called in the new process before the program.
  explicit Program(
      std::vector<std::string> arguments, const std::function<void()>& prepare = [] {}) {
    std::cout.flush();
    process_ = ::fork();
    if (process_ != 0) return;
    redirect(STDOUT_FILENO, folder_ / "out");
    redirect(STDERR_FILENO, folder_ / "err");
    // A job that a shell runs in the background ignores the one, and what nohup starts the other.
    for (const int signal : {SIGINT, SIGHUP}) std::signal(signal, SIG_DFL);
    prepare();
    arguments.insert(arguments.begin(), "plekton");
    std::vector<const char*> argv;
    for (const std::string& argument : arguments) argv.push_back(argument.c_str());
    const int code = run_program(static_cast<int>(argv.size()), argv.data());
    std::cout.flush();
    ::_exit(code);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void send(int signal) const { ::kill(process_, signal); }

  /// Waits until a file is there, a minute at most.
  static bool appears(const std::filesystem::path& file) {
    for (int i = 0; i < 6000; ++i) {
      if (std::filesystem::exists(file)) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  Outcome wait() {
    int status = 0;
    ::waitpid(process_, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, test::bytes_of(folder_ / "out"),
            test::bytes_of(folder_ / "err")};
  }

 private:
  static void redirect(int descriptor, const std::filesystem::path& file) {
    const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(opened, descriptor);
    ::close(opened);
  }

  test::TemporaryFolder folder_;
  ::pid_t process_;
};

/// Runs the program to its end.
inline Outcome outcome_of(
    std::vector<std::string> arguments, const std::function<void()>& prepare = [] {}) {
  return Program(std::move(arguments), prepare).wait();
}

}  // namespace plekton::apps
