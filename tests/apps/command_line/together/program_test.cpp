// SPDX-License-Identifier: GPL-3.0-or-later
// The program as its user meets it: exit codes, messages, files.
#include "tests/apps/command_line/command_fixture.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/vtp_reader.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>

namespace plekton::apps::program_test {
namespace {

using testing::HasSubstr;

TEST_F(Command, RunWritesSeriesHistoryAndReport) {
  const Outcome outcome = outcome_of({"run", scenario(), "--out", out(), "--threads", "2"});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  expect_complete_files();
  const auto json = report();
  EXPECT_EQ(json["status"], "finished");
  EXPECT_EQ(json["counts"]["grains"], 20);
  EXPECT_EQ(json["counts"]["facets"], 200);
  EXPECT_EQ(json["counts"]["frames"], 5);  // at 0, 5, 10, 15 and 20 ms
  EXPECT_EQ(json["lost_grains"], 0);
  EXPECT_EQ(json["options"]["threads"], 2);
  EXPECT_LE(json["dt_over_critical"], 0.8);
  EXPECT_NEAR(json["timing"]["simulated_time_s"], 0.02, json["timing"]["time_step_s"]);
  const test::VtpReader grains(test::bytes_of(folder_ / "out/frames/grains_00004.vtp"));
  EXPECT_EQ(grains.count("NumberOfPoints"), 20U);
}

TEST_F(Command, RunTellsHowLongItTookToStartAndToWrite) {
  outcome_of({"run", scenario(), "--out", out()});

  const auto timing = report()["timing"];
  EXPECT_GT(timing["start_up_s"], 0.0);
  EXPECT_GT(timing["output_s"], 0.0);
  EXPECT_LT(timing["output_s"], timing["wall_time_s"]);
}

TEST_F(Command, RunMeetsTheMembrane) {
  outcome_of({"run", scenario(), "--out", out()});

  const test::VtpReader contacts(test::bytes_of(folder_ / "out/frames/contacts_00004.vtp"));
  EXPECT_GT(contacts.count("NumberOfLines"), 0U);
  const test::VtpReader sheet(test::bytes_of(folder_ / "out/frames/membranes_00004.vtp"));
  const auto tension = sheet.values<float>("CellData", "tension");
  EXPECT_TRUE(std::any_of(tension.begin(), tension.end(), [](float t) { return t > 0.0F; }));
}

TEST_F(Command, RunTellsItsProgressInPlainLinesWithoutATerminal) {
  const Outcome outcome = outcome_of({"run", scenario(), "--out", out()});

  EXPECT_THAT(outcome.out, HasSubstr(" steps/s"));
  EXPECT_EQ(outcome.out.find('\r'), std::string::npos);
}

TEST_F(Command, RunGivesTheSameEnergiesForAnyNumberOfThreads) {
  outcome_of({"run", scenario(), "--out", (folder_ / "one").string(), "--threads", "1"});
  outcome_of({"run", scenario(), "--out", (folder_ / "three").string(), "--threads", "3"});

  const std::string one = test::bytes_of(folder_ / "one/energy.csv");
  EXPECT_GT(std::count(one.begin(), one.end(), '\n'), 500);
  EXPECT_EQ(one, test::bytes_of(folder_ / "three/energy.csv"));
}

TEST_F(Command, RunStopsAtRest) {
  const Outcome outcome = outcome_of({"run", scenario(), "--out", out(), "--set",
                                      "stop.kinetic_energy=1 kJ", "--set", "stop.after=5 ms"});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_EQ(report()["status"], "at_rest");
  EXPECT_NEAR(report()["timing"]["simulated_time_s"], 0.005, 0.001);
}

TEST_F(Command, RunDoesNotTakeBodiesThatAreAboutToFallForBodiesAtRest) {
  const Outcome outcome =
      outcome_of({"run", scenario(), "--out", out(), "--set", "grains.gravel.velocity=[0, 0, 0]",
                  "--set", "stop.kinetic_energy=1e-9 J"});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_EQ(report()["status"], "finished");
}

TEST_F(Command, RunShorterThanATimeStepStillTakesOne) {
  outcome_of({"run", scenario(), "--out", out(), "--set", "simulation.duration=1 ns"});

  EXPECT_EQ(report()["timing"]["steps"], 1);
  EXPECT_EQ(report()["timing"]["simulated_time_s"], 1e-9);
}

TEST_F(Command, RunRefusesMoreStepsThanItCouldTakeAndAStepBeyondTheEnd) {
  EXPECT_THAT(failure_of({"simulation.time_step=1e-300 s"}).err, HasSubstr("steps of 1e-300 s"));
  EXPECT_THAT(failure_of({"simulation.duration=1e15 h"}).err, HasSubstr("simulation.duration"));
  EXPECT_THAT(failure_of({"simulation.duration=1 us", "simulation.time_step=2 us"}).err,
              HasSubstr("longer than simulation.duration"));
}

TEST_F(Command, RunWarnsOfWhatMakesItsResultsDoubtful) {
  const Outcome outcome = outcome_of(
      {"run", scenario(), "--out", out(), "--set", "grains.gravel.velocity=[0, 0, \"-300 m/s\"]"});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("warning: the largest overlap is"));
  EXPECT_THAT(outcome.out, HasSubstr("warning: 20 grains are lost"));
  EXPECT_GE(report()["warnings"].size(), 2U);
}

TEST_F(Command, RunSeesGrainsPassThroughAMembraneHoweverFast) {
  // 300 m/s are 3 radii in the 16 steps between two looks at slow grains.
  outcome_of({"run", scenario(), "--out", out(), "--set",
              "grains.gravel.velocity=[0, 0, \"-300 m/s\"]", "--set", "simulation.time_step=2 us",
              "--set", "simulation.duration=1 ms"});

  EXPECT_EQ(report()["lost"]["through_membranes"], 20);
}

TEST_F(Command, RunInWhichNothingHappensHasNoEnergyErrorButRounding) {
  outcome_of({"run", scenario(), "--out", out(), "--set", "simulation.gravity=[0, 0, 0]", "--set",
              "grains.gravel.velocity=[0, 0, 0]", "--set",
              "membranes.sheet.rotate={ axis = [1, 2, 3], angle = 0.3 }", "--set",
              "grains.gravel.box={ min = [1, 1, 1], max = [1.1, 1.1, 1.1] }"});

  EXPECT_EQ(report()["energy_closure"], 0.0);
}

TEST_F(Command, RunNamesOnlyTheSeriesItWrote) {
  const Outcome outcome =
      outcome_of({"run", scenario(), "--out", out(), "--set", "output.contacts=false"});

  EXPECT_THAT(outcome.out, HasSubstr("for ParaView grains.pvd, membranes.pvd\n"));
}

TEST_F(Command, RunKeepsOutOfAFolderThatAnotherRunWritesTo) {
  Program first({"run", scenario(), "--out", out(), "--set", "simulation.duration=1000 s"});
  ASSERT_TRUE(Program::appears(folder_ / "out/frames/contacts_00001.vtp"));

  const Outcome second = outcome_of({"run", scenario(), "--out", out()});
  first.send(SIGINT);

  EXPECT_EQ(second.exit_code, kFailed);
  EXPECT_THAT(second.err, HasSubstr("another run writes to this folder"));
  EXPECT_EQ(first.wait().exit_code, kInterrupted);
  expect_complete_files();
}

TEST_F(Command, RunGoesOnWhenNobodyReadsItsProgress) {
  const auto output_to_nobody = [] {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) return;
    ::dup2(ends[1], STDOUT_FILENO);
    ::close(ends[0]);
    ::signal(SIGPIPE, SIG_IGN);  // for what comes before the run, as if it were still read
  };

