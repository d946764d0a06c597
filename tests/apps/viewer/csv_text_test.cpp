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

}  // namespace
}  // namespace plekton::apps::csv_text_test
