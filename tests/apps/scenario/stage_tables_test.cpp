// SPDX-License-Identifier: GPL-3.0-or-later
// What each stage of a scenario is as a scenario of its own.
#include "apps/scenario/stage_tables.hpp"

#include "apps/scenario/scenario_reader.hpp"
#include "apps/scenario/staged_scenario.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>

namespace plekton::apps::stage_tables_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kDegree = std::numbers::pi / 180.0;

constexpr const char* kScenario = R"([simulation]
damping = 0.1
[materials.sand]
density = 2650
young_modulus = 1e7
friction_angle = "30 deg"
[[grains]]
name = "first"
material = "sand"
radius = 0.01
centres = [[0, 0, 0.02]]
[[planes]]
name = "floor"
point = [0, 0, 0]
material = "sand"
[[planes]]
name = "wall"
point = [-1, 0, 0]
normal = [1, 0, 0]
material = "sand"
[[loads]]
name = "push"
kind = "force"
grains = "first"
force = [1, 0, 0]
[output]
interval = 0.25
)";

constexpr const char* kStages = R"([[stages]]
name = "a"
end = { duration = 1 }
materials.sand.friction_angle = "5 deg"
[[stages]]
name = "b"
max_duration = 2
end = { kinetic_energy = 1e-6 }
simulation.damping = 0.5
remove = [{ plane = "floor" }]
[[stages.planes]]
name = "lid"
point = [0, 0, 1]
normal = [0, 0, -1]
material = "sand"
[[stages.planes]]
name = "wall"
point = [-2, 0, 0]
[[stages]]
name = "c"
end = { duration = 3 }
materials.sand.friction_angle = "20 deg"
output.interval = 0.5
[[stages.loads]]
name = "push"
force = [2, 0, 0]
[[stages.loads]]
kind = "gravity"
factor = [[0, 1]]
[[stages.grains]]
name = "second"
material = "sand"
radius = 0.01
centres = [[0.5, 0, 0.02]]
[[stages]]
name = "d"
end = { duration = 4 }
output.interval = 1
)";

Scenario parsed(const std::string& stages) {
  return parse_scenario(kScenario + stages, "case.toml");
}

class StageTables : public testing::Test {
 protected:
  const Scenario scenario_ = parsed(kStages);
  const std::vector<Scenario>& stages_ = scenario_.stages;
};

TEST_F(StageTables, ChangeNumbersFromThereOn) {
  ASSERT_EQ(stages_.size(), 4U);
  const auto friction = [&](std::size_t k) { return stages_[k].materials[0].friction_angle; };
  EXPECT_DOUBLE_EQ(friction(0), 5 * kDegree);
  EXPECT_DOUBLE_EQ(friction(1), 5 * kDegree);
  EXPECT_DOUBLE_EQ(friction(2), 20 * kDegree);
  EXPECT_EQ(stages_[0].simulation.damping, 0.1);
  EXPECT_EQ(stages_[1].simulation.damping, 0.5);
  EXPECT_EQ(stages_[3].simulation.damping, 0.5);
  EXPECT_EQ(stages_[1].output.interval, 0.25);
  EXPECT_EQ(stages_[2].output.interval, 0.5);
}

TEST_F(StageTables, HaveDurationsFromTheirEndsAndIntervalsFromThese) {
  EXPECT_EQ(stages_[0].simulation.duration, 1.0);
  EXPECT_EQ(stages_[1].simulation.duration, 2.0);
  EXPECT_EQ(stages_[1].output.history_interval, 2e-3);
  EXPECT_EQ(stages_[1].stage->longest(), 2.0);
}

TEST_F(StageTables, AddChangeAndTakeOutPlanesThatGoOnFromWhereTheyAre) {
  const auto names = [&](std::size_t k) {
    std::vector<std::string> of_stage;
    for (const PlaneSettings& plane : stages_[k].planes) of_stage.push_back(plane.name);
    return of_stage;
  };
  EXPECT_THAT(names(0), ElementsAre("floor", "wall"));
  EXPECT_THAT(names(1), ElementsAre("wall", "lid"));
  EXPECT_THAT(stages_[1].stage->origins.planes, ElementsAre(1, -1));
  EXPECT_THAT(stages_[1].stage->origins.moved_planes, ElementsAre(true, true));
  EXPECT_EQ(stages_[1].planes[0].point, Vec3(-2, 0, 0));
  EXPECT_THAT(stages_[2].stage->origins.planes, ElementsAre(0, 1));
  EXPECT_THAT(stages_[2].stage->origins.moved_planes, ElementsAre(false, false));
  EXPECT_THAT(plane_names(stages_[0]), ElementsAre("floor", "wall", "lid"));
  EXPECT_THAT(plane_numbers(stages_[1]), ElementsAre(1U, 2U));
}

