// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/grain_table.hpp"

#include "apps/scenario/problems.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plekton::apps::grain_table_test {
namespace {

using geometry::Vec3;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::string error_of(std::string_view text) {
  try {
    parse_grain_table(text, "soil.csv");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(GrainTable, HasFourNumbersInMetresWithoutAHead) {
  const GrainTable table = parse_grain_table("1,2,3,0.5\n-1e-3, 0 ,4,0.25\n", "soil.csv");

  EXPECT_THAT(table.centres, ElementsAre(Vec3(1, 2, 3), Vec3(-1e-3, 0, 4)));
  EXPECT_THAT(table.radii, ElementsAre(0.5, 0.25));
}

TEST(GrainTable, MayBeginWithAByteOrderMark) {
  for (const char* text : {"\xEF\xBB\xBFx (m),y (m),z (m),r (m)\n1,2,3,0.5\n",
                           "\xEF\xBB\xBF"
                           "1,2,3,0.5\n"}) {
    const GrainTable table = parse_grain_table(text, "soil.csv");

    EXPECT_THAT(table.centres, ElementsAre(Vec3(1, 2, 3)));
  }
}

TEST(GrainTable, TakesColumnsByTheirNamesAndUnits) {
  const GrainTable table = parse_grain_table(
      "\n# a packing\n\"radius (mm)\",id,z (cm),y (m),x (mm)\r\n5,7,1,2,3\r\n", "soil.csv");

  ASSERT_EQ(table.centres.size(), 1U);
  EXPECT_NEAR((table.centres[0] - Vec3(3e-3, 2.0, 1e-2)).norm(), 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(table.radii[0], 5e-3);
}

TEST(GrainTable, SaysWhereItIsNone) {
  EXPECT_THAT(error_of(""), HasSubstr("soil.csv: has no row of numbers"));
  EXPECT_THAT(error_of("x,y,z,r\n"), HasSubstr("has no row of numbers"));
  EXPECT_THAT(error_of("1,2,3\n"), HasSubstr("row 1: got 3 columns; expected 4, with r"));
  EXPECT_THAT(error_of("1,2,3,0.1\n1,2,zwei,0.1\n"),
              HasSubstr("row 2: z is \"zwei\"; expected a number"));
  EXPECT_THAT(error_of("1,2,3,0\n"), HasSubstr("r is 0 m; expected a radius above 0"));
  EXPECT_THAT(error_of("1,2,nan,1\n"), HasSubstr("z is \"nan\""));
  EXPECT_THAT(error_of("x,y,z,size\n1,2,3,4\n"), HasSubstr("no column is called r"));
  EXPECT_THAT(error_of("x,x,z,r\n1,2,3,4\n"), HasSubstr("two columns are called x"));
  EXPECT_THAT(error_of("x (kg),y,z,r\n1,2,3,4\n"), HasSubstr("column x:"));
}

TEST(GrainTable, ShowsOfAFileOnlyTheBeginningOfAWord) {
  const std::string secret(200, 'q');
  EXPECT_THAT(error_of("1,2,3,0.1\n1,2," + secret + ",1\n"), Not(HasSubstr(secret)));
}

TEST(GrainTable, OfAFileThatIsNotThereNamesIt) {
  EXPECT_THROW(read_grain_table("/nowhere/soil.csv"), InputError);
}

}  // namespace
}  // namespace plekton::apps::grain_table_test
