// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/stress/shrink.hpp"

#include <gtest/gtest.h>

namespace plekton::stress::shrink_test {
namespace {

const SceneText kScene = taken_apart(
    "[simulation]\nduration = 0.08\ngravity = [0, 0, 0]\n[[grains]]\ncount = 20\nname = \"a\"\n"
    "[[planes]]\npoint = [0, 0, 0]\n[[membranes]]\ncells = [8, 4]\n");

TEST(Shrink, LeavesOnlyWhatTheFailureNeeds) {
  const auto fails = [](const SceneText& scene) {
    return scene.text().find("point =") != std::string::npos;
  };

  EXPECT_EQ(shrunk(kScene, fails).text(), "[[planes]]\npoint = [0, 0, 0]\n");
}

TEST(Shrink, HalvesTheDurationAndWholeNumbers) {
  const auto fails = [](const SceneText& scene) {
    SceneText copy = scene;
    const std::string* const duration = find_value(copy, "[simulation]", "duration");
    const std::string* const count = find_value(copy, "[[grains]]", "count");
    return duration != nullptr && std::stod(*duration) > 0.015 && count != nullptr &&
           std::stoi(*count) > 4;
  };

  EXPECT_EQ(shrunk(kScene, fails).text(), "[simulation]\nduration = 0.02\n[[grains]]\ncount = 5\n");
}

TEST(Shrink, LeavesAloneWhatDoesNotFailAnyMore) {
  const auto fails = [](const SceneText& scene) { return scene.text() == kScene.text(); };

  EXPECT_EQ(shrunk(kScene, fails).text(), kScene.text());
}

}  // namespace
}  // namespace plekton::stress::shrink_test
