// SPDX-License-Identifier: GPL-3.0-or-later
// Stages as they run: the same bits at once and one by one, with any threads, how they end, and how
// they go on from another run.
#include "apps/command_line/asked_stages.hpp"
#include "apps/run/checkpoints.hpp"
#include "tests/apps/command_line/stages_fixture.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <sstream>
#include <string>
#include <vector>

namespace plekton::apps::stages_run_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

TEST_F(Stages, AreNotSeenWhereAStageChangesNothing) {
  const std::string one = R"([[stages]]
name = "a"
end = { duration = "16 ms" }
)";
  const std::string two = R"([[stages]]
name = "a"
end = { duration = "7 ms" }
[[stages]]
name = "b"
end = { duration = "9 ms" }
)";
  ASSERT_EQ(run(write("one.toml", kBodies + one), "one").exit_code, 0);
  ASSERT_EQ(run(write("two.toml", kBodies + two), "two").exit_code, 0);
  std::string plain(kBodies);
  plain.replace(plain.find("damping"), 0, "duration = \"16 ms\"\n");
  ASSERT_EQ(run(write("plain.toml", plain), "plain").exit_code, 0);

  expect_same_states("one", "two", 4);
  expect_same_states("one", "plain", 4);
  EXPECT_EQ(report("two")["stages"].size(), 2U);
  EXPECT_FALSE(report("plain").contains("stages"));
}

/// Through Simulation::go_on_from: the load is there and pulls with nothing, the plane far away.
TEST_F(Stages, LeaveTheBitsOfWhatTheyDoNotChange) {
  const std::string step = R"([[stages]]
name = "a"
end = { duration = "7 ms" }
simulation.time_step = "5 us"
)";
  const std::string next = R"([[stages]]
name = "b"
end = { duration = "9 ms" }
)";
  const std::string changes = R"([[stages.loads]]
kind = "force"
grains = "first"
force = [0, 0, 0]
[[stages.planes]]
name = "far"
point = [0, 0, "-1 m"]
material = "sand"
)";
  ASSERT_EQ(run(write("same.toml", kBodies + step + next), "same").exit_code, 0);
  ASSERT_EQ(run(write("other.toml", kBodies + step + next + changes), "other").exit_code, 0);
  // Hashes have the planes in them: the trajectories are compared.
  EXPECT_EQ(test::bytes_of(folder_ / "same/energy.csv"),
            test::bytes_of(folder_ / "other/energy.csv"));
}

TEST_F(Stages, HaveTheSameBitsAtOnceOneByOneAndWithAnyThreads) {
  ASSERT_EQ(run(all_stages(), "once").exit_code, 0);
  ASSERT_EQ(run(all_stages(), "pour", {"--until", "pour", "--threads", "2"}).exit_code, 0);
  ASSERT_EQ(
      run(all_stages(), "level", {"--from", "pour", in("pour"), "--until", "level"}).exit_code, 0);
  ASSERT_EQ(
      run(all_stages(), "press", {"--from", "level", in("level"), "--threads", "4"}).exit_code, 0);
  ASSERT_EQ(run(all_stages(), "threads", {"--threads", "4"}).exit_code, 0);

  const json once = report("once");
  EXPECT_EQ(once["stages"].size(), 3U);
  EXPECT_EQ(report("press")["states"]["chain"], once["states"]["chain"]);
  EXPECT_EQ(report("threads")["states"]["chain"], once["states"]["chain"]);
  EXPECT_EQ(report("press")["timing"]["steps"], once["timing"]["steps"]);
  // The rows of the last stage are those of the whole run.
  const std::string rows = test::bytes_of(folder_ / "press/energy.csv");
  const std::string last = rows.substr(rows.find('\n') + 1);
  EXPECT_GT(last.size(), 100U);
  EXPECT_THAT(test::bytes_of(folder_ / "once/energy.csv"), testing::EndsWith(last));
  EXPECT_EQ(test::bytes_of(folder_ / "threads/energy.csv"),
            test::bytes_of(folder_ / "once/energy.csv"));
}