  const Outcome outcome = outcome_of({"run", scenario(), "--out", out()}, output_to_nobody);

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_EQ(report()["status"], "finished");
}

TEST_F(Command, RunRefusesAFolderThatHoldsResults) {
  outcome_of({"run", scenario(), "--out", out()});
  const std::string energies = test::bytes_of(folder_ / "out/energy.csv");
  const std::string series = test::bytes_of(folder_ / "out/grains.pvd");

  for (const std::string left : {"run.json", "energy.csv", "planes.csv", "scenario-as-run.toml",
                                 "checkpoints", "grains.pvd"}) {
    const Outcome outcome =
        outcome_of({"run", scenario(), "--out", out(), "--set", "grains.gravel.count=10"});

    EXPECT_EQ(outcome.exit_code, kFailed) << left;
    EXPECT_THAT(outcome.err, HasSubstr("out: holds results of an earlier run (" + left + ")"));
    EXPECT_THAT(outcome.err, HasSubstr("--overwrite"));
    if (left == "run.json") {
      EXPECT_EQ(test::bytes_of(folder_ / "out/energy.csv"), energies);
    }
    EXPECT_EQ(test::bytes_of(folder_ / "out/grains.pvd"), series);
    std::filesystem::remove_all(folder_ / "out" / left);
  }
}

