// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/programs/child_process.hpp"

#include "apps/programs/shell_word.hpp"
#include "tests/support/temporary_folder.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <thread>

namespace plekton::apps::child_process_test {
namespace {

class Child : public testing::Test {
 protected:
  Child() : file_(::open((folder_ / "said").c_str(), O_RDWR | O_CREAT, 0600)) {}
  ~Child() override { ::close(file_); }
  std::string said() const { return test::bytes_of(folder_ / "said"); }

  test::TemporaryFolder folder_;
  int file_;
};

TEST_F(Child, GetsItsArgumentsAsTheyAre) {
  ChildProcess child({"/bin/echo", "$(id)", "a b", "; rm x"}, file_);

  EXPECT_EQ(child.wait().exit_code, 0);
  EXPECT_EQ(said(), "$(id) a b ; rm x\n");
}

TEST_F(Child, TellsHowItEnded) {
  ChildProcess child({"/bin/sh", "-c", "exit 3"}, file_);
  EXPECT_EQ(text_of(child.wait()), "exit code 3");
  ChildProcess killed({"/bin/sh", "-c", "kill -9 $$"}, file_);
  EXPECT_EQ(text_of(killed.wait()), "signal 9");
  ChildProcess none({"/no/such/program"}, file_);
  EXPECT_EQ(none.wait().exit_code, 127);
  EXPECT_NE(said().find("/no/such/program: No such file"), std::string::npos);
}

TEST_F(Child, EndsWhenItIsAskedToOrWhenNobodyWaitsForItAnyMore) {
  ChildProcess child({"/bin/sleep", "100"}, file_);
  EXPECT_FALSE(child.poll());
  child.interrupt();
  EXPECT_EQ(child.wait().signal, SIGTERM);
  const auto began = std::chrono::steady_clock::now();
  { const ChildProcess forgotten({"/bin/sleep", "100"}, file_); }
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(50));
}

TEST_F(Child, IsNoRankOfTheJobThatThisProgramIsOf) {
  constexpr std::array kOfRanks = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK",
                                   "MPI_LOCALNRANKS"};
  for (const char* const name : kOfRanks) ::setenv(name, "2", 1);
  ::setenv("PLEKTON_TEST_KEPT", "2", 1);
  ChildProcess child({"/usr/bin/env"}, file_);
  for (const char* const name : kOfRanks) ::unsetenv(name);
  ::unsetenv("PLEKTON_TEST_KEPT");

  EXPECT_EQ(child.wait().exit_code, 0);
  EXPECT_NE(said().find("PLEKTON_TEST_KEPT=2\n"), std::string::npos);
  for (const char* const name : kOfRanks) EXPECT_EQ(said().find(name), std::string::npos) << name;
}

TEST(FindProgram, LooksThroughThePath) {
  EXPECT_TRUE(find_program("sh"));
  EXPECT_FALSE(find_program("no-such-program-of-plekton"));
}

TEST(ShellWord, IsInQuotesWhereItHasTo) {
  EXPECT_EQ(shell_word("a/b-1.toml"), "a/b-1.toml");
  EXPECT_EQ(shell_word("-a b"), "'./-a b'");
  EXPECT_EQ(shell_word("-"), "./-");
  EXPECT_EQ(shell_word("a b"), "'a b'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word(""), "''");
}

}  // namespace
}  // namespace plekton::apps::child_process_test