TEST_F(Stages, TakeOutGrainsBringOthersAndTellOfEach) {
  ASSERT_EQ(run(all_stages(), "once").exit_code, 0);

  const json stages = report("once")["stages"];
  ASSERT_EQ(stages.size(), 3U);
  EXPECT_EQ(stages[0]["name"], "pour");
  EXPECT_EQ(stages[0]["ended_by"], "duration");
  EXPECT_EQ(stages[0]["grains"], 60);
  const int level = stages[1]["grains"];
  EXPECT_LT(level, 70);
  EXPECT_GT(level, 20);
  EXPECT_EQ(stages[2]["grains"], level);
  EXPECT_EQ(stages[2]["planes"], 5);
  EXPECT_EQ(stages[1]["start_s"], stages[0]["end_s"]);
  // Exact decisions and hashes are of the run as a whole.
  EXPECT_EQ(stages[2]["certificate"].size() + 2, report("once")["certificate"].size());
  const std::string planes = test::bytes_of(folder_ / "once/planes.csv");
  EXPECT_THAT(planes.substr(0, planes.find('\n')), HasSubstr("lid.point_z (m)"));
  EXPECT_THAT(test::bytes_of(folder_ / "once/reactions.csv"), HasSubstr("lid.force_z (N)"));
}

/// What a kill after a checkpoint leaves.
TEST_F(Stages, GoOnFromAnyCheckpointToTheLastByte) {
  ASSERT_EQ(
      run(all_stages(), "whole", {"--set", "output.checkpoint_interval=\"3.1 ms\""}).exit_code, 0);
  const auto files = checkpoints_of(folder_ / "whole");
  ASSERT_GE(files.size(), 8U);
  for (std::size_t left = 1; left < files.size(); ++left) {
    const fs::path stopped = folder_ / "stopped";
    fs::remove_all(stopped);
    fs::copy(folder_ / "whole", stopped, fs::copy_options::recursive);
    fs::remove(stopped / "run.json");
    for (std::size_t i = left; i < files.size(); ++i)
      fs::remove(stopped / kCheckpointFolder / files[i].filename());

    const Outcome outcome =
        Program({"run", "--resume", stopped.string(), "--quiet", "--threads", "2"}).wait();

    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(report("stopped")["states"], report("whole")["states"]) << files[left - 1];
    EXPECT_EQ(report("stopped")["stages"], report("whole")["stages"]) << files[left - 1];
    for (const char* const name : {"energy.csv", "planes.csv", "reactions.csv", "grains.pvd"})
      EXPECT_EQ(test::bytes_of(stopped / name), test::bytes_of(folder_ / "whole" / name))
          << name << " from " << files[left - 1];
  }
}

/// Grains that have fallen out of everything are taken out by the next stage, and others come.
constexpr const char* kLost = R"([simulation]
time_step = "20 us"
[materials.m]
density = 1000
young_modulus = "1 MPa"
friction_angle = "20 deg"
[[grains]]
name = "gone"
material = "m"
radius = "1 mm"
centres = [[0, 0, 0], [0.01, 0, 0]]
[[stages]]
name = "fall"
end = { duration = "0.1 s" }
[[stages]]
name = "others"
end = { duration = "2 ms" }
remove = [{ grains = "gone" }]
output.checkpoint_interval = "1 ms"
[[stages.grains]]
name = "new"
material = "m"
radius = "1 mm"
centres = [[0, 0, 0]]
)";

// "lost_grains": 0, and --strict was content.
TEST_F(Stages, CountLostGrainsThatTheyTakeOut) {
  const Outcome outcome = run(write("lost.toml", kLost), "lost", {"--strict"});

  EXPECT_EQ(outcome.exit_code, kRed) << outcome.err;
  const json whole = report("lost");
  EXPECT_EQ(whole["lost_grains"], 2);
  ASSERT_EQ(whole["stages"].size(), 2U);
  EXPECT_EQ(whole["stages"][1]["grains"], 1);
}