TEST_F(Command, RunReplacesWhatAnEarlierRunLeft) {
  outcome_of({"run", scenario(), "--out", out()});
  test::write_bytes(folder_ / "out/frames/notes.txt", "mine");

  outcome_of({"run", scenario(), "--out", out(), "--overwrite", "--set", "output.interval=1 s"});

  EXPECT_EQ(report()["counts"]["frames"], 2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/frames/grains_00002.vtp"));
  EXPECT_EQ(test::bytes_of(folder_ / "out/frames/notes.txt"), "mine");
  expect_complete_files();
}

TEST_F(Command, RunInterruptedEndsCleanlyWithCompleteFiles) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    std::filesystem::remove_all(out());
    Program program({"run", scenario(), "--out", out(), "--set", "simulation.duration=1000 s"});
    ASSERT_TRUE(Program::appears(folder_ / "out/frames/contacts_00001.vtp"));
    program.send(signal);

    const Outcome outcome = program.wait();

    EXPECT_EQ(outcome.exit_code, kInterrupted) << outcome.err;
    expect_complete_files();
    EXPECT_EQ(report()["status"], "interrupted");
    EXPECT_TRUE(report()["interrupted"]);
    const std::string history = test::bytes_of(folder_ / "out/energy.csv");
    EXPECT_EQ(history.back(), '\n');
  }
}

TEST_F(Command, RunRefusesATimeStepAboveCriticalAndNamesTheCriticalOne) {
  const Outcome outcome = failure_of({"simulation.time_step=1 ms"});

  EXPECT_THAT(outcome.err, HasSubstr("simulation.time_step: 0.001 s is not below 0.8 of the "
                                     "critical time step of this scene, which is "));
}

TEST_F(Command, RunTakesATimeStepBelowCritical) {
  EXPECT_EQ(outcome_of({"run", scenario(), "--out", out(), "--set", "simulation.time_step=2 us"})
                .exit_code,
            kDone);
  EXPECT_EQ(report()["timing"]["time_step_s"], 2e-6);
}

TEST_F(Command, RunAsksForATimeStepWhereNothingMovesFreely) {
  std::string text(kScenario);
  const std::size_t grains = text.find("[[grains]]");
  text.erase(grains, text.find("[[planes]]") - grains);
  test::write_bytes(folder_ / "case.toml", text);

  EXPECT_THAT(failure_of({"membranes.sheet.hold=all", "membranes.sheet.hold_rotation=true"}).err,
              HasSubstr("nothing in this scene moves freely"));
}

