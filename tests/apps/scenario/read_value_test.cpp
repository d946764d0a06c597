// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/read_value.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plekton::apps::read_value_test {
namespace {

using geometry::Vec3;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr Quantity kThickness{kLength, kPositive};

/// A value on the line of a file.
template <class Data>
Value on_line(int line, Data data) {
  return {{"a.toml", line, 1}, std::move(data)};
}

Value texts_on(int line, const std::vector<std::string>& texts) {
  Array array;
  for (const std::string& text : texts) array.push_back(on_line(line, text));
  return on_line(line, array);
}

Value numbers_on(int line, const std::vector<std::int64_t>& numbers) {
  Array array;
  for (const std::int64_t number : numbers) array.push_back(on_line(line, number));
  return on_line(line, array);
}

TEST(ReadQuantity, TakesANumberInSiUnitsOrATextWithAUnit) {
  Problems problems;
  EXPECT_EQ(read_quantity(on_line(1, 0.5), "d", kThickness, problems), 0.5);
  EXPECT_EQ(read_quantity(on_line(1, std::int64_t{2}), "d", kThickness, problems), 2.0);
  EXPECT_EQ(read_quantity(on_line(1, std::string("5 mm")), "d", kThickness, problems), 0.005);
  EXPECT_TRUE(problems.empty());
}

TEST(ReadQuantity, SaysAtThePlaceOfTheValueWhatIsWrong) {
  Problems problems;
  EXPECT_TRUE(std::isnan(read_quantity(on_line(1, -1.0), "d", kThickness, problems)));
  EXPECT_TRUE(std::isnan(read_quantity(on_line(2, true), "d", kThickness, problems)));
  const Quantity slope{kAngle, {0.0, 1.57, true, true, " from 0 to 90 deg"}};
  EXPECT_TRUE(std::isnan(read_quantity(on_line(3, std::int64_t{35}), "a", slope, problems)));

  EXPECT_THAT(problems.lines(),
              ElementsAre("a.toml:1:1: d: got -1; expected a length above 0",
                          "a.toml:2:1: d: got true; expected a length (m, cm, mm, um, nm, km)",
                          "a.toml:3:1: a: got 35 rad; expected an angle from 0 to 90 deg; did you "
                          "mean \"35 deg\"?"));
}

TEST(ReadVector, NamesTheComponentThatIsWrong) {
  Problems problems;
  const Quantity place{kLength};
  EXPECT_EQ(read_vector(texts_on(1, {"1 m", "2 mm", "0 m"}), "p", place, problems),
            Vec3(1.0, 0.002, 0.0));
  EXPECT_TRUE(problems.empty());

  read_vector(texts_on(1, {"1 m", "2 s", "0 m"}), "p", place, problems);
  read_vector(texts_on(2, {"1 m"}), "p", place, problems);

  ASSERT_EQ(problems.count(), 2u);
  EXPECT_THAT(problems.lines()[0], testing::StartsWith("a.toml:1:1: p[1]: got \"2 s\""));
  EXPECT_THAT(problems.lines()[1], testing::EndsWith("a list of three components, x, y and z"));
}

TEST(ReadWholeNumber, RefusesWhatIsOutOfItsLimitsOrWrittenAsAFraction) {
  Problems problems;
  EXPECT_EQ(read_whole_number(on_line(1, std::int64_t{7}), "n", 1, 7, problems), 7);
  EXPECT_TRUE(problems.empty());

  EXPECT_EQ(read_whole_number(on_line(1, std::int64_t{8}), "n", 1, 7, problems), std::nullopt);
  EXPECT_EQ(read_whole_number(on_line(2, 5.0), "n", 1, 7, problems), std::nullopt);

  EXPECT_THAT(problems.lines(),
              ElementsAre("a.toml:1:1: n: got 8; expected a whole number from 1 to 7",
                          "a.toml:2:1: n: got 5 with a decimal point or an exponent; expected a "
                          "whole number from 1 to 7"));
}

TEST(ReadPlaces, TakesRowsOfDifferentPlacesAlone) {
  Problems problems;
  EXPECT_THAT(read_places(on_line(1, Array{numbers_on(1, {0, 2}), numbers_on(1, {2, 1})}), "r", 2,
                          3, problems),
              ElementsAre(0, 2, 2, 1));
  EXPECT_TRUE(problems.empty());

  const Value rows = on_line(1, Array{numbers_on(2, {0, 0}), numbers_on(3, {0, 3})});
  EXPECT_THAT(read_places(rows, "r", 2, 3, problems), IsEmpty());

  EXPECT_THAT(
      problems.lines(),
      ElementsAre("a.toml:2:1: r[0]: got [0, 0]; expected 2 different whole numbers from 0 to 2",
                  "a.toml:3:1: r[1]: got [0, 3]; expected 2 different whole numbers from 0 to 2"));
}

TEST(ReadWord, IsThePositionOfTheWordOrSaysWhichIsNear) {
  constexpr std::array<std::string_view, 2> kWords{"flat", "cylinder"};
  Problems problems;
  EXPECT_EQ(read_word(on_line(1, std::string("cylinder")), "form", kWords, problems), 1u);
  EXPECT_EQ(read_word(on_line(1, std::string("cilinder")), "form", kWords, problems), std::nullopt);

  EXPECT_THAT(problems.lines(),
              ElementsAre("a.toml:1:1: form: got \"cilinder\"; expected one of \"flat\", "
                          "\"cylinder\"; did you mean \"cylinder\"?"));
}

TEST(ReadTexts, TakesNoEmptyListAndNoEmptyText) {
  Problems problems;
  EXPECT_THAT(read_texts(texts_on(1, {"a", "b"}), "names", problems), ElementsAre("a", "b"));
  EXPECT_TRUE(problems.empty());
  EXPECT_THAT(read_texts(texts_on(1, {}), "names", problems), IsEmpty());
  EXPECT_THAT(read_texts(texts_on(2, {"a", ""}), "names", problems), IsEmpty());
  EXPECT_EQ(problems.count(), 2u);
}

}  // namespace
}  // namespace plekton::apps::read_value_test