TEST_F(Stages, KeepTheNumberOfLostGrainsInCheckpoints) {
  ASSERT_EQ(run(write("lost.toml", kLost), "lost").exit_code, 0);
  const auto files = checkpoints_of(folder_ / "lost");
  ASSERT_GE(files.size(), 3U);  // at the ends of both stages, and in the second one
  fs::remove(files.back());

  const Outcome resumed = Program({"run", "--resume", in("lost"), "--quiet"}).wait();

  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(report("lost")["lost_grains"], 2);
}

/// Across the end of a stage, with more output than there was.
TEST_F(Stages, ArePartlyComputedAgainInAnotherFolder) {
  ASSERT_EQ(run(all_stages(), "whole").exit_code, 0);
  const Outcome outcome =
      Program({"run", "--resume", in("whole"), "--quiet", "--out", in("part"), "--from", "15 ms",
               "--to", "20 ms", "--set", "output.history_interval=\"0.2 ms\""})
          .wait();

  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json part = report("part");
  EXPECT_EQ(part["status"], "finished");
  EXPECT_NEAR(part["timing"]["simulated_time_s"].get<double>(), 0.020, 1e-4);
  expect_same_states("part", "whole", 10);
  std::istringstream rows(test::bytes_of(folder_ / "part/energy.csv"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(rows, line);) lines.push_back(line);
  EXPECT_NEAR(std::stod(lines.at(1)), 0.015, 1e-4);
  EXPECT_NEAR(std::stod(lines.back()), 0.020, 1e-4);
  EXPECT_GE(lines.size(), 25U);
  EXPECT_EQ(part["stages"].size(), 2U);  // the third one is cut off
}

TEST_F(Stages, FailWhereTheirEndDoesNotComeAndKeepThoseBefore) {
  const std::string stages = R"([[stages]]
name = "pour"
end = { duration = "4 ms" }
[[stages]]
name = "press"
end = { servo = { load = "lid" } }
max_duration = "2 ms"
[[stages.planes]]
name = "lid"
point = [0, 0, "40 mm"]
normal = [0, 0, -1]
material = "sand"
[[stages.loads]]
name = "lid"
kind = "servo"
plane = "lid"
force = "10 kN"
speed = "0.5 m/s"
)";
  const std::string err = failure_of(stages);

  EXPECT_THAT(err, HasSubstr("stages.press: has not ended within its max_duration of 0.002 s"));
  EXPECT_THAT(err, HasSubstr("servo \"lid\" feels 0 N and wants 1e+04 N within 2 %"));
  const json failed = report("wrong");
  EXPECT_EQ(failed["status"], "failed");
  ASSERT_EQ(failed["stages"].size(), 1U);
  EXPECT_EQ(failed["stages"][0]["name"], "pour");
  const std::string scenario =
      write("longer.toml",
            std::string(kBodies) + std::string(stages).replace(stages.find("10 kN"), 5, "1 N"));
  const Outcome again =
      run(scenario, "again",
          {"--from", "pour", in("wrong"), "--set", "stages.press.max_duration=\"300 ms\""});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(report("again")["stages"][1]["ended_by"], "servo");
}

TEST_F(Stages, SayThatAnEndWhichHeldAllAlongDoesNotCount) {
  const std::string stages = R"([[stages]]
name = "pour"
end = { kinetic_energy = "1000 kJ" }
max_duration = "2 ms"
)";
  EXPECT_THAT(failure_of(stages),
              AllOf(HasSubstr("to be below 1e+06 J, as it has been since the stage began"),
                    HasSubstr("counts where the end says after")));
  EXPECT_EQ(report("wrong")["status"], "failed");
}

TEST_F(Stages, ThatCannotBeginLeaveAReportOfThoseBefore) {
  const std::string stages = R"([[stages]]
name = "pour"
end = { duration = "2 ms" }
[[stages]]
name = "pull"
end = { duration = "2 ms" }
remove = [{ grains = "first" }]
[[stages.loads]]
kind = "force"
grains = "first"
force = [0, 0, 1]
)";
  EXPECT_THAT(failure_of(stages), HasSubstr("\"first\" has no node there"));
  const json failed = report("wrong");
  EXPECT_EQ(failed["status"], "failed");
  EXPECT_EQ(failed["stages"].size(), 1U);
  EXPECT_EQ(checkpoints_of(folder_ / "wrong").size(), 1U);
}