constexpr const char* kUnnamed = R"([[planes]]
point = [-7, 0, 0]
normal = [1, 0, 0]
material = "sand"
[[loads]]
kind = "force"
grains = "first"
force = [0, 1, 0]
[[stages]]
name = "a"
end = { duration = 1 }
[[stages]]
name = "b"
end = { duration = 1 }
remove = [{ plane = "floor" }, { load = "push" }]
[[stages.planes]]
point = [7, 0, 0]
normal = [-1, 0, 0]
material = "sand"
[[stages.loads]]
kind = "force"
grains = "first"
force = [0, 2, 0]
)";

// The plane at -7 m went on as planes[1], the column of another one, and the load as "loads 0".
TEST(StageTable, CallsWhatHasNoNameTheSameInAllStages) {
  const Scenario scenario = parsed(kUnnamed);
  const std::vector<Scenario>& stages = scenario.stages;

  EXPECT_THAT(plane_names(scenario), ElementsAre("floor", "wall", "planes[2]", "planes[3]"));
  EXPECT_THAT(plane_numbers(stages[0]), ElementsAre(0U, 1U, 2U));
  EXPECT_THAT(plane_numbers(stages[1]), ElementsAre(1U, 2U, 3U));
  EXPECT_EQ(stages[1].planes[1].point, Vec3(-7, 0, 0));
  EXPECT_EQ(stages[1].planes[1].path(), "planes[2]");
  ASSERT_EQ(stages[1].loads.size(), 2U);
  EXPECT_EQ(stages[0].loads[1].name, "loads 1");
  EXPECT_EQ(stages[1].loads[0].name, "loads 1");
  EXPECT_EQ(stages[1].loads[1].name, "loads 2");
}

/// Pressures have columns of their own.
TEST(StageTable, CallsPressuresWithoutANameTheSameInAllStages) {
  const auto bag = [](const std::string& name) {
    return "[[membranes]]\nname = \"" + name +
           "\"\nshape = { kind = \"sheet\", width = 1, length = 1, cells = [2, 2] }\n"
           "mode = \"truss\"\nthickness = 0.01\nmaterial = \"sand\"\nyoung_modulus = 1e6\n"
           "density = 1000\n[[loads]]\nkind = \"pressure\"\nmembrane = \"" +
           name + "\"\npressure = 1\n";
  };
  const Scenario scenario = parsed(bag("one") + bag("two") +
                                   "[[stages]]\nname = \"a\"\nend = { duration = 1 }\n"
                                   "[[stages]]\nname = \"b\"\nend = { duration = 1 }\n"
                                   "remove = [{ load = \"push\" }]\n");

  EXPECT_THAT(scenario.names_of_stages.pressures,
              ElementsAre(PressureColumn{"loads 1", false}, PressureColumn{"loads 2", false}));
}

TEST(StageTable, RefusesANameThatAnotherOneIsCalledWithoutAName) {
  const std::string plane = "material = \"sand\"\npoint = [0, 0, -3]\n";
  const std::string stages =
      "[[stages]]\nname = \"a\"\nend = { duration = 1 }\n[[stages]]\nname = \"b\"\n"
      "end = { duration = 1 }\n";
  const auto named = [&](const std::string& name) {
    return "[[planes]]\nname = \"" + name + "\"\n" + plane;
  };

  EXPECT_THAT(
      [&] { parsed(named("planes[3]") + "[[planes]]\n" + plane + stages); },
      ThrowsMessage<InputError>(HasSubstr("planes[3].name: missing, and without one it is "
                                          "called \"planes[3]\", as another one is named")));
  EXPECT_THAT([&] { parsed("[[planes]]\n" + plane + named("planes[2]") + stages); },
              ThrowsMessage<InputError>(HasSubstr("\"planes[2]\" has this name already")));
  EXPECT_THAT(
      [&] {
        parsed(named("planes[3]") + stages +
               "remove = [{ plane = \"planes[3]\" }]\n[[stages.planes]]\n" + plane);
      },
      ThrowsMessage<InputError>(HasSubstr("stages.b.planes: without a name it is called "
                                          "\"planes[3]\", as one was that is taken out")));
  EXPECT_NO_THROW(parsed(named("planes[7]") + "[[planes]]\n" + plane + stages));
}

