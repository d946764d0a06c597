// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/study/run_log.hpp"

#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <csignal>

namespace plekton::apps::run_log_test {
namespace {

class RunLogFile : public testing::Test {
 protected:
  std::filesystem::path file() const { return folder_ / "a.log"; }

  test::TemporaryFolder folder_;
};

TEST_F(RunLogFile, KeepsHowARunEndedThatSaidNothingOfIt) {
  const RunLog log(file());
  const std::string reason = log.reason({-1, SIGKILL});

  EXPECT_EQ(problem_in_log(file()), "");
  log.record(reason);
  EXPECT_EQ(problem_in_log(file()), reason);
}

TEST_F(RunLogFile, KeepsTheProblemThatARunHasTold) {
  const RunLog log(file());
  test::write_bytes(file(), "plekton: warning: hot\nplekton: 2 problems\nfirst\nsecond\n");

  log.record("ended with exit code 1");

  EXPECT_EQ(problem_in_log(file()), "first");
  EXPECT_EQ(test::bytes_of(file()).find("ended"), std::string::npos);
}

TEST_F(RunLogFile, HasNoProblemWhereThereIsNone) {
  EXPECT_EQ(problem_in_log(file()), "");
}

}  // namespace
}  // namespace plekton::apps::run_log_test