TEST_F(Stages, EndAtRestAtADisplacementAndAtAStrain) {
  const std::string stages = R"([[stages]]
name = "pour"
end = { kinetic_energy = "50 uJ", unbalanced_force = 1e-6 }
max_duration = "1 s"
simulation.damping = 0.5
[[stages]]
name = "move"
end = { displacement = { plane = "left", distance = "0.2 mm" }, duration = "10 ms" }
[[stages.loads]]
name = "push"
kind = "motion"
plane = "left"
velocity = ["0.1 m/s", 0, 0]
[[stages]]
name = "squeeze"
end = { strain = { between = ["left", "right"], strain = 0.005 }, duration = "10 ms" }
)";
  const Outcome outcome = run(write("ends.toml", kBodies + stages), "ends");

  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json ended = report("ends")["stages"];
  EXPECT_EQ(ended[0]["ended_by"], "kinetic_energy");
  EXPECT_LT(ended[0]["energy"]["kinetic_J"], 50e-6);
  EXPECT_EQ(ended[1]["ended_by"], "displacement");
  EXPECT_NEAR(ended[1]["end_s"].get<double>() - ended[1]["start_s"].get<double>(), 2e-3, 2e-4);
  EXPECT_EQ(ended[2]["ended_by"], "strain");
  // 0.5 % of 59.8 mm.
  EXPECT_NEAR(ended[2]["end_s"].get<double>() - ended[2]["start_s"].get<double>(), 2.99e-3, 2e-4);
}

TEST_F(Stages, ThatThereAreNotAreNotBegunFrom) {
  ASSERT_EQ(run(all_stages(), "pour", {"--until", "pour"}).exit_code, 0);

  EXPECT_THAT(run(all_stages(), "x", {"--from", "puor", in("pour")}).err,
              HasSubstr("has no stage \"puor\"; did you mean \"pour\"?"));
  EXPECT_THAT(run(all_stages(), "x", {"--from", "level", in("pour")}).err,
              HasSubstr("has no end of a stage \"level\"; it has those of \"pour\""));
  EXPECT_THAT(run(all_stages(), "x", {"--until", "end"}).err, HasSubstr("has no stage \"end\""));
  EXPECT_THAT(run(all_stages(), "pour", {"--from", "pour", in("pour"), "--overwrite"}).err,
              HasSubstr("is to be kept"));
  EXPECT_FALSE(fs::exists(folder_ / "x"));
}

TEST_F(Stages, GoOnOnlyWithTheTiesOfBefore) {
  const std::string stages =
      "[[stages]]\nname = \"a\"\nend = { duration = \"0.2 ms\" }\n"
      "[[stages]]\nname = \"b\"\nend = { duration = \"0.2 ms\" }\n";
  const auto tied = [&](const std::string& name, const std::string& side) {
    return kBodies +
           ("[[ties]]\nname = \"" + name + "\"\nfrom = { membrane = \"sheet\", nodes = \"" + side +
            "\" }\nto = { kind = \"ground\" }\n" + stages);
  };
  ASSERT_EQ(run(write("first.toml", tied("rope", "x_min")), "first").exit_code, 0);
  const std::vector<std::string> from = {"--from", "a", in("first")};

  EXPECT_EQ(run(write("same.toml", tied("rope", "x_min")), "same", from).exit_code, 0);
  const Outcome none = run(write("none.toml", kBodies + stages), "wrong", from);
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_THAT(none.err, HasSubstr("stages.a: has other ties than the run that it is to go on from: "
                                  "there they are \"rope\", here \"\""));
  EXPECT_THAT(run(write("side.toml", tied("rope", "x_max")), "wrong", from).err,
              HasSubstr("stages.a: ties.rope ties other nodes than in the run"));
  EXPECT_FALSE(fs::exists(folder_ / "wrong"));
}

