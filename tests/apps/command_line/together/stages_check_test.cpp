// SPDX-License-Identifier: GPL-3.0-or-later
// Stages before they run: which are refused, and what `plekton check` says of them.
#include "apps/command_line/asked_stages.hpp"
#include "tests/apps/command_line/stages_fixture.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <string>

namespace plekton::apps::stages_check_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

TEST_F(Stages, AreRefusedWhereTheyMakeNoSense) {
  const Outcome none = run(write("none.toml", std::string("stages = []\n") + kBodies), "wrong");
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_THAT(none.err, HasSubstr("stages: got a list of 0; expected at least one table"));
  EXPECT_THAT(failure_of("[[stages]]\nname = \"a\"\n"), HasSubstr("stages.a.end: missing"));
  EXPECT_THAT(failure_of("[[stages]]\nname = \"a\"\nend = { unbalanced_force = 0.1 }\n"),
              HasSubstr("stages.a.max_duration: missing"));
  EXPECT_THAT(failure_of("[[stages]]\nname = \"a\"\nend = { duration = 1 }\n"
                         "[[stages]]\nname = \"a\"\nend = { duration = 1 }\n"),
              HasSubstr("stages.a.name: \"a\" has this name already"));
  EXPECT_THAT(failure_of("[[stages]]\nname = \"a\"\nend = { duration = 1 }\n"
                         "remove = [{ plane = \"lidd\" }]\n"),
              HasSubstr("stages.a.remove.plane: there is none called \"lidd\""));
  EXPECT_THAT(failure_of("[[stages]]\nname = \"a\"\nend = { duration = 1 }\n"
                         "materials.sand.density = 1000\n"),
              HasSubstr("materials.sand.density: is the same in all stages"));
  EXPECT_THAT(failure_of("[[stages]]\nname = \"a\"\nend = { servo = { load = \"no\" } }\n"
                         "max_duration = 1\n"),
              HasSubstr("there is no load \"no\" of kind \"servo\""));
  EXPECT_THAT(failure_of("[[stages]]\nname = \"a\"\nend = { duration = 1 }\n[[stages]]\nname = "
                         "\"b\"\nend = { duration = 1 }\n[[stages.contacts]]\nbetween = \"sand\"\n"
                         "and = \"sand\"\nlaw = \"hertz_mindlin\"\n"),
              HasSubstr("had another contact law before"));
  EXPECT_FALSE(fs::exists(folder_ / "wrong"));
}

// It was said to be free along nothing, and was in the box of everything.
TEST_F(Stages, AreNamedOfBodiesThatComeInThem) {
  const std::string file = write("bodies.toml", in_three("a", "b", "c"));

  const Outcome checked = Program({"check", file}).wait();
  const json boxes = json::parse(Program({"check", "--json", file}).wait().out)["boxes"];

  EXPECT_THAT(checked.out, HasSubstr("; comes in stage c\n"));
  EXPECT_THAT(checked.out, HasSubstr("box of rigid_bodies.lid, which comes in stage c: (-0.0205"));
  for (const json& box : boxes) {
    const bool is_lid = box["of"] == "rigid_bodies.lid";
    EXPECT_EQ(box.value("comes_in", ""), is_lid ? "c" : "");
    // The lid is from 0.0495 m on, the highest grain ends at 0.036 m.
    EXPECT_EQ(box["upper_m"][2] > 0.04, is_lid) << box;
  }
}

TEST_F(Stages, WithAStrainBetweenPlanesAtOnePlaceAreRefused) {
  std::string text = std::string(kBodies) + R"([[stages]]
name = "a"
end = { strain = { between = ["left", "also left"], strain = 0.1 } }
max_duration = 1
)";
  text.insert(text.find("[[planes]]"),
              "[[planes]]\nname = \"also left\"\npoint = [\"-30 mm\", 0, 0]\nnormal = [1, 0, 0]\n"
              "material = \"sand\"\n");
  const Outcome outcome = run(write("flat.toml", text), "flat");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("stages.a.end.strain.between: the two are at no distance"));
}

