// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/enclosed_bodies.hpp"

#include "apps/scenario/scenario_reader.hpp"

#include <gmock/gmock.h>

namespace plekton::apps::enclosed_bodies_test {
namespace {

constexpr std::string_view kScene = R"([simulation]
duration = "1 ms"
[materials.stuff]
density = 1000
young_modulus = 1e7
friction_angle = 0.5
[[membranes]]
name = "open"
shape = { kind = "sheet", width = 0.02, length = 0.02, cells = [1, 1] }
thickness = 1e-3
material = "stuff"
young_modulus = 1e7
density = 1000
[[membranes]]
name = "box"
shape = { kind = "box", size = [0.1, 0.1, 0.1], cells = [2, 2, 2] }
translate = [-0.05, -0.05, -0.05]
thickness = 1e-3
material = "stuff"
young_modulus = 1e7
density = 1000
[[grains]]
name = "before"
material = "stuff"
radius = 1e-3
centres = [[0.2, 0, 0]]
[[grains]]
name = "some"
material = "stuff"
radius = 1e-3
centres = [[0, 0, 0.03], [0.01, 0, 0.03], [0, 0, 0.06]]
)";

TEST(EnclosedBodies, AreCountedByGrainsAndNodes) {
  const PreparedRun prepared = prepare_run(parse_scenario(kScene, "scene.toml"));
  const std::vector<EnclosedBody> bodies = enclosed_bodies(prepared);

  EXPECT_EQ(listing_of(bodies),
            "inside at the start: 4 of 4 nodes of membranes.open in membranes.box\n"
            "inside at the start: 2 of 3 grains of grains.some in membranes.box\n");
}

TEST(EnclosedBodies, AreNoneWithoutAClosedMembrane) {
  const std::string text(kScene);
  const std::size_t box = text.rfind("[[membranes]]");
  const std::string open = text.substr(0, box) + text.substr(text.find("[[grains]]"));

  EXPECT_TRUE(enclosed_bodies(prepare_run(parse_scenario(open, "scene.toml"))).empty());
}

}  // namespace
}  // namespace plekton::apps::enclosed_bodies_test
