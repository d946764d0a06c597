// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/toml_depth.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace plekton::apps::toml_depth_test {
namespace {

/// A key of this many parts.
std::string key_of(int parts) {
  std::string key = "k";
  for (int i = 1; i < parts; ++i) key += ".k";
  return key;
}

TEST(KeyOfMoreParts, FindsKeysWhereverTomlHasThem) {
  const std::string four = key_of(4);
  for (const std::string& text : std::vector<std::string>{
           four + " = 1", "[" + four + "]", "[[" + four + "]]", "a = { " + four + " = 1 }",
           "a = [1, { " + four + " = 1 }]", "k . k\t. k .k = 1", "\"k\".'k'.k.\"\" = 1",
           "ü.ü.ü.ü = 1", "\"a.b\\\"\" = 1\n" + four + " = 2"}) {
    EXPECT_TRUE(key_of_more_parts(text, 3)) << text;
    EXPECT_FALSE(key_of_more_parts(text, 4)) << text;
  }
}

TEST(KeyOfMoreParts, CountsNoDotsOfTextsNumbersAndComments) {
  const std::string four = key_of(4);
  for (const std::string& text : std::vector<std::string>{
           "# " + four, "a = \"" + four + "\"", "a = '" + four + "'",
           "a = \"\"\"\n" + four + "\n\"\"\"", "a = '''\n" + four + "\n'''",
           "a = \"\\\"" + four + "\"", "a = \"\"\"\"" + four + "\\\"\"\" " + four + "\"\"\"\"\"",
           "a = [1.0, 2.0, 3.0, 4.0]", "a.b = 1\nc.d = 2\ne.f = 3.0", "a = \"\" # " + four}) {
    EXPECT_FALSE(key_of_more_parts(text, 3)) << text;
  }
}

TEST(KeyOfMoreParts, FindsAKeyBehindATextThatEndsInQuotes) {
  for (const std::string text :
       {"\"\"", "\"a\"", "\"\"\"a\"\"\"\"", "\"\"\"a\"\"\"\"\"", "'''a'''''", "\"a\\\\\"", "'a\\'",
        "\"\"\"\"\"\"", "\"\"\"a\\\"\"\"\""})
    EXPECT_TRUE(key_of_more_parts("a = { b = " + text + ", " + key_of(4) + " = 1 }", 3)) << text;
}

TEST(KeyOfMoreParts, SaysWhereTheKeyBegins) {
  const auto place = key_of_more_parts("a = '''\n\n'''\n\n  [" + key_of(5) + "]\n", 3);

  ASSERT_TRUE(place);
  EXPECT_EQ(place->line, 5);
  EXPECT_EQ(place->column, 4);
}

TEST(KeyOfMoreParts, TakesAnyTextThatIsNoToml) {
  for (const std::string text : {"", "\"", "'''", "\"\"\"\\", "\"\\", "....", "a = '\n.....", "\\"})
    EXPECT_NO_FATAL_FAILURE(key_of_more_parts(text, 3)) << text;
}

}  // namespace
}  // namespace plekton::apps::toml_depth_test
