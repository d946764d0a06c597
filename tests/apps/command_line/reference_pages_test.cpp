// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/reference_pages.hpp"

#include "tests/apps/command_line/program_fixture.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

namespace plekton::apps::reference_pages_test {
namespace {

using testing::HasSubstr;

TEST(ReferencePages, HaveTypeUnitDefaultRangeAndMeaningOfAKey) {
  const std::string page = keys_page();

  EXPECT_THAT(page, HasSubstr("| `duration` | time | s | required | above 0 | simulated time |"));
  EXPECT_THAT(page,
              HasSubstr("| `cells` | 2 x whole number | - | required | from 3 and 1 to 100000 |"));
  EXPECT_THAT(page, HasSubstr("## `[[membranes]] shape, kind = \"tube\"`"));
}

TEST(ReferencePages, HaveTheParametersOfEachLawAndOfAll) {
  const std::string page = laws_page();

  EXPECT_THAT(page,
              HasSubstr("| `work_of_adhesion` | energy per area | J/m2 | 0 | of at least 0 |"));
  EXPECT_THAT(page, HasSubstr("| `bonds` | word | - | \"new\" | \"new\", \"start\" |"));
  EXPECT_THAT(page.substr(page.find("## With every law")), HasSubstr("`restitution`"));
}

/// Signs between the cells of a row of a table.
std::ptrdiff_t bars_in(const std::string& line) {
  std::ptrdiff_t bars = 0;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (line[i] == '|' && (i == 0 || line[i - 1] != '\\')) ++bars;
  return bars;
}

TEST(ReferencePages, HaveTablesWithAsManyCellsInEveryRow) {
  for (const std::string& page : {keys_page(), laws_page(), outputs_page()}) {
    std::istringstream lines(page);
    std::ptrdiff_t bars = 0;
    int rows = 0;
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with('|')) {
        bars = 0;
        continue;
      }
      ++rows;
      if (bars == 0) bars = bars_in(line);
      EXPECT_EQ(bars_in(line), bars) << line;
    }
    EXPECT_GT(rows, 20);
  }
}

TEST(ReferencePages, HaveEveryCommandOfTheHelpAndNotTheHiddenOne) {
  const std::string page = outcome_of({"generate", "commands"}).out;

  EXPECT_THAT(page, HasSubstr("plekton view RUN [--out OUT] [--limit LIMIT] [--serve [PORT]]"));
  EXPECT_THAT(page, HasSubstr("`--set PATH=VALUE`"));
  EXPECT_THAT(page, HasSubstr("`--from STAGE DIR`"));
  EXPECT_THAT(page, HasSubstr("`--interval BEGIN END`"));
  EXPECT_THAT(page, testing::Not(HasSubstr("plekton generate")));
}

}  // namespace
}  // namespace plekton::apps::reference_pages_test
