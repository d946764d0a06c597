// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/programs/child_process.hpp"
#include "tests/apps/command_line/command_fixture.hpp"

namespace plekton::apps::pictures_command_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class PicturesCommand : public Command {
 protected:
  void run() const {
    ASSERT_EQ(outcome_of({"run", scenario(), "--out", out(), "--quiet"}).exit_code, kDone);
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  static void without_programs() { ::setenv("PATH", "/no/such/folder", 1); }
};

TEST_F(PicturesCommand, PlotsHistoriesAsSvgAndPng) {
  if (!find_program("gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
  run();

  const Outcome outcome = outcome_of({"plot", out()});

  ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;
  const std::string svg = test::bytes_of(out() + "/plot.svg");
  for (const char* text : {"<svg", "time (s)", "energy (J)", "kinetic", "energy.csv", "</svg>"})
    EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_THAT(test::bytes_of(out() + "/plot.png"), StartsWith("\x89PNG"));
}

TEST_F(PicturesCommand, PlotsTheColumnsThatAreNamedIntoTheFileThatIsNamed) {
  if (!find_program("gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
  run();
  const std::string name = file("a b; touch x 'q'.svg");

  const Outcome outcome =
      outcome_of({"plot", out(), "--columns", "kinetic,plane_contacts", "--out", name});

  ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(test::bytes_of(name), AllOf(HasSubstr("kinetic"), HasSubstr("plane_contacts"),
                                          testing::Not(HasSubstr("gravity"))));
}

TEST_F(PicturesCommand, PlotsOneColumnOverAnother) {
  if (!find_program("gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
  run();
  const std::string name = file("loop.svg");

  const Outcome outcome =
      outcome_of({"plot", out(), "--columns", "kinetic", "--x", "gravity", "--out", name});

  ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(test::bytes_of(name),
              AllOf(HasSubstr("gravity (J)"), testing::Not(HasSubstr("time (s)"))));
}

TEST_F(PicturesCommand, ReplaceNoFileThatIsNoPicture) {
  run();
  for (const char* name : {"mine.svg", "mine.png"}) {
    test::write_bytes(file(name), "<?xml version=\"1.0\"?><svg>drawn by hand</svg>");
    const std::string before = test::bytes_of(file(name));
    for (const char* command : {"plot", "render"}) {
      if (std::string_view(name).ends_with("svg") && command == std::string_view("render"))
        continue;
      const Outcome outcome = outcome_of({command, out(), "--out", file(name)});
      EXPECT_EQ(outcome.exit_code, kFailed) << command;
      EXPECT_THAT(outcome.err, HasSubstr(std::string(name) + ": is there already and no p"));
      EXPECT_EQ(test::bytes_of(file(name)), before);
    }
  }
}

TEST_F(PicturesCommand, PlotReplacesAnEarlierPlot) {
  if (!find_program("gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
  run();

  for (int i = 0; i < 2; ++i) {
    const Outcome outcome = outcome_of({"plot", out()});
    EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  }
}

TEST_F(PicturesCommand, SayInOneLineWhatIsMissingOrWrong) {
  run();
  const auto lines = [](const std::string& text) {
    return std::count(text.begin(), text.end(), '\n');
  };
  for (const char* command : {"plot", "render"}) {
    const Outcome outcome = outcome_of({command, out()}, without_programs);
    EXPECT_EQ(outcome.exit_code, kFailed);
    EXPECT_THAT(outcome.err, HasSubstr("is not installed (Debian: "));
    EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
    EXPECT_EQ(outcome_of({command, out() + "/none"}).exit_code, kFailed);
    EXPECT_THAT(outcome_of({command, out(), "--out", file("x.pdf")}).err,
                HasSubstr("expected a file that ends in"));
  }
  EXPECT_THAT(outcome_of({"plot", out(), "--columns", "kinetik"}).err,
              HasSubstr("did you mean \"kinetic\"?"));
  EXPECT_THAT(outcome_of({"render", out(), "--at", "1 s"}).err,
              HasSubstr("the run has frames from 0 s to 0.02 s"));
  EXPECT_THAT(outcome_of({"render", out(), "--at", "1 m"}).err, HasSubstr("--at: "));
}

TEST_F(PicturesCommand, RendersAFrame) {
  const bool can =
      find_program("pvbatch") && (std::getenv("DISPLAY") != nullptr || find_program("xvfb-run"));
  if (!can) GTEST_SKIP() << "ParaView, or a screen for it, is not installed";
  run();

  const Outcome outcome = outcome_of({"render", out(), "--at", "11 ms"});

  ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("frame.png: the frame at 0.01 s"));
  EXPECT_THAT(test::bytes_of(out() + "/frame.png"), StartsWith("\x89PNG"));
}

}  // namespace
}  // namespace plekton::apps::pictures_command_test