TEST_F(Stages, GoOnOnlyWithPlanesOfTheKindsOfBefore) {
  const std::string stages =
      "[[stages]]\nname = \"a\"\nend = { duration = \"0.2 ms\" }\n"
      "[[stages]]\nname = \"b\"\nend = { duration = \"0.2 ms\" }\n";
  const auto around = [&](const std::string& how) {
    return kBodies + ("[[planes]]\nname = \"cell\"\npoint = [0, 0, -1]\nmaterial = \"sand\"\n" +
                      how + stages);
  };
  const std::string cylinder = around("kind = \"cylinder\"\nradius = 1\n");
  ASSERT_EQ(run(write("first.toml", cylinder), "first").exit_code, 0);
  const std::vector<std::string> from = {"--from", "a", in("first")};

  EXPECT_EQ(run(write("same.toml", cylinder), "same", from).exit_code, 0);
  EXPECT_THAT(run(write("flat.toml", around("")), "wrong", from).err,
              HasSubstr("stages.a: planes.cell has another kind than in the run"));
  EXPECT_THAT(
      run(write("wide.toml", around("kind = \"cylinder\"\nradius = 2\n")), "wrong", from).err,
      HasSubstr("stages.a: planes.cell has another radius than in the run"));
  EXPECT_THAT(run(write("moved.toml", cylinder), "wrong",
                  {"--from", "a", in("first"), "--set", "planes.cell.point=[0, 0, -0.9]"})
                  .err,
              HasSubstr("stages.a: planes.cell has another point than in the run"));
  EXPECT_FALSE(fs::exists(folder_ / "wrong"));
}

// "stages.b.planes.cell.axis: unknown key": what a container had could not be left out.
TEST_F(Stages, TurnAContainerIntoAFlatPlaneAndBack) {
  const std::string file = write("kinds.toml", kBodies + std::string(R"([[planes]]
name = "cell"
kind = "cylinder"
point = [0, 0, -1]
axis = [1, 0, 0]
radius = 2
material = "sand"
[[stages]]
name = "a"
end = { duration = "0.2 ms" }
[[stages]]
name = "b"
end = { duration = "0.2 ms" }
[[stages.planes]]
name = "cell"
kind = "flat"
normal = [0, 0, 2]
[[stages]]
name = "c"
end = { duration = "0.2 ms" }
[[stages.planes]]
name = "cell"
kind = "sphere"
radius = 3
)"));

  const Outcome outcome = run(file, "kinds");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
}

/// A checkpoint that has lost its second half.
void damage(const fs::path& checkpoint) {
  fs::resize_file(checkpoint, fs::file_size(checkpoint) / 2);
}

// The damaged checkpoint of the second stage kept the run from going on from the first one.
TEST_F(Stages, AreBegunFromAWholeCheckpointBesideDamagedOnes) {
  const std::string file = write("bodies.toml", in_three("a", "b", "c"));
  ASSERT_EQ(run(file, "first", {"--until", "b"}).exit_code, 0);
  const fs::path last = checkpoints_of(folder_ / "first").back();
  damage(last);

  const Outcome again = run(file, "again", {"--from", "a", in("first"), "--until", "b"});
  const Outcome none = run(file, "none", {"--from", "b", in("first")});

  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_THAT(none.err, HasSubstr("has no end of a stage \"b\"; it has those of \"a\"\n"));
  EXPECT_THAT(none.err, HasSubstr(last.string() + ": is damaged"));
}

TEST_F(Stages, GoOnOnlyWithTheBodiesOfBefore) {
  const std::string file = write("bodies.toml", in_three("a", "b", "c"));
  ASSERT_EQ(run(file, "first", {"--until", "b"}).exit_code, 0);
  const auto going_on = [&](const std::string& set) {
    return run(file, "wrong", {"--from", "b", in("first"), "--set", set});
  };

  EXPECT_THAT(
      going_on("membranes.sheet.thickness=\"1.5 mm\"").err,
      HasSubstr("stages.b: membranes.sheet has another mesh, place or thickness than in the "
                "run that it is to go on from: there"));
  EXPECT_THAT(going_on("membranes.sheet.shape.cells=[5, 6]").err,
              HasSubstr("membranes.sheet has another mesh"));
  EXPECT_THAT(going_on("grains.first.radius=\"3 mm\"").err,
              HasSubstr("stages.b: grains.first has other sizes, numbers or density"));
  EXPECT_THAT(going_on("materials.sand.density=\"2000 kg/m3\"").err,
              HasSubstr("stages.b: grains.first has other sizes, numbers or density"));
  EXPECT_THAT(going_on("membranes.sheet.areal_mass=\"2 kg/m2\"").err,
              HasSubstr("stages.b: membranes.sheet has another mass, density or inertia"));
  EXPECT_FALSE(fs::exists(folder_ / "wrong"));
}

TEST_F(Stages, GoOnWithOtherKeysOfBodiesThatAreStillToCome) {
  const std::string file = write("bodies.toml", in_three("a", "b", "c"));
  ASSERT_EQ(run(file, "first", {"--until", "b"}).exit_code, 0);

  const Outcome higher = run(file, "higher",
                             {"--from", "b", in("first"), "--set",
                              "stages.c.rigid_bodies.lid.translate=[-0.02, -0.02, 0.06]", "--set",
                              "stages.c.rigid_bodies.lid.thickness=\"2 mm\""});

  EXPECT_EQ(higher.exit_code, 0) << higher.err;
}

/// Though the stage itself changes nothing.
TEST_F(Stages, GoOnWithOtherMaterialsFromAnotherRun) {
  const std::string file = write("bodies.toml", in_three("a", "b", "c"));
  ASSERT_EQ(run(file, "first", {"--until", "a"}).exit_code, 0);

  const Outcome other = run(file, "other",
                            {"--from", "a", in("first"), "--set",
                             "materials.sand.friction_angle=\"10 deg\"", "--until", "b"});

  EXPECT_EQ(other.exit_code, 0) << other.err;
}

TEST_F(Stages, GoOnOnlyAfterStagesOfTheSameNames) {
  ASSERT_EQ(run(write("first.toml", in_three("a", "b", "c")), "first", {"--until", "b"}).exit_code,
            0);

  const Outcome outcome =
      run(write("other.toml", in_three("x", "b", "c")), "wrong", {"--from", "b", in("first")});

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("stages.b: stage 1 is \"x\" here and \"a\" in the run that it "
                                     "is to go on from"));
}

