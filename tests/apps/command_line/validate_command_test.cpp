// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/validation/validation_report.hpp"
#include "tests/apps/command_line/program_fixture.hpp"

#include <gmock/gmock.h>

namespace plekton::apps::validate_command_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(Finding, PassesWithinItsToleranceAndNotWhereItIsNoNumber) {
  EXPECT_TRUE((Finding{"x", 1.01, 1.0, 0.011, "", ""}.passes()));
  EXPECT_FALSE((Finding{"x", 1.02, 1.0, 0.011, "", ""}.passes()));
  EXPECT_FALSE((Finding{"x", std::nan(""), 1.0, 0.011, "", ""}.passes()));
}

TEST(ValidateCommand, PassesAllCasesAndWritesAPageThatLoadsNothing) {
  const test::TemporaryFolder folder;

  const Outcome outcome = outcome_of({"validate", "--out", (folder / "out").string()});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, Not(HasSubstr("FAIL")));
  const std::string page = test::bytes_of(folder / "out" / "validation.html");
  EXPECT_THAT(page, AllOf(HasSubstr("12 of 12 cases pass"), HasSubstr("<svg"),
                          Not(HasSubstr("src=")), Not(HasSubstr("href="))));
}

TEST(ValidateCommand, NamesACaseThatIsNotThereAndGoesOnWithTheRest) {
  const test::TemporaryFolder folder;

  const Outcome outcome =
      outcome_of({"validate", "rollin", "cantilever", "--out", (folder / "out").string()});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("no case \"rollin\"; did you mean \"rolling\"?"));
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("cantilever"), HasSubstr("wrote ")));
}

TEST(ValidateCommand, SaysThatAFolderCannotBeWrittenAndRunsTheCases) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "file", "");

  const Outcome outcome =
      outcome_of({"validate", "cantilever", "--out", (folder / "file" / "out").string()});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.out, HasSubstr("cantilever"));
  EXPECT_THAT(outcome.err, HasSubstr("no page is written"));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

TEST(ValidateCommand, SaysWhichCaseItIsAtBeforeTheFiguresOfThatCase) {
  const test::TemporaryFolder folder;

  const Outcome outcome =
      outcome_of({"validate", "cantilever", "cable", "--out", (folder / "out").string()});

  const std::size_t announced = outcome.out.find("2 of 2: a chain of links");
  ASSERT_NE(announced, std::string::npos) << outcome.out;
  EXPECT_LT(outcome.out.find("cantilever ("), announced);
  EXPECT_GT(outcome.out.find("cable ("), announced);
}

TEST(ValidateCommand, ReplacesNoPageOfSomebodyElse) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "validation.html", "<!DOCTYPE html><title>Mine</title>");
  const std::vector<std::string> cantilever = {"validate", "cantilever", "--out",
                                               folder.path().string()};

  const Outcome refused = outcome_of(cantilever);

  EXPECT_EQ(refused.exit_code, kFailed);
  EXPECT_THAT(refused.err,
              HasSubstr("validation.html: is there already and no page of plekton validate"));
  EXPECT_EQ(refused.out, "");  // no case was run
  EXPECT_EQ(test::bytes_of(folder / "validation.html"), "<!DOCTYPE html><title>Mine</title>");
  std::filesystem::remove(folder / "validation.html");
  EXPECT_EQ(outcome_of(cantilever).exit_code, kDone);
  EXPECT_EQ(outcome_of(cantilever).exit_code, kDone);
}

TEST(ValidateCommand, ListsTheCasesThatAreNamedAndNoOthers) {
  const Outcome one = outcome_of({"validate", "--list", "cantilever"});
  const Outcome none = outcome_of({"validate", "--list", "nope"});

  EXPECT_EQ(one.exit_code, kDone);
  EXPECT_THAT(one.out, AllOf(testing::StartsWith("cantilever "), Not(HasSubstr("rolling"))));
  EXPECT_EQ(none.exit_code, kFailed);
  EXPECT_EQ(none.out, "");
  EXPECT_THAT(none.err, HasSubstr("there is no case \"nope\"; plekton validate --list names them"));
}

TEST(ValidateCommand, ListsItsCases) {
  const Outcome outcome = outcome_of({"validate", "--list"});

  EXPECT_EQ(outcome.exit_code, kDone);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("rolling"), HasSubstr("determinism")));
}

}  // namespace
}  // namespace plekton::apps::validate_command_test
