// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/stress/random_scene.hpp"

#include "apps/scenario/scenario_reader.hpp"
#include "contact/law_list.hpp"

#include <gtest/gtest.h>

#include <string>

namespace plekton::stress::random_scene_test {
namespace {

constexpr std::uint64_t kScenes = 300;

TEST(RandomScene, IsTheSameForTheSameSeedAndNumber) {
  EXPECT_EQ(random_scene(3, 7).text(), random_scene(3, 7).text());
  EXPECT_NE(random_scene(3, 7).text(), random_scene(3, 8).text());
  EXPECT_NE(random_scene(3, 7).text(), random_scene(4, 7).text());
}

/// A scene that the reader refuses checks little.
TEST(RandomScene, IsReadWithoutAProblemAsARule) {
  std::uint64_t refused = 0;
  std::string example;
  for (std::uint64_t i = 0; i < kScenes; ++i) {
    try {
      apps::parse_scenario(random_scene(1, i).text(), "scene.toml");
    } catch (const apps::InputError& error) {
      ++refused;
      example = error.what();
    }
  }

  EXPECT_LT(refused, kScenes / 20) << example;
}

TEST(RandomScene, HasEveryShapeModeLawAndLoad) {
  std::string all;
  for (std::uint64_t i = 0; i < kScenes; ++i) all += random_scene(1, i).text();

  for (const char* const word : {"sheet",
                                 "tube",
                                 "sphere",
                                 "box",
                                 "biaxial_geogrid",
                                 "uniaxial_geogrid",
                                 "hexagonal_net",
                                 "ring_net",
                                 "sheet_damping",
                                 "chain",
                                 "lattice",
                                 "truss",
                                 "continuum",
                                 "motion",
                                 "force",
                                 "pressure",
                                 "servo",
                                 "gravity",
                                 "ground_springs",
                                 "beam_damping",
                                 "mass_damping",
                                 "plane",
                                 "support",
                                 "contacts",
                                 "nodes"})
    EXPECT_NE(all.find('"' + std::string(word) + '"'), std::string::npos) << word;
  for (const contact::LawEntry& law : contact::contact_laws())
    EXPECT_NE(all.find('"' + std::string(law.name) + '"'), std::string::npos) << law.name;
  EXPECT_NE(all.find("prestrain ="), std::string::npos);
}

}  // namespace
}  // namespace plekton::stress::random_scene_test