TEST_F(StageTables, BeginLoadsWhereTheyAreNamed) {
  EXPECT_THAT(stages_[1].stage->origins.loads, ElementsAre(0U));
  EXPECT_THAT(stages_[2].stage->origins.loads, ElementsAre(2U, 2U));
  EXPECT_THAT(stages_[3].stage->origins.loads, ElementsAre(2U, 2U));
  EXPECT_EQ(std::get<ForceSettings>(stages_[2].loads[0].load).load.force, Vec3(2, 0, 0));
}

TEST_F(StageTables, BringGrainsAfterThoseThatAreThere) {
  EXPECT_EQ(stages_[1].grains.size(), 1U);
  ASSERT_EQ(stages_[2].grains.size(), 2U);
  EXPECT_EQ(stages_[2].grains[1].name, "second");
  EXPECT_EQ(stages_[3].grains.size(), 2U);
}

TEST_F(StageTables, KnowWhereNothingChangesButWhatIsWritten) {
  EXPECT_FALSE(stages_[0].stage->origins.changes_nothing);
  EXPECT_FALSE(stages_[1].stage->origins.changes_nothing);
  EXPECT_FALSE(stages_[2].stage->origins.changes_nothing);
  EXPECT_TRUE(stages_[3].stage->origins.changes_nothing);
}

TEST(StageTable, LeavesAScenarioWithoutStagesAsItIs) {
  std::string text(kScenario);
  text.replace(text.find("damping"), 0, "duration = 1\n");
  const Scenario scenario = parse_scenario(text, "case.toml");

  EXPECT_TRUE(scenario.stages.empty());
  EXPECT_FALSE(scenario.stage);
  EXPECT_THAT(plane_names(scenario), ElementsAre("floor", "wall"));
}

TEST(StageTable, TellsEveryProblemOnceWithItsPlace) {
  EXPECT_THAT([] { parsed("[[stages]]\nname = \"a\"\nend = { duration = 1, durration = 2 }\n"); },
              ThrowsMessage<InputError>(HasSubstr("durration")));
  EXPECT_THAT([] { parsed("[[stages]]\nend = { duration = 1 }\n"); },
              ThrowsMessage<InputError>(HasSubstr("stages[0].name: missing")));
  EXPECT_THAT(
      [] { parsed("[[stages]]\nname = \"a\"\nend = { duration = 1 }\nsimulation.seed = 2\n"); },
      ThrowsMessage<InputError>(HasSubstr("stages.a.simulation.seed: is the same in all stages")));
  EXPECT_THAT(
      [] {
        parsed(
            "[stop]\nkinetic_energy = 1\n[[stages]]\nname = \"a\"\nend = { duration "
            "= 1 }\n[[stages]]\nname = \"b\"\nend = { duration = 1 }\n");
      },
      ThrowsMessage<InputError>(HasSubstr("stop: does not go with stages")));
}

// What was no list was dropped without a word where a stage had one.
TEST(StageTable, RefusesATableWhereAListOfTablesIsExpected) {
  const std::string body =
      "name = \"lid\"\nmaterial = \"sand\"\nspheres = [{ centre = [0, 0, 1], radius "
      "= 0.1 }]\ndensity = 2600\n";
  EXPECT_THAT(
      [&] {
        parsed("[rigid_bodies]\n" + body + "[[stages]]\nname = \"a\"\nend = { duration = 1 }\n" +
               "[[stages.rigid_bodies]]\nname = \"other\"\n" + body.substr(body.find('\n') + 1));
      },
      ThrowsMessage<InputError>(HasSubstr(
          "rigid_bodies: got a table; expected a list of tables, each under [[rigid_bodies]]")));
}

TEST(StageTable, HasTheBodiesOfAllStagesAndKnowsWhichAreThere) {
  const std::string stone =
      "name = \"stone\"\nmaterial = \"sand\"\nspheres = [{ centre = [0, 0, 1], radius = 0.1 "
      "}]\ndensity = 2600\n";
  const Scenario scenario = parsed(
      "[[stages]]\nname = \"a\"\nend = { duration = 1 }\n"
      "[[stages]]\nname = \"b\"\nend = { duration = 1 }\n[[stages.rigid_bodies]]\n" +
      stone +
      "[[stages]]\nname = \"c\"\nend = { duration = 1 }\n[[stages.rigid_bodies]]\nname = "
      "\"stone\"\nhold = \"xy\"\n"
      "[[stages]]\nname = \"d\"\nend = { duration = 1 }\nremove = [{ rigid_body = \"stone\" }]\n");
  const std::vector<bool> absent = {true, false, false, true};
  for (std::size_t k = 0; k < 4; ++k) {
    ASSERT_EQ(scenario.stages[k].rigid_bodies.size(), 1U);
    EXPECT_EQ(scenario.stages[k].rigid_bodies[0].is_absent, absent[k]) << k;
    EXPECT_EQ(scenario.stages[k].grains[0].is_absent, absent[k]) << k;
  }
  EXPECT_EQ(scenario.stages[1].rigid_bodies[0].held, dynamics::Held::nothing);
  EXPECT_EQ(scenario.stages[2].rigid_bodies[0].held,
            dynamics::Held::along_x | dynamics::Held::along_y);
}

