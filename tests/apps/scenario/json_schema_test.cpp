// SPDX-License-Identifier: GPL-3.0-or-later
// The schema of scenarios by itself; schema_test.py puts scenarios to it.
#include "apps/scenario/json_schema.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace plekton::apps::json_schema_test {
namespace {

using Json = nlohmann::ordered_json;

Json property(const Json& table, const std::string& key) {
  return table.at("properties").at(key);
}

TEST(ScenarioSchema, HasRangesAndDefaultsInSiUnits) {
  const Json simulation = property(scenario_schema(), "simulation");

  EXPECT_EQ(property(simulation, "damping").at("default"), 0);
  EXPECT_EQ(property(simulation, "damping").at("anyOf").at(0),
            Json::parse(R"({"type": "number", "minimum": 0.0, "exclusiveMaximum": 1.0})"));
  EXPECT_EQ(property(simulation, "gravity").at("default"), Json::parse("[0, 0, -9.81]"));
  EXPECT_EQ(property(simulation, "time_step").at("anyOf").at(2),
            Json::parse(R"({"enum": ["auto"]})"));
  EXPECT_EQ(simulation.at("additionalProperties"), false);
}

TEST(ScenarioSchema, AsksForADurationWhereThereAreNoStages) {
  const Json schema = scenario_schema();

  EXPECT_EQ(schema.at("if"), Json::parse(R"({"not": {"required": ["stages"]}})"));
  EXPECT_EQ(property(schema.at("then"), "simulation").at("required"),
            Json::parse(R"(["duration"])"));
}

TEST(ScenarioSchema, TakesAnyPartOfATableInAStage) {
  const Json stage = property(scenario_schema(), "stages").at("items");

  const Json planes = property(stage, "planes").at("items");
  for (const Json& plane : planes.at("anyOf")) {
    EXPECT_FALSE(plane.contains("required"));
    EXPECT_EQ(plane.at("additionalProperties"), false);
  }
  EXPECT_TRUE(property(stage, "loads").at("items").contains("anyOf"));
}

TEST(ScenarioSchema, HasOneAlternativeForEachKindOfATable) {
  const Json loads = property(scenario_schema(), "loads").at("items").at("oneOf");

  ASSERT_EQ(loads.size(), 9U);
  for (const Json& load : loads) {
    EXPECT_TRUE(property(load, "kind").contains("const"));
    EXPECT_THAT(load.at("required"), testing::Contains("kind"));
  }
}

TEST(ScenarioSchema, TakesAPlaneAsFlatWhereNoKindIsNamed) {
  const Json planes = property(scenario_schema(), "planes").at("items").at("oneOf");

  EXPECT_THAT(planes.at(0).at("required"), testing::Not(testing::Contains("kind")));
  EXPECT_THAT(planes.at(1).at("required"), testing::Contains("kind"));
}

TEST(ScenarioSchema, TakesTheFirstLawWhereNoneIsNamed) {
  const Json laws = property(scenario_schema(), "contacts").at("items").at("oneOf");

  EXPECT_THAT(laws.at(0).at("required"), testing::Not(testing::Contains("law")));
  EXPECT_THAT(laws.at(1).at("required"), testing::Contains("law"));
}

TEST(ScenarioSchema, AsksForKeysOfAnOptionalTableOnlyInIt) {
  const Json membrane = property(scenario_schema(), "membranes").at("items");

  EXPECT_EQ(property(membrane, "rotate").at("required"), Json::parse(R"(["angle"])"));
  EXPECT_THAT(membrane.at("required"), testing::Not(testing::Contains("rotate")));
}

TEST(ScenarioSchema, AsksForNoMembraneWhereATieMayHoldARigidBody) {
  const Json ties = property(scenario_schema(), "ties").at("items");

  const Json ends = property(ties, "to");
  for (const Json& to : ends.at("oneOf")) {
    if (to.at("properties").contains("rigid_body") && to.at("properties").contains("membrane")) {
      EXPECT_EQ(to.at("required"), Json::parse(R"(["kind"])"));
    }
  }
  EXPECT_FALSE(property(ties, "from").contains("required"));
}

TEST(ScenarioSchema, AsksForTheRigidBodyOnWhichATieHoldsNodes) {
  const Json ties = property(scenario_schema(), "ties").at("items");

  const Json kinds = property(ties, "to").at("oneOf");
  const auto body = std::ranges::find_if(
      kinds, [](const Json& to) { return property(to, "kind").at("const") == "body"; });
  ASSERT_NE(body, kinds.end());
  EXPECT_THAT(body->at("required"), testing::UnorderedElementsAre("kind", "rigid_body"));
  EXPECT_FALSE(body->at("properties").contains("membrane"));
}

TEST(ScenarioSchema, SaysWhatEveryKeyMeans) {
  const Json grains = property(scenario_schema(), "grains").at("items");

  for (const auto& [name, key] : grains.at("properties").items()) {
    if (key.contains("properties") || key.contains("oneOf")) continue;
    EXPECT_TRUE(key.contains("description") || key.contains("items")) << name;
  }
}

}  // namespace
}  // namespace plekton::apps::json_schema_test
