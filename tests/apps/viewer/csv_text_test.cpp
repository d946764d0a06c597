// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/viewer/csv_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plekton::apps::csv_text_test {
namespace {

using testing::ElementsAre;

TEST(CsvText, HoldsCommasQuotesAndLineBreaksInQuotes) {
  const auto rows = parse_csv("a, b ,\"c,d\"\r\n\n\"say \"\"x\"\"\",\"two\nlines\",\nlast,,x");

  ASSERT_EQ(rows.size(), 3U);
  EXPECT_THAT(rows[0].cells, ElementsAre("a", "b", "c,d"));
  EXPECT_THAT(rows[1].cells, ElementsAre("say \"x\"", "two\nlines", ""));
  EXPECT_THAT(rows[2].cells, ElementsAre("last", "", "x"));
  EXPECT_EQ(rows[1].line, 3);
  EXPECT_EQ(rows[2].line, 5);
}

TEST(CsvText, MayBeginWithAByteOrderMark) {
  const auto rows = parse_csv("\xEF\xBB\xBF\"a\",b\n1,2\n");

  ASSERT_EQ(rows.size(), 2U);
  EXPECT_THAT(rows[0].cells, ElementsAre("a", "b"));
}

TEST(CsvText, HasNoRowsForBlankLinesButOneForAnEmptyCellInQuotes) {
  const auto rows = parse_csv("a\n\n  \r\n\"\"\r\n\t\nb\n \"\" \n\n");

  ASSERT_EQ(rows.size(), 4U);
  EXPECT_THAT(rows[0].cells, ElementsAre("a"));
  EXPECT_THAT(rows[1].cells, ElementsAre(""));
  EXPECT_EQ(rows[1].line, 4);
  EXPECT_THAT(rows[2].cells, ElementsAre("b"));
  EXPECT_THAT(rows[3].cells, ElementsAre(""));
  EXPECT_EQ(rows[3].line, 7);
}

TEST(CsvText, IsReadAsItWasWritten) {
  for (const std::string cell : {"plain", "a,b", "a \"quote\"", "two\nlines", "[0, 0, 1]"}) {
    const auto rows = parse_csv(csv_cell(cell) + ",x\n");
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_THAT(rows[0].cells, ElementsAre(cell, "x"));
  }
}

TEST(CsvText, SaysWhichRowHasAQuoteThatIsNotClosedOrTextBehindOne) {
  const auto behind = parse_csv("a,b\n1,\"0.001\" ms\n\"2\" \t,\"say \"\"x\"\"\" \r\n");
  const auto open = parse_csv("a\n\"1\n2");

  ASSERT_EQ(behind.size(), 3U);
  EXPECT_EQ(behind[0].problem, "");
  EXPECT_THAT(behind[1].problem,
              testing::StartsWith("cell 2: got \"ms\" behind a closing quote; expected a comma"));
  EXPECT_EQ(behind[1].cells[1], "0.001");
  EXPECT_EQ(behind[2].problem, "");
  ASSERT_EQ(open.size(), 2U);
  EXPECT_EQ(open[1].line, 2);
  EXPECT_THAT(open[1].problem, testing::StartsWith("cell 1: got a quote that is not closed"));
}

}  // namespace
}  // namespace plekton::apps::csv_text_test