TEST_F(Command, RunRefusesBadScenariosWithNothingWritten) {
  EXPECT_THAT(failure_of({"simulation.duraton=1 s"}).err, HasSubstr("did you mean \"duration\"?"));
  EXPECT_THAT(failure_of({"grains.gravel.radius=-5 mm"}).err,
              HasSubstr("expected a length above 0"));
  EXPECT_THAT(failure_of({"materials.gravel.friction_angle=95 deg"}).err,
              HasSubstr("below 90 deg"));
  EXPECT_THAT(failure_of({"grains.gravel.material=steel"}).err,
              HasSubstr("there is no material \"steel\""));
  EXPECT_THAT(failure_of({"membranes.sheet.mesh=none.stl"}).err, HasSubstr("does not exist"));
  EXPECT_THAT(failure_of({"grains.gravel.count=5000"}).err, HasSubstr("do not fit the box"));
  // 41 % of the box: more than chance can place, less than a lattice holds.
  EXPECT_THAT(failure_of({"grains.gravel.count=190"}).err,
              testing::ContainsRegex("placed at random, largest first, [0-9]+ of 190 found room"));
  EXPECT_EQ(outcome_of({"check", scenario(), "--set", "grains.gravel.count=190", "--set",
                        "grains.gravel.placement=lattice"})
                .exit_code,
            kDone);
}

TEST_F(Command, RunRefusesBadMeshesWithNothingWritten) {
  test::write_bytes(folder_ / "empty.off", "");
  test::write_bytes(folder_ / "range.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
  EXPECT_THAT(failure_of({"membranes.sheet.mesh=empty.off"}).err, HasSubstr("the file is empty"));
  EXPECT_THAT(failure_of({"membranes.sheet.mesh=range.off"}).err, HasSubstr("range.off"));
}

TEST_F(Command, RunNamesAnOutputFolderThatCannotBeWritten) {
  test::write_bytes(folder_ / "file", "");
  const Outcome outcome =
      outcome_of({"run", scenario(), "--out", (folder_ / "file/below").string()});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("a part of the path is a file"));
}

TEST_F(Command, RunThatCannotWriteAFrameStopsWithWhatIsCompleteInPlace) {
  // The fourth frame of the contacts finds its place taken.
  std::filesystem::create_directories(folder_ / "out/frames/contacts_00003.vtp.part");

  const Outcome outcome = outcome_of({"run", scenario(), "--out", out()});

  std::filesystem::remove_all(folder_ / "out/frames/contacts_00003.vtp.part");

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("contacts_00003.vtp.part: cannot create: Is a directory"));
  EXPECT_THAT(outcome.err, HasSubstr("a folder has this name"));
  expect_complete_files();
  EXPECT_EQ(report()["status"], "failed");
  EXPECT_THAT(report()["message"].get<std::string>(), HasSubstr("a folder has this name"));
}

TEST_F(Command, RunOnADiskThatFillsUpAltogetherStillGivesTheMessage) {
  const auto small_disk = [] { static const test::FileSizeLimit limit(600); };

  const Outcome outcome = outcome_of({"run", scenario(), "--out", out()}, small_disk);

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("raise the limit of file sizes"));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(out())) {
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
  }
}

TEST_F(Command, RunAtALimitOfFileSizesEndsWithTheMessageAndWholeRows) {
  // As a shell starts it with ulimit -f: the signal at the limit ends a program that does nothing
  // about it.
  const auto limited = [] {
    static const test::FileSizeLimit limit(50'000);
    ::signal(SIGXFSZ, SIG_DFL);
  };

  const Outcome outcome = outcome_of(
      {"run", scenario(), "--out", out(), "--set", "output.history_interval=1 us"}, limited);

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("energy.csv: cannot write: File too large; raise the limit"));
  const std::string history = test::bytes_of(folder_ / "out/energy.csv");
  ASSERT_FALSE(history.empty());
  EXPECT_EQ(history.back(), '\n');
  EXPECT_EQ(report()["status"], "failed");
}

