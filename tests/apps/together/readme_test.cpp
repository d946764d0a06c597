// SPDX-License-Identifier: GPL-3.0-or-later
// What the README says of the program and of the example is true.
#include "tests/apps/command_line/program_fixture.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <set>
#include <sstream>

namespace plekton::apps::readme_test {
namespace {

using Words = std::set<std::string>;

std::string source(const std::string& path) {
  return test::bytes_of(std::filesystem::path(PLEKTON_SOURCE_DIR) / path);
}

/// The first block of code after a text of the README.
std::string code_after(const std::string& text) {
  const std::string readme = source("README.md");
  const std::size_t begin = readme.find('\n', readme.find("\n```", readme.find(text)) + 1) + 1;
  return readme.substr(begin, readme.find("\n```", begin) + 1 - begin);
}

/// Every --word: a letter, then letters and dashes.
Words options_in(const std::string& text) {
  constexpr const char* kLetters = "abcdefghijklmnopqrstuvwxyz";
  Words options;
  for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at + 2)) {
    if (text.find_first_of(kLetters, at + 2) != at + 2) continue;
    const std::size_t end = text.find_first_not_of(std::string(kLetters) + "-", at + 2);
    options.insert(text.substr(at, end == std::string::npos ? end : end - at));
  }
  return options;
}

/// The part of the synopsis that begins with these words, up to the next command.
std::string synopsis_of(const std::string& command) {
  const std::string synopsis = code_after("## The program");
  const std::size_t begin = synopsis.find(command);
  if (begin == std::string::npos) return "";
  return synopsis.substr(begin, synopsis.find("\nplekton ", begin) - begin);
}

/// The options that the program itself lists for a command.
Words options_of(std::vector<std::string> command) {
  command.push_back("--help");
  Words options;
  // Option names begin a line; elsewhere a text may speak of another command's.
  std::istringstream lines(outcome_of(command).out);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("  -")) options.merge(options_in(line.substr(0, line.find("  ", 2))));
  }
  options.erase("--help");
  return options;
}

TEST(Readme, ListsTheOptionsOfEveryCommandAndNoOther) {
  for (const std::string command : {"run", "check", "import"}) {
    const Words options = options_of({command});

    EXPECT_FALSE(options.empty()) << command;
    EXPECT_EQ(options_in(synopsis_of("plekton " + command)), options) << command;
  }
  EXPECT_EQ(options_in(synopsis_of("plekton --version")), (Words{"--help", "--version"}));
  EXPECT_EQ(options_of({}), Words{"--version"});
}

TEST(Readme, ListsEveryCommand) {
  const std::string help = outcome_of({"--help"}).out;
  std::istringstream lines(help.substr(help.find("Subcommands:")));
  std::string line;
  std::getline(lines, line);
  int commands = 0;
  for (; std::getline(lines, line) && !line.empty(); ++commands) {
    const std::string command = line.substr(2, line.find(' ', 2) - 2);
    EXPECT_NE(synopsis_of("plekton " + command), "") << command;
  }
  EXPECT_GT(commands, 0);
}

TEST(Readme, ShowsTheExampleAsItIs) {
  const std::string example = source("apps/examples/first_steps.cpp");

  EXPECT_EQ(code_after("## The library"), example.substr(example.find("#include")));
  const auto lines = std::count(example.begin(), example.end(), '\n');
  EXPECT_LE(lines, 32);  // thirty and two of comments
}

#ifdef PLEKTON_FIRST_STEPS
/// Heights (m) that the example prints.
std::vector<double> heights_of_example() {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen(PLEKTON_FIRST_STEPS, "r"),
                                                             ::pclose);
  std::vector<double> heights;
  double time = 0.0;
  double height = 0.0;
  while (std::fscanf(pipe.get(), "%lf s: height %lf m\n", &time, &height) == 2)
    heights.push_back(height);
  return heights;
}

TEST(FirstSteps, LetTheSphereFallAndTheSheetCatchIt) {
  const std::vector<double> heights = heights_of_example();

  ASSERT_EQ(heights.size(), 11u);
  EXPECT_EQ(heights.front(), 0.06);
  EXPECT_LT(heights[3], 0.032);  // it touches the sheet at 0.032 m, after 0.076 s
  for (const double height : heights) EXPECT_GT(height, -0.2);  // half the width of the sheet
}
#endif

}  // namespace
}  // namespace plekton::apps::readme_test