// The one became free and fell, unseen; of the others the second was passed over.
TEST(StageTable, RefusesBodiesThatWereTakenOutAndTwoOfOneName) {
  const std::string lid =
      "name = \"lid\"\nmaterial = \"sand\"\nspheres = [{ centre = [0, 0, 1], radius = 0.1 "
      "}]\ndensity = 2600\n";
  const std::string stages =
      "[[stages]]\nname = \"a\"\nend = { duration = 1 }\n[[stages]]\nname = \"b\"\n"
      "end = { duration = 1 }\n";
  const std::string gone =
      "[[rigid_bodies]]\n" + lid + stages + "remove = [{ rigid_body = \"lid\" }]\n";

  EXPECT_THAT(
      [&] {
        parsed(gone + "[[stages]]\nname = \"c\"\nend = { duration = 1 }\n" +
               "[[stages.rigid_bodies]]\nname = \"lid\"\nhold = \"\"\n");
      },
      ThrowsMessage<InputError>(HasSubstr("stages.c.rigid_bodies: what has this name was taken out "
                                          "and does not come back")));
  EXPECT_THAT(
      [&] { parsed(gone + "[[stages.rigid_bodies]]\nname = \"lid\"\nhold = \"x\"\n"); },
      ThrowsMessage<InputError>(HasSubstr("stages.b.rigid_bodies: what has this name was taken")));
  EXPECT_THAT(
      [&] {
        parsed(stages + "[[stages.rigid_bodies]]\n" + lid + "[[stages.rigid_bodies]]\n" + lid);
      },
      ThrowsMessage<InputError>(
          HasSubstr("stages.b.rigid_bodies: two tables of this stage have this name")));
}

TEST(StageTable, TakesReactionsOutWithWhatTheyAreOfAndKeepsTheirColumns) {
  const Scenario scenario = parsed(
      "[[output.reactions]]\nkind = \"plane\"\nplane = \"floor\"\n"
      "[[output.reactions]]\nkind = \"plane\"\nplane = \"wall\"\n"
      "[[output.reactions]]\nname = \"on the stone\"\nkind = \"contacts\"\nrigid_body = \"stone\"\n"
      "[[output.measures]]\nname = \"all\"\nbetween = [\"floor\", \"wall\"]\n"
      "[[output.measures]]\nname = \"over\"\nbetween = [\"floor\"]\n"
      "[[rigid_bodies]]\nname = \"stone\"\nmaterial = \"sand\"\ndensity = 2600\n"
      "spheres = [{ centre = [0, 0, 1], radius = 0.1 }]\n"
      "[[stages]]\nname = \"a\"\nend = { duration = 1 }\n"
      "[[stages]]\nname = \"b\"\nend = { duration = 1 }\n"
      "remove = [{ plane = \"floor\" }, { rigid_body = \"stone\" }]\n"
      "[[stages]]\nname = \"c\"\nend = { duration = 1 }\n"
      "[[stages.output.reactions]]\nname = \"grains\"\nkind = \"contacts\"\ngrains = \"first\"\n");
  const std::vector<Scenario>& stages = scenario.stages;
  const auto names = [&](std::size_t k) {
    std::vector<std::string> of_stage;
    for (const ReactionSettings& one : stages[k].output.reactions) of_stage.push_back(one.name);
    return of_stage;
  };

  EXPECT_THAT(names(0), ElementsAre("floor", "wall", "on the stone"));
  EXPECT_THAT(names(1), ElementsAre("wall"));
  EXPECT_EQ(stages[1].output.reactions[0].plane, 0U);
  EXPECT_THAT(names(2), ElementsAre("wall", "grains"));
  EXPECT_THAT(stages[2].stage->origins.reactions, ElementsAre(0U, 2U));
  EXPECT_THAT(scenario.names_of_stages.reactions,
              ElementsAre("floor", "wall", "on the stone", "grains"));
  EXPECT_THAT(stages[0].output.measures[0].planes, ElementsAre(0U, 1U));
  EXPECT_THAT(stages[1].output.measures[0].planes, ElementsAre(0U));
  EXPECT_TRUE(stages[1].output.measures[1].planes.empty());
}

