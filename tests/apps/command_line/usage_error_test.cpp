// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/usage_error.hpp"

#include "tests/apps/command_line/program_fixture.hpp"

#include <gmock/gmock.h>

namespace plekton::apps::usage_error_test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

/// What the program says of a command line that it does not understand.
std::string said_of(const std::vector<std::string>& arguments) {
  const Outcome outcome = outcome_of(arguments);
  EXPECT_EQ(outcome.exit_code, kUsage);
  EXPECT_EQ(outcome.out, "");
  return outcome.err;
}

TEST(UsageError, ListsTheCommandsWhereThereIsNone) {
  EXPECT_THAT(said_of({}), StartsWith("plekton: expected a command: \"run\""));
}

TEST(UsageError, KnowsThatAScenarioIsToBeRun) {
  EXPECT_THAT(said_of({"case.toml"}), HasSubstr("did you mean \"plekton run case.toml\"?"));
}

TEST(UsageError, NamesTheOptionThatWasProbablyMeant) {
  EXPECT_THAT(said_of({"run", "case.toml", "--thread", "2"}),
              AllOf(HasSubstr("run: unknown option \"--thread\"; did you mean \"--threads\"?"),
                    HasSubstr("plekton run --help")));
  EXPECT_THAT(said_of({"run", "case.toml", "--outdir=here"}),
              HasSubstr("unknown option \"--outdir\"; did you mean \"--out\"?"));
  EXPECT_THAT(said_of({"run", "case.toml", "--output-dir", "here"}),
              HasSubstr("unknown option \"--output-dir\"; did you mean \"--out\"?"));
  EXPECT_THAT(said_of({"run", "case.toml", "--gravity"}),
              HasSubstr("unknown option \"--gravity\" (see plekton run --help)"));
  EXPECT_THAT(said_of({"--gravity"}),
              AllOf(HasSubstr("unknown option \"--gravity\""), HasSubstr("plekton --help")));
}

TEST(UsageError, SaysWhereResultsGoInsteadOfASecondArgument) {
  EXPECT_THAT(
      said_of({"run", "case.toml", "results"}),
      HasSubstr("run: \"results\" is one argument too many; what is written goes to --out"));
  EXPECT_THAT(said_of({"inspect", "a.h5", "b.h5"}),
              HasSubstr("inspect: \"b.h5\" is one argument too many (see plekton inspect --help)"));
}

TEST(UsageError, SaysWhatIsWrongWithAValue) {
  EXPECT_THAT(said_of({"run", "case.toml", "--threads", "many"}),
              AllOf(HasSubstr("run: --threads: Value many not in range 1 to 1024"),
                    EndsWith("(see plekton run --help)\n")));
}

}  // namespace
}  // namespace plekton::apps::usage_error_test