TEST_F(Stages, AreAllLookedAtByCheck) {
  const Outcome sound = Program({"check", all_stages()}).wait();
  EXPECT_EQ(sound.exit_code, 0) << sound.err;
  EXPECT_THAT(sound.out, HasSubstr("stage press (3 of 3): ends: after 0.008 s; 70 grains"));

  EXPECT_THAT(sound.out, HasSubstr("wall time of stage pour, the others not counted: "));
  EXPECT_THAT(sound.out, HasSubstr(" steps in this stage at the most at this one"));
  const json report = json::parse(Program({"check", "--json", all_stages()}).wait().out);
  EXPECT_EQ(report["estimate"]["stage"], "pour");
  ASSERT_EQ(report["stages"].size(), 3U);
  EXPECT_EQ(report["stages"][2]["name"], "press");
  EXPECT_EQ(report["stages"][2]["grains"], 70);

  std::string tight = std::string(kBodies) + kStages;
  tight.replace(tight.find("count = 10"), 10, "count = 900");
  const Outcome full = Program({"check", write("tight.toml", tight)}).wait();
  EXPECT_EQ(full.exit_code, 1);
  EXPECT_THAT(full.err, HasSubstr("grains.second"));
}

/// A grain that falls on a floor, and is held in a second stage.
constexpr const char* kHeld = R"([materials.stone]
density = "2650 kg/m3"
young_modulus = "10 MPa"
friction_angle = "30 deg"
[[grains]]
name = "ball"
material = "stone"
centres = [[0, 0, "6 mm"]]
radius = "5 mm"
[[planes]]
name = "floor"
point = [0, 0, 0]
normal = [0, 0, 1]
material = "stone"
[[stages]]
name = "fall"
end = { duration = "1 ms" }
[[stages]]
name = "hold"
end = { duration = "1 ms" }
)";

TEST_F(Stages, InWhichNothingMovesAreRefusedByCheckAsByTheRun) {
  const std::string file =
      write("held.toml", std::string(kHeld) + R"(fix = [{ grains = "ball", nodes = "all" }])");
  const std::string refusal = "stages.hold: nothing moves freely at its start";

  const Outcome checked = Program({"check", file}).wait();
  EXPECT_EQ(checked.exit_code, 1);
  EXPECT_THAT(checked.err, HasSubstr(refusal));
  EXPECT_THAT(run(file, "held").err, HasSubstr(refusal));
}

TEST_F(Stages, ThatFreeGrainsWhereOnlyARunFindsThemAreNotRefusedByCheck) {
  const std::string file =
      write("freed.toml", std::string(kHeld) + R"(simulation.time_step = "10 us"
fix = [{ grains = "ball", nodes = "all" }]
[[stages]]
name = "free"
end = { duration = "1 ms" }
simulation.time_step = "auto"
free = [{ grains = "ball", nodes = { min = [-1, -1, -1], max = [1, 1, 1] } }]
)");

  EXPECT_EQ(Program({"check", file}).wait().exit_code, 0);
  EXPECT_EQ(run(file, "freed").exit_code, 0);
}

TEST_F(Stages, WhoseTimeStepIsTooLongAreToldByCheck) {
  const std::string file =
      write("long.toml", std::string(kHeld) + "simulation.time_step = \"0.9 ms\"\n");
  const std::string warning = "stages.hold: simulation.time_step of 0.0009 s is not below ";

  const Outcome checked = Program({"check", file}).wait();
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
  EXPECT_THAT(checked.out, HasSubstr("warning: " + warning));
  const json report = json::parse(Program({"check", "--json", file}).wait().out);
  EXPECT_THAT(report["warnings"].back().get<std::string>(), HasSubstr(warning));
  EXPECT_THAT(run(file, "long").err, HasSubstr("0.0009 s is not below 0.8 of the critical"));
}

/// A block above a floor, with a stage after the first.
constexpr const char* kBlock = R"([materials.stone]
density = "2650 kg/m3"
young_modulus = "10 MPa"
friction_angle = "30 deg"
[[planes]]
name = "floor"
point = [0, 0, 0]
material = "stone"
[[rigid_bodies]]
name = "block"
shape = { kind = "box", size = [0.1, 0.1, 0.1] }
translate = [0, 0, 0.2]
thickness = "2 mm"
density = "1000 kg/m3"
material = "stone"
[[grains]]
name = "first"
material = "stone"
radius = "5 mm"
centres = [[0.5, 0, "5 mm"]]
[[stages]]
name = "a"
end = { duration = "1 ms" }
[[stages]]
name = "b"
end = { duration = "1 ms" }
)";

std::string ball_at(const std::string& place) {
  return "[[stages.rigid_bodies]]\nname = \"ball\"\nshape = { kind = \"sphere\", radius = \"10 "
         "mm\", subdivisions = 2 }\nthickness = \"1 mm\"\nmaterial = \"stone\"\n"
         "density = \"1000 kg/m3\"\ntranslate = " +
         place + "\n";
}