TEST(StageTable, MayChangeEveryIntervalButThatOfHashes) {
  const auto with = [](const std::string& output) {
    return parsed("[[stages]]\nname = \"a\"\nend = { duration = 1 }\n[[stages]]\nname = \"b\"\n" +
                  ("end = { duration = 1 }\noutput." + output));
  };

  EXPECT_EQ(with("reactions_interval = 0.125\n").stages[1].output.reactions_interval, 0.125);
  EXPECT_EQ(with("checkpoint_wall_interval = 60\n").stages[1].output.checkpoint_wall_interval,
            60.0);
  EXPECT_THAT([&] { with("hash_interval = 7\n"); },
              ThrowsMessage<InputError>(
                  HasSubstr("stages.b.output.hash_interval: is the same in all stages")));
  EXPECT_THAT([&] { with("contact_list = true\n"); },
              ThrowsMessage<InputError>(HasSubstr("contact_list: is the same in all stages")));
}

TEST(StageTable, EndsByAStrainBetweenTwoThatHaveADistance) {
  const auto with = [](const std::string& names) {
    parsed(
        "[[planes]]\nname = \"lid\"\npoint = [0, 0, 1]\nnormal = [0, 0, -1]\nmaterial = \"sand\"\n"
        "[[stages]]\nname = \"a\"\nmax_duration = 1\nend = { strain = { between = [" +
        names + "], strain = 0.1 } }\n");
  };

  EXPECT_NO_THROW(with(R"("floor", "lid")"));
  EXPECT_THAT(
      [&] { with(R"("floor", "floor")"); },
      ThrowsMessage<InputError>(HasSubstr("stages.a.end.strain.between: names \"floor\" twice")));
  EXPECT_THAT([&] { with(R"("floor", "wall")"); },
              ThrowsMessage<InputError>(
                  HasSubstr("planes \"floor\" and \"wall\" are not flat and parallel")));
  EXPECT_THAT([&] { with(R"("floor", "lidd")"); },
              ThrowsMessage<InputError>(HasSubstr("\"lidd\"")));
}

TEST(StopKeys, KnowsTheEndsOfStages) {
  const auto with = [](const std::string& stop) {
    std::string text(kScenario);
    text.replace(text.find("damping"), 0, "duration = 1\n");
    return parse_scenario(text + "[stop]\n" + stop, "case.toml");
  };
  const auto refusal = [&](const std::string& stop) {
    try {
      with(stop);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };

  const StageEnd stop = *with(
                             "kinetic_energy = 1\nunbalanced_force = 0.01\nafter = 0.5\n"
                             "displacement = { plane = \"wall\", distance = \"5 mm\" }\n")
                             .stop;
  EXPECT_EQ(stop.kinetic_energy, 1.0);
  EXPECT_EQ(stop.unbalanced_force, 0.01);
  EXPECT_EQ(stop.after, 0.5);
  EXPECT_EQ(stop.displacement.value().plane, 1U);
  EXPECT_EQ(stop.displacement.value().distance, 0.005);
  EXPECT_THAT(refusal("after = 1\n"),
              HasSubstr("stop.kinetic_energy: missing; expected one or more of kinetic_energy, "
                        "unbalanced_force, servo, displacement, strain, force"));
  EXPECT_THAT(refusal("kinetic_energy = 1\nduration = 1\n"),
              HasSubstr("stop.duration: is that of the run, simulation.duration"));
  EXPECT_THAT(refusal("servo = { load = \"push\" }\n"),
              HasSubstr("stop.servo.load: there is no load \"push\" of kind \"servo\" here"));
  EXPECT_THAT(refusal("force = { reaction = \"floor\", component = \"z\", above = 1 }\n"),
              HasSubstr("stop.force.reaction: there is no reaction \"floor\" here"));
}

TEST(StageTable, IsFoundByItsName) {
  const Scenario scenario = parsed(kStages);

  EXPECT_EQ(stage_called(scenario, "c").stage->number, 2U);
  EXPECT_THAT([&] { stage_called(scenario, "e"); },
              ThrowsMessage<InputError>(HasSubstr("has no stage \"e\"")));
}

}  // namespace
}  // namespace plekton::apps::stage_tables_test