TEST_F(Stages, ThatWriteLessKeepTheFramesOfThoseBefore) {
  const std::string stages = R"([[stages]]
name = "a"
end = { duration = "6 ms" }
[[stages]]
name = "b"
end = { duration = "6 ms" }
output.contacts = false
)";
  ASSERT_EQ(run(write("less.toml", kBodies + stages), "less").exit_code, 0);

  const std::string series = test::bytes_of(folder_ / "less/contacts.pvd");
  EXPECT_THAT(series, HasSubstr("contacts_00001.vtp"));
  EXPECT_THAT(series, Not(HasSubstr("contacts_00003.vtp")));
  EXPECT_THAT(test::bytes_of(folder_ / "less/grains.pvd"), HasSubstr("grains_00003.vtp"));
  EXPECT_FALSE(fs::exists(folder_ / "less/frames/contacts_00003.vtp"));
}

TEST_F(Stages, ThatAreFinishedAreKeptWhereALaterPackingIsTooDense) {
  std::string tight = std::string(kBodies) + kStages;
  tight.replace(tight.find("count = 10"), 10, "porosity = 0.3");
  const std::string dense =
      "sieves = [{ sieve = \"5.8 mm\", passing = 0 }, { sieve = \"6.2 mm\", passing = 1 }]\n"
      "placement = \"packed\"";
  tight.replace(tight.rfind("radius = \"3 mm\""), 15, dense);

  const Outcome outcome = run(write("tight.toml", tight), "tight");

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("grains.second"));
  EXPECT_THAT(outcome.err, HasSubstr("jam at a porosity"));
  const json kept = report("tight");
  EXPECT_EQ(kept["status"], "failed");
  ASSERT_EQ(kept["stages"].size(), 1U);
  EXPECT_EQ(kept["stages"][0]["name"], "pour");
  EXPECT_EQ(checkpoints_of(folder_ / "tight").size(), 1U);
}

}  // namespace
}  // namespace plekton::apps::stages_run_test
