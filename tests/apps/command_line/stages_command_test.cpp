// SPDX-License-Identifier: GPL-3.0-or-later
// Scenarios with stages: the same bits at once and one by one, with any threads, and what they say
// when something is wrong.
#include "apps/command_line/stages_command.hpp"

#include "apps/run/checkpoints.hpp"
#include "tests/apps/command_line/program_fixture.hpp"
#include "tests/support/temporary_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace plekton::apps::stages_command_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// Grains that fall on a sheet in a box.
constexpr const char* kBodies = R"([simulation]
damping = 0.2
[materials.sand]
density = "2650 kg/m3"
young_modulus = "10 MPa"
friction_angle = "30 deg"
[[membranes]]
name = "sheet"
shape = { kind = "sheet", width = "60 mm", length = "60 mm", cells = [6, 6] }
thickness = "2 mm"
material = "sand"
young_modulus = "50 MPa"
areal_mass = "300 g/m2"
hold = "rim"
[[grains]]
name = "first"
material = "sand"
count = 60
radius = "4 mm"
velocity = [0, 0, "-0.5 m/s"]
box = { min = ["-28 mm", "-28 mm", "2 mm"], max = ["28 mm", "28 mm", "36 mm"] }
[[planes]]
name = "left"
point = ["-30 mm", 0, 0]
normal = [1, 0, 0]
material = "sand"
[[planes]]
name = "right"
point = ["30 mm", 0, 0]
normal = [-1, 0, 0]
material = "sand"
[[planes]]
name = "front"
point = [0, "-30 mm", 0]
normal = [0, 1, 0]
material = "sand"
[[planes]]
name = "back"
point = [0, "30 mm", 0]
normal = [0, -1, 0]
material = "sand"
[output]
interval = "5 ms"
history_interval = "1 ms"
hash_interval = 50
)";

/// All that may change.
constexpr const char* kStages = R"([[stages]]
name = "pour"
end = { duration = "12 ms" }
materials.sand.friction_angle = "5 deg"
[[stages]]
name = "level"
end = { duration = "6 ms" }
materials.sand.friction_angle = "30 deg"
remove = [{ grains = "first", above = "20 mm" }]
fix = [{ grains = "first", nodes = "z_min" }]
[[stages.grains]]
name = "second"
material = "sand"
count = 10
radius = "3 mm"
box = { min = ["-28 mm", "-28 mm", "30 mm"], max = ["28 mm", "28 mm", "60 mm"] }
[[stages]]
name = "press"
end = { duration = "8 ms" }
free = [{ grains = "first", nodes = "all" }]
[[stages.planes]]
name = "lid"
point = [0, 0, "62 mm"]
normal = [0, 0, -1]
material = "sand"
[[stages.loads]]
name = "push"
kind = "motion"
plane = "lid"
velocity = [0, 0, "-1 m/s"]
[[stages.output.reactions]]
name = "lid"
kind = "plane"
plane = "lid"
)";

class Stages : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    test::write_bytes(folder_ / name, text);
    return (folder_ / name).string();
  }
  std::string all_stages() const { return write("all.toml", std::string(kBodies) + kStages); }
  std::string in(const std::string& name) const { return (folder_ / name).string(); }

  Outcome run(const std::string& scenario, const std::string& out,
              const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"run", scenario, "--quiet", "--out", in(out)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Program(arguments).wait();
  }
  json report(const std::string& out) const {
    return json::parse(test::bytes_of(folder_ / (out + "/run.json")));
  }
  json hashes(const std::string& out) const { return report(out)["states"]["step_time_hash"]; }

  /// Those at the steps at which both have one, but for the last 64: a run without stages makes
  /// them end with its duration.
  void expect_same_states(const std::string& a, const std::string& b, std::size_t least) const {
    std::size_t common = 0;
    const json of_a = hashes(a);
    const json of_b = hashes(b);
    const int last = std::min(of_a.back()[0].get<int>(), of_b.back()[0].get<int>()) - 64;
    for (const json& state : of_a) {
      for (const json& other : of_b) {
        const int step = state[0].get<int>();
        if (other[0] != state[0] || step % 50 != 0 || step > last) continue;
        ++common;
        EXPECT_EQ(other[2], state[2]) << "step " << state[0];
      }
    }
    EXPECT_GE(common, least);
  }

  std::string failure_of(const std::string& stages) const {
    const Outcome outcome = run(write("wrong.toml", std::string(kBodies) + stages), "wrong");
    EXPECT_EQ(outcome.exit_code, 1);
    return outcome.err;
  }

  test::TemporaryFolder folder_;
};

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

/// The scene of kBodies, with a lid that comes in the last of three stages.
std::string in_three(std::string_view first, std::string_view second, std::string_view third) {
  std::string text = kBodies;
  for (const std::string_view name : {first, second, third})
    text += fmt::format("[[stages]]\nname = \"{}\"\nend = {{ duration = \"0.2 ms\" }}\n", name);
  return text + R"([[stages.rigid_bodies]]
name = "lid"
shape = { kind = "box", size = [0.04, 0.04, 0.005] }
translate = [-0.02, -0.02, 0.05]
thickness = "1 mm"
material = "sand"
density = "1000 kg/m3"
)";
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
}  // namespace plekton::apps::stages_command_test
