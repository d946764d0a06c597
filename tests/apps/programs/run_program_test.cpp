// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/programs/run_program.hpp"

#include "apps/scenario/problems.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plekton::apps::run_program_test {
namespace {

using testing::HasSubstr;

std::string problem_of(const std::string& script) {
  const test::TemporaryFolder folder;
  try {
    run_to_end({"/bin/sh", "-c", script}, folder / "log");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RunToEnd, TellsOnlyOfAProgramThatFails) {
  EXPECT_EQ(problem_of("echo Error: none"), "");
}

TEST(RunToEnd, TellsTheLastErrorOrTheLastLine) {
  EXPECT_THAT(problem_of("echo first; echo last; exit 2"), HasSubstr("exit code 2; it said: last"));
  EXPECT_THAT(problem_of("echo RuntimeError: no; echo Aborted; kill -6 $$"),
              HasSubstr("signal 6; it said: RuntimeError: no"));
  EXPECT_THAT(problem_of("exit 1"), HasSubstr("exit code 1"));
}

}  // namespace
}  // namespace plekton::apps::run_program_test
