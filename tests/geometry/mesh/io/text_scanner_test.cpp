// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/io/text_scanner.hpp"

#include "tests/support/seeded_random.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plekton::geometry::text_scanner_test {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr auto kLeast = std::numeric_limits<std::int64_t>::min();
constexpr auto kMost = std::numeric_limits<std::int64_t>::max();

TEST(ParseNumber, IsTheDoubleThatWasWrittenWithSeventeenDigits) {
  std::mt19937_64 bits(1);
  for (int trial = 0; trial < 20000; ++trial) {
    const auto expected = std::bit_cast<double>(bits());
    if (!std::isfinite(expected)) continue;
    char text[40];
    std::snprintf(text, sizeof text, trial % 2 == 0 ? "%.16e" : "%.17G", expected);

    const std::optional<double> found = parse_number(text);

    ASSERT_TRUE(found.has_value()) << text;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(*found), std::bit_cast<std::uint64_t>(expected)) << text;
  }
}

TEST(ParseNumber, TakesOneSignAndEveryWayToWriteANumber) {
  for (const auto& [text, expected] :
       std::vector<std::pair<std::string, double>>{{"12", 12.0},
                                                   {"+12", 12.0},
                                                   {"-12", -12.0},
                                                   {".5", 0.5},
                                                   {"5.", 5.0},
                                                   {"-.5", -0.5},
                                                   {"+1.5e+2", 150.0},
                                                   {"1E-2", 0.01},
                                                   {"007", 7.0},
                                                   {"inf", kInfinity},
                                                   {"-inf", -kInfinity},
                                                   {"+Infinity", kInfinity}})
    EXPECT_EQ(parse_number(text), expected) << text;
  EXPECT_TRUE(std::isnan(parse_number("nan").value()));
  EXPECT_TRUE(std::isnan(parse_number("-NaN").value()));
}

TEST(ParseNumber, HasNoValueForAnyOtherWord) {
  for (const char* text : {"", "+", "-", "++1", "+-1", "-+1", "--1", "1x", "x1", " 1", "1 ", "1,5",
                           "1e", "1e+", ".", "0x10", "1.2.3", "e5", "infinit"})
    EXPECT_EQ(parse_number(text), std::nullopt) << text;
}

TEST(ParseNumber, IsInfiniteWhereItIsTooLargeAndZeroWhereItIsTooSmall) {
  const std::string zeros(400, '0');
  for (const auto& [text, expected] : std::vector<std::pair<std::string, double>>{
           {"1e309", kInfinity},
           {"-1e309", -kInfinity},
           {"+1E+999", kInfinity},
           {"1" + zeros, kInfinity},
           {"-1" + zeros, -kInfinity},
           {"1e-400", 0.0},
           {"-1E-400", 0.0},
           {"0." + zeros + "1", 0.0},
           {"-." + zeros + "1", 0.0},
           {"0e999", 0.0},
           {"1" + zeros + "e-10", kInfinity},
           {"0." + zeros + "1e5", 0.0},
           {"01" + zeros, kInfinity},
           {"-0.01e99999999999999999999", -kInfinity},
           {"100e-99999999999999999999", 0.0},
           {"1.7976931348623157e308", std::numeric_limits<double>::max()},
           {"4.9406564584124654e-324", std::numeric_limits<double>::denorm_min()}})
    EXPECT_EQ(parse_number(text), expected) << text.substr(0, 10);
}

TEST(ParseInteger, TakesAllOf64BitsAndNoMore) {
  EXPECT_EQ(parse_integer("9223372036854775807"), kMost);
  EXPECT_EQ(parse_integer("+9223372036854775807"), kMost);
  EXPECT_EQ(parse_integer("-9223372036854775808"), kLeast);
  EXPECT_EQ(parse_integer("-0012"), -12);
  for (const char* text : {"9223372036854775808", "-9223372036854775809", "", "+", "-", "+-1",
                           "++1", "1.0", "1e3", "0x1", "1 ", " 1"})
    EXPECT_EQ(parse_integer(text), std::nullopt) << text;
}

TEST(Quoted, ShowsTheBeginningOfAWordAndNothingOfAnotherKindOfFile) {
  EXPECT_EQ(quoted(""), "''");
  EXPECT_EQ(quoted("12345678901234567890"), "'12345678901234567890'");
  EXPECT_EQ(quoted("123456789012345678901"), "'12345678901234567890...'");
  EXPECT_EQ(quoted("secret", false), "another kind of file");
}

/// Words with their lines.
std::vector<std::pair<std::string_view, std::size_t>> words_of(TextScanner scanner) {
  std::vector<std::pair<std::string_view, std::size_t>> words;
  while (!scanner.at_end()) {
    const std::string_view word = scanner.word("a word");
    words.emplace_back(word, scanner.line());
  }
  return words;
}

TEST(TextScanner, CountsLinesAlikeWhateverEndsThem) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const std::string text = "a\tb" + end + end + " c # d" + end + "#e" + end + "f\v g" + end;

    EXPECT_THAT(
        words_of(TextScanner(text, "x", '#', 7)),
        ElementsAre(Pair("a", 7u), Pair("b", 7u), Pair("c", 9u), Pair("f", 11u), Pair("g", 11u)));
  }
  EXPECT_THAT(words_of(TextScanner("# a", "x")), ElementsAre(Pair("#", 1u), Pair("a", 1u)))
      << "no comments unless they are asked for";
}

TEST(TextScanner, GivesTheRestOfALineAndGoesOnBehindIt) {
  const std::string text = "name  of a part \r\n\r\n12 -3.5";
  TextScanner scanner(text, "x");

  EXPECT_EQ(scanner.word("a word"), "name");
  EXPECT_EQ(scanner.position(), 4u);
  EXPECT_EQ(scanner.rest_of_line(), "  of a part ");
  EXPECT_EQ(scanner.line(), 1u);
  EXPECT_EQ(scanner.position(), text.find("\r\n\r\n") + 2);
  EXPECT_EQ(scanner.rest_of_line(), "");
  EXPECT_EQ(scanner.line(), 2u);
  EXPECT_EQ(scanner.integer("a count"), 12);
  EXPECT_EQ(scanner.line(), 3u);
  EXPECT_EQ(scanner.number("a length"), -3.5);
  EXPECT_EQ(scanner.rest_of_line(), "");
  EXPECT_TRUE(scanner.at_end());
}

template <class Read>
std::string message_of(const char* text, Read read) {
  TextScanner scanner(text, "a.off", '#', 3);
  try {
    read(scanner);
  } catch (const MeshError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(TextScanner, SaysWhereItExpectedWhat) {
  const std::string advice = "; correct the line or export the mesh again";
  const auto integer = [](TextScanner& scanner) { scanner.integer("the number of points"); };
  const auto number = [](TextScanner& scanner) { scanner.number("a length"); };
  const auto words = [](TextScanner& scanner) {
    while (true) scanner.word("a word");
  };

  EXPECT_EQ(message_of("\n1.5", integer),
            "a.off: line 4: expected the number of points, got '1.5'" + advice);
  EXPECT_EQ(message_of("one", number), "a.off: line 3: expected a length, got 'one'" + advice);
  EXPECT_EQ(message_of("a\nb # c\n\n", words),
            "a.off: line 6: expected a word, got the end of the file" + advice);
}

}  // namespace
}  // namespace plekton::geometry::text_scanner_test