TEST_F(Stages, InWhichABodyComesBehindAPlaneAreRefusedByCheckAsByTheRun) {
  const std::string file = write("behind.toml", kBlock + ball_at("[0.3, 0, -0.1]"));
  const std::string refusal =
      "stages.b: at its start rigid_bodies.ball: 162 of its nodes begin behind planes.floor";

  const Outcome checked = Program({"check", file}).wait();
  EXPECT_EQ(checked.exit_code, 1);
  EXPECT_THAT(checked.err, HasSubstr(refusal));
  EXPECT_THAT(run(file, "behind").err, HasSubstr(refusal));
  EXPECT_EQ(
      Program({"check", write("above.toml", kBlock + ball_at("[0.3, 0, 0.1]"))}).wait().exit_code,
      0);
}

TEST_F(Stages, InWhichABodyComesInAnotherAreToldByCheck) {
  const std::string file = write("within.toml", kBlock + ball_at("[0.05, 0.05, 0.2]"));

  const Outcome checked = Program({"check", file}).wait();
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
  EXPECT_THAT(checked.out,
              AllOf(HasSubstr("stages.b: at its start rigid_bodies.block: begins in "
                              "rigid_bodies.ball"),
                    HasSubstr("if it still is so when the stage begins, the run ends there")));
  EXPECT_EQ(run(file, "within").exit_code, 1);
}

TEST_F(Stages, ThatAskForGrainsWhichAreGoneAreRefusedByCheckAsByTheRun) {
  const std::string load =
      "[[stages.loads]]\nname = \"pull\"\nkind = \"force\"\ngrains = \"first\"\n"
      "nodes = \"z_max\"\nforce = [0, 0, 1]\n";
  const std::string gone = std::string(kBlock) + "remove = [{ grains = \"first\" }]\n";
  const std::string loaded = write("loaded.toml", gone + load);
  const std::string ended =
      write("ended.toml", gone +
                              "[[stages]]\nname = \"c\"\nmax_duration = 1\n"
                              "end = { displacement = { grains = \"first\", distance = 1 } }\n");
  const std::string refusal = "\"first\" has no node there: all of its grains have been taken out";

  for (const std::string& file : {loaded, ended}) {
    const Outcome checked = Program({"check", file}).wait();
    EXPECT_EQ(checked.exit_code, 1);
    EXPECT_THAT(checked.err, HasSubstr(refusal));
    EXPECT_THAT(run(file, "gone").err, HasSubstr(refusal));
    fs::remove_all(folder_ / "gone");
  }
}

TEST_F(Stages, ThatFixAndFreeTheSameNodesAreRefused) {
  const std::string text = std::string(kBodies) +
                           "[[stages]]\nname = \"a\"\nend = { duration = \"1 ms\" }\n"
                           "fix = [{ grains = \"first\", nodes = \"z_min\" },\n"
                           "       { membrane = \"sheet\", nodes = \"x_min\" }]\n"
                           "free = [{ membrane = \"sheet\", nodes = \"y_min\" }]\n";

  const Outcome checked = Program({"check", write("both.toml", text)}).wait();
  EXPECT_EQ(checked.exit_code, 1);
  EXPECT_THAT(checked.err, HasSubstr("stages.a: fix and free both name a node of \"sheet\", "
                                     "which cannot be held and free"));
}

TEST_F(Stages, SayWhichSupportsTheyFree) {
  const std::string text =
      std::string(kBodies) +
      "[[output.reactions]]\nname = \"edge\"\nkind = \"support\"\nmembrane = \"sheet\"\n"
      "nodes = \"rim\"\n[[stages]]\nname = \"a\"\nend = { duration = \"0.2 ms\" }\n"
      "[[stages]]\nname = \"b\"\nend = { duration = \"0.2 ms\" }\n"
      "free = [{ membrane = \"sheet\", nodes = ";
  const std::string some = write("some.toml", text + "\"x_min\" }]\n");
  const std::string all = write("all.toml", text + "\"all\" }]\n");
  const std::string of_some = "stages.b.free: frees ";
  const std::string of_all = "stages.b: holds none of the nodes of output.reactions.edge any more";

  EXPECT_THAT(Program({"check", some}).wait().out, HasSubstr("warning: " + of_some));
  EXPECT_THAT(Program({"check", all}).wait().out, HasSubstr("warning: " + of_all));
  ASSERT_EQ(run(all, "freed").exit_code, 0);
  EXPECT_THAT(report("freed")["warnings"].dump(), HasSubstr(of_all));
}

}  // namespace
}  // namespace plekton::apps::stages_check_test
