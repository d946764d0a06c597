// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/enclosed_bodies.hpp"

#include "apps/run/run.hpp"
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
  const std::vector<EnclosedBody> bodies =
      enclosed_bodies(prepared.built, prepared.simulation->scene());

  EXPECT_EQ(listing_of(bodies),
            "inside at the start: 4 of 4 nodes of membranes.open in membranes.box\n"
            "inside at the start: 2 of 3 grains of grains.some in membranes.box\n");
}

TEST(EnclosedBodies, AreNoGrainsThatComeBeforeWhatHoldsThem) {
  std::string scene(kScene);
  scene.erase(scene.find("duration"), std::string_view("duration = \"1 ms\"\n").size());
  scene.erase(scene.find("[[grains]]"));
  const std::size_t box = scene.rfind("[[membranes]]");
  const std::string bag = scene.substr(box);
  const std::string grains =
      "[[grains]]\nname = \"held\"\nmaterial = \"stuff\"\nradius = 1e-3\ncount = 5\n"
      "inside = \"box\"\n";
  const std::string text = scene.substr(0, box) + grains +
                           "[[stages]]\nname = \"a\"\nend = { duration = 1e-3 }\n"
                           "[[stages]]\nname = \"b\"\nend = { duration = 1e-3 }\n[[stages." +
                           bag.substr(2);

  EXPECT_THAT([&] { prepare_run(parse_scenario(text, "scene.toml").stages[0]); },
              testing::ThrowsMessage<InputError>(
                  testing::HasSubstr("inside: \"box\" is not there in this stage")));
}

TEST(EnclosedBodies, AreNoneWithoutAClosedMembrane) {
  const std::string text(kScene);
  const std::size_t box = text.rfind("[[membranes]]");
  const std::string open = text.substr(0, box) + text.substr(text.find("[[grains]]"));

  const PreparedRun prepared = prepare_run(parse_scenario(open, "scene.toml"));
  EXPECT_TRUE(enclosed_bodies(prepared.built, prepared.simulation->scene()).empty());
}

// Its facets were taken from those of what is there.
TEST(EnclosedBodies, AreNoneOfBodiesThatComeLater) {
  std::string scene(kScene);
  scene.erase(scene.find("duration"), std::string_view("duration = \"1 ms\"\n").size());
  const PreparedRun prepared = prepare_run(parse_scenario(scene + R"(
[[stages]]
name = "a"
end = { duration = 1e-3 }
[[stages]]
name = "b"
end = { duration = 1e-3 }
[[stages.rigid_bodies]]
name = "lid"
shape = { kind = "box", size = [2, 2, 2] }
translate = [-1, -1, -1]
thickness = 1e-3
material = "stuff"
hold = "xyz"
hold_rotation = "xyz"
)",
                                                          "scene.toml"));

  EXPECT_EQ(listing_of(enclosed_bodies(prepared.built, prepared.simulation->scene())),
            "inside at the start: 4 of 4 nodes of membranes.open in membranes.box\n"
            "inside at the start: 2 of 3 grains of grains.some in membranes.box\n");
}

/// A box of 0.1 m about the origin with a sheet of 0.02 m and two of three grains inside, as rigid
/// body. @param keys  of it
std::vector<std::string> warnings_with_rigid_box(const std::string& keys) {
  std::string text(kScene);
  const std::size_t box = text.rfind("[[membranes]]");
  const std::size_t grains = text.find("[[grains]]");
  text = text.substr(0, box) + R"([[rigid_bodies]]
name = "box"
shape = { kind = "box", size = [0.1, 0.1, 0.1], cells = [2, 2, 2] }
translate = [-0.05, -0.05, -0.05]
thickness = 1e-3
material = "stuff"
)" + keys +
         text.substr(grains);
  return prepare_run(parse_scenario(text, "scene.toml")).built.warnings;
}

// A boulder in millimetres swallowed a net, and nothing was told.
TEST(EnclosedBodies, AreAWarningWhollyInASolid) {
  using testing::AllOf;
  using testing::ElementsAre;
  using testing::HasSubstr;
  const auto is_told =
      ElementsAre(AllOf(HasSubstr("all 4 nodes of membranes.open (0.02 m x 0.02 m x 0 m) begin "
                                  "inside of rigid_bodies.box (0.1 m x 0.1 m x 0.1 m)"),
                        HasSubstr("scale (0.001")));
  EXPECT_THAT(warnings_with_rigid_box("density = 1000\n"), is_told);
  EXPECT_THAT(warnings_with_rigid_box("mass = 1\nfilling = \"solid\"\n"), is_told);

  EXPECT_THAT(warnings_with_rigid_box("density = 1000\nfilling = \"shell\"\n"), ElementsAre());
  EXPECT_THAT(warnings_with_rigid_box("hold = \"xyz\"\nhold_rotation = \"xyz\"\n"), ElementsAre());
}

}  // namespace
}  // namespace plekton::apps::enclosed_bodies_test
