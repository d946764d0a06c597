// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes of YADE's shipped examples as YADE 2023.02a tells them at iteration 0
// (compare_with_yade.py --record), so that what it really exports is read without it.
#include "apps/run/run.hpp"
#include "apps/scenario/scenario_reader.hpp"
#include "apps/takeover/scenario_text.hpp"
#include "apps/takeover/yade_scene.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace plekton::apps::yade::recorded_scenes_test {
namespace {

Scene recorded_scene(const std::string& name) {
  return parse_scene(test::bytes_of(std::filesystem::path(PLEKTON_SOURCE_DIR) /
                                    "tests/apps/takeover/recorded" / (name + ".json")));
}

/// Those that have a mass and may move.
std::vector<Body> bodies_of(const Scene& scene) {
  std::vector<Body> bodies(scene.spheres.begin(), scene.spheres.end());
  bodies.insert(bodies.end(), scene.nodes.begin(), scene.nodes.end());
  return bodies;
}

class RecordedScene : public testing::TestWithParam<const char*> {};

TEST_P(RecordedScene, BecomesASceneWithTheSameBodiesInTheSamePlaces) {
  const Scene scene = recorded_scene(GetParam());
  TakeoverOptions options;
  options.script = std::string(GetParam()) + ".py";
  options.has_chosen_step = true;

  const Takeover takeover = take_over(scene, options);
  const PreparedRun run = prepare_run(parse_scenario(takeover.scenario, "taken.toml"));

  const auto& x = run.simulation->state().position;
  const auto& masses = run.simulation->properties().mass;
  std::vector<Body> missing = bodies_of(scene);
  ASSERT_EQ(x.size(), missing.size());
  for (std::size_t node = 0; node < x.size(); ++node) {
    const auto same = [&](const Body& body) { return body.position == x[node]; };
    const auto body = std::find_if(missing.begin(), missing.end(), same);
    ASSERT_NE(body, missing.end()) << "node " << node;
    EXPECT_NEAR(masses[node], body->mass, 1e-6 * body->mass) << "body " << body->id;
    missing.erase(body);
  }
  EXPECT_EQ(run.simulation->planes().size(), scene.walls.size());
  EXPECT_EQ(run.simulation->elements().facets.size(), scene.pfacets.size());
}

INSTANTIATE_TEST_SUITE_P(OfYade, RecordedScene,
                         testing::Values("pfacetcreators", "CohesiveGridConnectionSphere",
                                         "cylinder-cylinder"),
                         [](const auto& scene) {
                           std::string name = scene.param;
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace plekton::apps::yade::recorded_scenes_test
