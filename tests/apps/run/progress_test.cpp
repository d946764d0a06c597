// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <thread>

namespace plekton::apps::progress_test {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

/// What a run of 10 s wall time, 2 s simulated and 1000 steps shows.
std::string shown(ProgressStyle style) {
  std::ostringstream out;
  Progress progress(out, style, 2.0);
  const Progress::Clock::time_point start{};
  for (int i = 0; i <= 1000; ++i) progress.update(0.002 * i, i, start + milliseconds(10 * i));
  progress.finish();
  return out.str();
}

TEST(Progress, IsTenPlainLinesWhereThereIsNoTerminal) {
  const std::string text = shown(ProgressStyle::lines);

  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10) << text;
  EXPECT_EQ(text.find('\r'), std::string::npos);
  EXPECT_THAT(text, HasSubstr(" 50 %  1 of 2 s  100 steps/s  5 s left\n"));
}

TEST(Progress, IsOneLineWrittenOverOnATerminal) {
  const std::string text = shown(ProgressStyle::one_line);

  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  EXPECT_EQ(text.back(), '\n');
  EXPECT_EQ(std::count(text.begin(), text.end(), '\r'), 50);  // five a second
}

TEST(Progress, CoversALongerLineWhollyByAShorterOne) {
  std::istringstream lines(shown(ProgressStyle::one_line));
  std::string part;
  std::size_t width = 0;
  while (std::getline(lines, part, '\r')) {
    part.erase(std::remove(part.begin(), part.end(), '\n'), part.end());
    const std::size_t visible = part.find_last_not_of(' ') + 1;
    EXPECT_GE(part.size(), width);
    width = visible;
  }
}

TEST(Progress, CanBeSilent) {
  EXPECT_EQ(shown(ProgressStyle::none), "");
}

/// What a setting up shows that takes half a second for a membrane and 12 s for grains.
std::string shown_of_setting_up(ProgressStyle style) {
  std::ostringstream out;
  {
    const SetUpProgress::Clock::time_point start{};
    SetUpProgress progress(out, style, start);
    progress.update("making membrane m", 0.0, start);
    for (int i = 0; i < 120; ++i)
      progress.update("placing grains g", i / 120.0, start + milliseconds(500 + 100 * i));
  }
  return out.str();
}

TEST(SetUpProgress, SpeaksInLinesWhenTheFirstSecondIsOver) {
  EXPECT_EQ(shown_of_setting_up(ProgressStyle::lines),
            "setting up: placing grains g, 4 %\n"
            "setting up: placing grains g, 46 %\n"
            "setting up: placing grains g, 88 %\n");
}

TEST(SetUpProgress, SpeaksAtOnceOnATerminalAndLeavesAnEmptyLine) {
  const std::string text = shown_of_setting_up(ProgressStyle::one_line);

  EXPECT_EQ(text.find("\rsetting up: making membrane m\rsetting up: placing grains g"), 0U);
  EXPECT_EQ(text.find('\n'), std::string::npos);
  EXPECT_THAT(text, HasSubstr("placing grains g, 98 %\r"));
  const std::string last = text.substr(text.rfind("98 %") + 5);
  EXPECT_EQ(last,
            std::string(std::string("setting up: placing grains g, 98 %").size(), ' ') + '\r');
}

TEST(SetUpProgress, DoesNotWriteOverWhatIsLongerThanALineOfATerminal) {
  std::ostringstream out;
  const std::string long_text(100, 'x');
  {
    SetUpProgress progress(out, ProgressStyle::one_line);
    progress.update(long_text, 0.0);
    progress.update(long_text, 0.5);
    progress.update("short", 0.0);
  }

  EXPECT_NE(out.str().find("setting up: " + long_text + "\n"), std::string::npos);
  EXPECT_EQ(out.str().find(", 50 %"), std::string::npos);
  EXPECT_NE(out.str().find("\rsetting up: short"), std::string::npos);
}

TEST(SetUpProgress, SpeaksInLinesAlsoWhileNothingCallsIt) {
  std::ostringstream out;
  {
    SetUpProgress progress(out, ProgressStyle::lines);
    progress.update("looking for contacts", 0.0);
    std::this_thread::sleep_for(milliseconds(1600));
  }
  EXPECT_EQ(out.str(), "setting up: looking for contacts\n");
}

TEST(SetUpProgress, SaysWhatItIsTheProgressOf) {
  std::ostringstream out;
  {
    SetUpProgress progress(out, ProgressStyle::one_line, {}, "importing tyre.stl");
    progress.update("remeshing", 0.0);
  }
  EXPECT_EQ(out.str().find("\rimporting tyre.stl: remeshing"), 0U);
}

TEST(SetUpProgress, IsSilentWhenAllIsSetUp) {
  std::ostringstream out;
  {
    SetUpProgress progress(out, ProgressStyle::lines);
    progress.update("looking for contacts", 0.0);
    progress.update("", 0.0);
    std::this_thread::sleep_for(milliseconds(1600));
  }
  EXPECT_EQ(out.str(), "");
}

TEST(DurationText, ShowsTwoUnits) {
  EXPECT_EQ(duration_text(0.0), "0 s");
  EXPECT_EQ(duration_text(11.2), "12 s");
  EXPECT_EQ(duration_text(185.0), "3 min 05 s");
  EXPECT_EQ(duration_text(3720.0), "1 h 02 min");
}

}  // namespace
}  // namespace plekton::apps::progress_test