TEST_F(Command, RunThatDivergesNamesStepNodePositionAndAdvice) {
  const Outcome outcome = outcome_of({"run", scenario(), "--out", out(), "--set",
                                      "grains.gravel.velocity=[0, 0, \"-1000000 m/s\"]", "--set",
                                      "simulation.time_step=2 us"});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("step"));
  EXPECT_THAT(outcome.err, HasSubstr("node"));
  EXPECT_THAT(outcome.err, HasSubstr("given or is prescribed; use a lower speed"));
  EXPECT_EQ(report()["status"], "failed");
}

TEST_F(Command, RunInWhichAGrainSpinsFasterThanStepsCanFollowIsNotFinished) {
  const Outcome outcome = outcome_of({"run", scenario(), "--out", out(), "--set",
                                      "grains.gravel.angular_velocity=[1e8, 0, 0]", "--set",
                                      "simulation.time_step=2 us"});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("spins at 1e+08 rad/s"));
  EXPECT_EQ(report()["status"], "failed");
}

TEST_F(Command, CheckSaysWhatTheSceneIsAndWritesNothing) {
  const auto before = folder_.names();
  const Outcome outcome = outcome_of({"check", scenario()});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("membrane sheet: 121 nodes (40 held)"));
  EXPECT_THAT(outcome.out, HasSubstr("grains gravel: 20 of 0.005 to 0.005 m radius"));
  EXPECT_THAT(outcome.out, HasSubstr("critical"));
  EXPECT_EQ(folder_.names(), before);
}

TEST_F(Command, CheckThatCannotPrintItsAnswerFails) {
  const auto full = [] { ::dup2(::open("/dev/full", O_WRONLY), STDOUT_FILENO); };

  const Outcome outcome = outcome_of({"check", scenario()}, full);

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("standard output: cannot be written: No space left"));
}

TEST_F(Command, HelpAndVersionThatCannotBePrintedFail) {
  const auto full = [] { ::dup2(::open("/dev/full", O_WRONLY), STDOUT_FILENO); };

  for (const char* asked : {"--help", "--version"}) {
    const Outcome outcome = outcome_of({asked}, full);

    EXPECT_EQ(outcome.exit_code, kFailed) << asked;
    EXPECT_THAT(outcome.err, HasSubstr("standard output: cannot be written: No space left"));
  }
  EXPECT_EQ(outcome_of({"--version"}).exit_code, kDone);
}

TEST_F(Command, CheckNamesTheBodyWhoseNumbersAreTooExtreme) {
  EXPECT_THAT(outcome_of({"check", scenario(), "--set", "membranes.sheet.thickness=1e-300 m"}).err,
              HasSubstr("membranes.sheet: \"sheet\": mass is"));
  EXPECT_THAT(
      outcome_of({"check", scenario(), "--set", "membranes.sheet.translate=[1e30, 0, 0]"}).err,
      HasSubstr("membranes.sheet: \"sheet\": area is 0 m2"));
  EXPECT_THAT(outcome_of({"check", scenario(), "--set", "grains.gravel.radius=1e-200 m"}).err,
              HasSubstr("grains.gravel: a grain of 1e-200 m radius"));
}

TEST_F(Command, CheckFindsRoomInAFlatBoxOfAnySize) {
  const Outcome outcome =
      outcome_of({"check", scenario(), "--set",
                  "grains.gravel.box={ min = [-1e9, -1e9, 0.01], max = [1e9, 1e9, 0.1] }"});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
}

TEST_F(Command, CheckListsAllProblems) {
  const Outcome outcome = outcome_of({"check", scenario(), "--set", "simulation.duration=-1 s",
                                      "--set", "planes.floor.material=x"});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("plekton: 2 problems\n"));
}

}  // namespace
}  // namespace plekton::apps::program_test
