// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/stress/scene_text.hpp"

#include <gtest/gtest.h>

namespace plekton::stress::scene_text_test {
namespace {

TEST(SceneText, IsTakenApartIntoTablesAndKeysAndPutTogetherAgain) {
  const std::string text =
      "[simulation]\nduration = 0.1\n[[grains]]\nname = \"a # b\"\ncentres = [[1, 2, 3]]\n";

  EXPECT_EQ(taken_apart(text).text(), text);
}

TEST(SceneText, LeavesCommentsOutAndJoinsValuesOverLines) {
  const SceneText scene =
      taken_apart("# a scene\n[a]\nx = [1,  # one\n  2]\n\ny = '#'  # a sign\n");

  EXPECT_EQ(scene.text(), "[a]\nx = [1, 2]\ny = '#'\n");
}

TEST(SceneText, BeginsWithItsNote) {
  EXPECT_EQ(taken_apart("[a]\nx = 1\n").text("one\ntwo"), "# one\n# two\n[a]\nx = 1\n");
}

TEST(SceneText, FindsTheValueOfAKey) {
  SceneText scene = taken_apart("[a]\nx = 1\n[b]\nx = 2\n");

  ASSERT_NE(find_value(scene, "[b]", "x"), nullptr);
  EXPECT_EQ(*find_value(scene, "[b]", "x"), "2");
  EXPECT_EQ(find_value(scene, "[b]", "y"), nullptr);
}

}  // namespace
}  // namespace plekton::stress::scene_text_test
