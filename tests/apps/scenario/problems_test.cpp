// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/problems.hpp"

#include <gtest/gtest.h>

namespace plekton::apps::problems_test {
namespace {

TEST(Problems, AreALineEachInTheOrderOfTheirPlaces) {
  Problems problems;
  problems.add({"a.toml", 12, 1}, "second");
  problems.add({"a.toml", 3, 8}, "first");
  problems.add({"a.toml", 3, 8}, "first");

  EXPECT_EQ(problems.lines(),
            (std::vector<std::string>{"a.toml:3:8: first", "a.toml:12:1: second"}));
}

TEST(Problems, ShowControlCharactersOfTheInputInsteadOfSendingThemToTheTerminal) {
  Problems problems;
  problems.add({"a.toml", 1, 1}, "got \"1 s\n\", \"\x1b[2J\", \"µm\"" + std::string(1, '\0'));

  EXPECT_EQ(problems.lines().front(), "a.toml:1:1: got \"1 s\\n\", \"\\x1b[2J\", \"µm\"\\x00");
}

}  // namespace
}  // namespace plekton::apps::problems_test
