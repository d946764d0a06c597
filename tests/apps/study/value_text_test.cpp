// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/study/value_text.hpp"

#include "apps/scenario/toml_file.hpp"

#include <gtest/gtest.h>

namespace plekton::apps::value_text_test {
namespace {

/// What --set makes of a text is the value again.
TEST(ValueText, IsReadBackAsTheSameValue) {
  for (const char* text :
       {"\"2 s\"", "\"5\"", "\"true\"", "\"\"", "\"a \\\"b\\\" \\\\ \\u001b\"", "3", "3.0", "-1e-9",
        "1e300", "true", "[0, 0, \"1 m\"]", "{ min = [0, 1], name = \"x\" }", "[[1, 2], [3, 4]]"}) {
    const Value value = parse_toml_value(text, {});
    const std::string written = override_text(value);
    const Value again = parse_toml_value(written, {});

    EXPECT_EQ(toml_text(again), toml_text(value)) << written;
    EXPECT_EQ(again.data.index(), value.data.index()) << written;
  }
}

TEST(ValueText, LeavesOutQuotesThatATextDoesNotNeed) {
  EXPECT_EQ(override_text(parse_toml_value("20 deg", {})), "20 deg");
  EXPECT_EQ(override_text(parse_toml_value("\"5\"", {})), "\"5\"");
}

TEST(NumberWithUnit, IsANumberAndWhatFollows) {
  const auto quantity = [](const char* text) {
    return number_with_unit(parse_toml_value(text, {}));
  };

  EXPECT_EQ(quantity("20 deg")->unit, "deg");
  EXPECT_EQ(quantity("20 deg")->number, 20.0);
  EXPECT_EQ(quantity("1.5e6Pa")->unit, "Pa");
  EXPECT_EQ(quantity("7")->unit, "");
  EXPECT_EQ(text_of(NumberWithUnit{22.5, "deg"}), "22.5 deg");
  EXPECT_FALSE(quantity("deg"));
  EXPECT_FALSE(quantity("inf"));
  EXPECT_FALSE(quantity("[1]"));
}

}  // namespace
}  // namespace plekton::apps::value_text_test
