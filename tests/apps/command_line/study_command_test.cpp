// SPDX-License-Identifier: GPL-3.0-or-later
// plekton study, as a program: it starts itself for each run.
#include "apps/viewer/csv_text.hpp"
#include "tests/apps/command_line/command_fixture.hpp"

#include <map>
#include <sstream>

#ifdef PLEKTON_PROGRAM

namespace plekton::apps::study_command_test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A process that becomes a program.
class Executed : public Program {
 public:
  explicit Executed(const std::vector<std::string>& arguments)
      : Program({}, [&] {
          std::vector<char*> argv;
          for (const std::string& argument : arguments)
            argv.push_back(const_cast<char*>(argument.c_str()));
          argv.push_back(nullptr);
          ::execv(argv[0], argv.data());
          ::_exit(127);
        }) {}
};

Outcome executed(const std::vector<std::string>& arguments) {
  return Executed(arguments).wait();
}

class StudyCommand : public Command {
 protected:
  /// @param parts  what is to be studied, and which results
  void write_study(const std::string& parts) const {
    test::write_bytes(folder_ / "many.toml",
                      "scenario = \"case.toml\"\njobs = 2\n"
                      "[set]\nsimulation.duration = \"0.5 ms\"\noutput.interval = \"0.5 ms\"\n"
                      "output.membranes = false\n" +
                          parts);
  }
  void write_grid_of_64() const {
    write_study(R"([grid]
materials.gravel.friction_angle = ["20 deg", "22 deg", "24 deg", "26 deg", "28 deg", "30 deg", "32 deg", "34 deg"]
"simulation.damping" = [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]
[results]
steps = { report = "timing.steps" }
kinetic = { column = "kinetic" }
most = { column = "kinetic", take = "max" }
)");
  }
  std::string study() const { return (folder_ / "many.toml").string(); }
  fs::path runs() const { return folder_ / "out" / "runs"; }
  Outcome plekton_study(const std::vector<std::string>& more = {}) const {
    return executed(arguments(more));
  }
  std::vector<std::string> arguments(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = {PLEKTON_PROGRAM, "study", study(), "--out", out()};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  std::vector<CsvRow> table() const {
    return parse_csv(test::bytes_of(folder_ / "out" / "results.csv"));
  }
  /// When the report of each run was written, by its folder.
  std::map<std::string, fs::file_time_type> reports() const {
    std::map<std::string, fs::file_time_type> times;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(runs(), ignored)) {
      const fs::path report = entry.path() / "run.json";
      if (fs::exists(report)) times[entry.path().filename()] = fs::last_write_time(report);
    }
    return times;
  }
};

std::size_t count_of(const std::string& what, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++count;
  return count;
}

TEST_F(StudyCommand, MakesNoRunTwiceWhenItIsKilledInTheMiddleAndStartedAgain) {
  write_grid_of_64();
  Executed killed(arguments());
  for (int i = 0; i < 12000 && reports().size() < 20; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  killed.send(SIGKILL);
  killed.wait();
  // Its children are killed with it; a moment for the kernel.
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const auto before = reports();
  ASSERT_GE(before.size(), 20U);
  ASSERT_LT(before.size(), 64U);

  const Outcome second = plekton_study();

  ASSERT_EQ(second.exit_code, kDone) << second.err;
  EXPECT_EQ(count_of(": done in ", second.out), 64 - before.size());
  const auto after = reports();
  EXPECT_EQ(after.size(), 64U);
  for (const auto& [run, time] : before) EXPECT_EQ(after.at(run), time) << run;
  const auto rows = table();
  ASSERT_EQ(rows.size(), 65U);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].cells[0], std::to_string(i));
    EXPECT_EQ(rows[i].cells[6], "complete");
    EXPECT_GT(std::stoi(rows[i].cells[3]), 0);
    EXPECT_GT(std::stod(rows[i].cells[4]), 0.0);
    EXPECT_GE(std::stod(rows[i].cells[5]), std::stod(rows[i].cells[4]));
  }
  EXPECT_EQ(rows[0].cells[4], "kinetic (J)");
  EXPECT_EQ(rows[2].cells[1], "20 deg");
  EXPECT_EQ(rows[2].cells[2], "0.1");
  const std::string bytes = test::bytes_of(folder_ / "out" / "results.csv");
  const Outcome third = plekton_study();
  EXPECT_THAT(third.out, HasSubstr("64 runs, 0 to make"));
  EXPECT_EQ(test::bytes_of(folder_ / "out" / "results.csv"), bytes);
}

TEST_F(StudyCommand, ThatIsInterruptedStopsItsRunsWhichAreMissingAndSaysHowToGoOn) {
  write_study(
      "[grid]\nsimulation.seed = [1, 2, 3]\n[results]\nsteps = { report = \"timing.steps\" }\n");
  std::string text = test::bytes_of(study());
  text.replace(text.find("0.5 ms"), 6, "100 s");
  test::write_bytes(study(), text);
  Executed program(arguments());
  for (int i = 0; i < 6000; ++i) {
    std::error_code ignored;
    if (std::distance(fs::directory_iterator(runs(), ignored), fs::directory_iterator()) >= 4)
      break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }

  program.send(SIGINT);
  const Outcome outcome = program.wait();

  EXPECT_EQ(outcome.exit_code, kInterrupted);
  EXPECT_THAT(outcome.out, HasSubstr("go on with: plekton study"));
  ASSERT_EQ(table().size(), 4U);
  // Neither those that were under way nor the one that never began have failed, nor are they done.
  EXPECT_EQ(count_of(": interrupted\n", outcome.out), 2U) << outcome.out;
  EXPECT_THAT(outcome.out, Not(HasSubstr(" of 3, about")));
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(table()[i].cells[3], "missing");
    EXPECT_EQ(table()[i].cells[4], "");
  }
}

TEST_F(StudyCommand, GoesOnWhenARunFailsAndSaysWhyInItsRow) {
  write_study(R"([grid]
simulation.time_step = ["auto", "0.4 ms", "auto"]
[results]
steps = { report = "timing.steps" }
)");

  const Outcome outcome = plekton_study();

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("1 of 3 runs failed"), HasSubstr("run 2: "), HasSubstr("time_step")));
  const auto rows = table();
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[1].cells[3], "complete");
  EXPECT_EQ(rows[2].cells[3], "failed");
  EXPECT_THAT(rows[2].cells[4], HasSubstr("simulation.time_step"));
  // The same run as the first, and made with it.
  EXPECT_EQ(rows[3].cells[3], "complete");
  EXPECT_EQ(rows[3].cells[5], rows[1].cells[5]);
  EXPECT_EQ(reports().size(), 1U);
}

TEST_F(StudyCommand, FailsTheRowsAloneOfValuesThatNoScenarioCanHave) {
  write_study(
      "[grid]\nsimulation.damping = [0, 2]\n[results]\nmost = { report = \"counts.grains\" }\n");

  const Outcome outcome = plekton_study();

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("1 of 2 runs failed"), HasSubstr("simulation.damping=2")));
  const auto rows = table();
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[1].cells[2], "20");
  EXPECT_EQ(rows[1].cells[3], "complete");
  EXPECT_EQ(rows[2].cells[3], "failed");
  EXPECT_EQ(rows[2].cells[5], "");  // has no key
}

TEST_F(StudyCommand, MakesRunsAnewWhoseMeshOrScenarioWasChangedButNotForAComment) {
  write_study(
      "[grid]\nsimulation.damping = [0, 0.1]\n[results]\nsteps = { report = \"timing.steps\" }\n");
  ASSERT_EQ(plekton_study().exit_code, kDone);
  test::write_bytes(folder_ / "case.toml", "# a comment\n" + std::string(kScenario));
  EXPECT_THAT(plekton_study().out, HasSubstr("2 runs, 0 to make"));

  geometry::write_mesh_file(folder_ / "sheet.off", geometry::plane_sheet({0.2, 0.2, 9, 9}));
  EXPECT_THAT(plekton_study().out, HasSubstr("2 runs, 2 to make"));
  std::string changed(kScenario);
  changed.replace(changed.find("20 MPa"), 6, "21 MPa");
  test::write_bytes(folder_ / "case.toml", changed);
  EXPECT_THAT(plekton_study().out, HasSubstr("2 runs, 2 to make"));
  EXPECT_EQ(reports().size(), 6U);
}

TEST_F(StudyCommand, PrintsLinesThatAShellCarriesOut) {
  write_grid_of_64();
  ASSERT_EQ(plekton_study({"--only", "3"}).exit_code, kDone);
  const auto before = reports();
  const Outcome lines = plekton_study({"--parallel"});
  ASSERT_EQ(lines.exit_code, kDone) << lines.err;
  EXPECT_EQ(count_of("\n", lines.out), 63U);
  std::istringstream text(lines.out);
  std::string some;
  std::string line;
  for (int i = 0; i < 8 && std::getline(text, line); ++i) some += line + '\n';
  test::write_bytes(folder_ / "lines.sh", some + some);

  const Outcome outcome = executed({"/bin/sh", (folder_ / "lines.sh").string()});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_EQ(count_of(": done in ", outcome.out), 8U);
  EXPECT_EQ(reports().size(), 9U);
  EXPECT_EQ(reports().at(before.begin()->first), before.begin()->second);
  const Outcome collected = plekton_study({"--collect"});
  EXPECT_EQ(collected.exit_code, kFailed);
  EXPECT_THAT(collected.err, HasSubstr("55 of 64 runs are missing"));
}

/// Carries out an array of jobs as sbatch would, one after the other.
constexpr const char* kStandInForSbatch = R"(#!/bin/sh
set -eu
tasks=$(sed -n 's/^#SBATCH --array=//p' "$1")
for range in $(echo "$tasks" | tr , ' '); do
  first=${range%-*} last=${range#*-}
  while [ "$first" -le "$last" ]; do
    SLURM_ARRAY_TASK_ID=$first sh "$1"
    first=$((first + 1))
  done
done
)";

TEST_F(StudyCommand, PrintsAScriptThatSlurmCarriesOut) {
  write_grid_of_64();
  test::write_bytes(folder_ / "sbatch", kStandInForSbatch);
  ASSERT_EQ(plekton_study({"--only", "5"}).exit_code, kDone);
  const Outcome script = plekton_study({"--slurm"});
  ASSERT_EQ(script.exit_code, kDone) << script.err;
  EXPECT_THAT(script.out, AllOf(HasSubstr("#SBATCH --array=1-4,6-64\n"),
                                HasSubstr("#SBATCH --cpus-per-task=1\n")));
  test::write_bytes(folder_ / "job.sh", script.out);

  const Outcome outcome =
      executed({"/bin/sh", (folder_ / "sbatch").string(), (folder_ / "job.sh").string()});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_EQ(count_of(": done in ", outcome.out), 63U);
  EXPECT_EQ(plekton_study({"--collect"}).exit_code, kDone);
  EXPECT_EQ(table().size(), 65U);
}

TEST_F(StudyCommand, SaysWithItsPlaceWhatIsWrongWithAStudyAndMakesNothing) {
  write_study(
      "[grid]\nmaterials.gravel.frictoin_angle = [\"20 deg\"]\n"
      "[results]\nsteps = { report = \"timing.steps\" }\n");

  const Outcome outcome = plekton_study();

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("many.toml:7:"), HasSubstr("none of the 1 runs can be made"),
                    HasSubstr("frictoin_angle"), HasSubstr("did you mean \"friction_angle\"?"),
                    Not(HasSubstr("problems"))));
  EXPECT_TRUE(reports().empty());
}

// It was found after the last run.
TEST_F(StudyCommand, SaysBeforeTheFirstRunWhichResultNoRunHas) {
  const std::string grid = "[grid]\nsimulation.damping = [0]\n[results]\n";
  const auto expect_refused = [&](const std::string& result, const std::string& problem) {
    write_study(grid + result);
    const Outcome outcome = plekton_study();
    EXPECT_EQ(outcome.exit_code, kFailed);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("many.toml:"), HasSubstr(problem)));
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  };

  expect_refused("steps = { report = \"timing.step\" }\n",
                 "results.steps.report: run.json has no \"timing.step\": there is no \"step\"; did "
                 "you mean \"steps\"?");
  expect_refused("force = { column = \"kinetik\" }\n",
                 "results.force.column: energy.csv has no column \"kinetik\"; did you mean "
                 "\"kinetic\"?");
  expect_refused("force = { file = \"reaction.csv\", column = \"floor.force_z\" }\n",
                 "results.force.file: no run writes \"reaction.csv\"; did you mean "
                 "\"reactions.csv\"?");
}

TEST_F(StudyCommand, BeginsNoMoreRunsWhenTheFirstOneDoesNotHaveAResult) {
  write_study(R"(output.reactions = [{ name = "floor", kind = "plane", plane = "floor" }]
[grid]
simulation.seed = [1, 2, 3, 4, 5, 6]
[results]
push = { file = "reactions.csv", column = "floor.force_u" }
)");

  const Outcome first = plekton_study({"--jobs", "1"});
  const Outcome second = plekton_study({"--jobs", "1"});

  for (const Outcome& outcome : {first, second}) {
    EXPECT_EQ(outcome.exit_code, kFailed);
    EXPECT_THAT(outcome.err,
                AllOf(HasSubstr("results.push: reactions.csv has no column \"floor.force_u\""),
                      HasSubstr("no more runs were begun: correct [results] of " + study()),
                      HasSubstr("plekton study " + study() + " --out " + out())));
  }
  EXPECT_EQ(reports().size(), 1U);
  ASSERT_EQ(table().size(), 7U);
  EXPECT_EQ(table()[1].cells[3], "failed");
  EXPECT_EQ(table()[2].cells[3], "missing");
}

// They were missing, without a word of why, as soon as the study that had made them was over.
TEST_F(StudyCommand, CollectsRunsThatFailedBeforeAsFailed) {
  write_study(R"([grid]
simulation.time_step = ["auto", "0.4 ms"]
[results]
steps = { report = "timing.steps" }
)");
  ASSERT_EQ(plekton_study({"--only", "1"}).exit_code, kDone);
  ASSERT_EQ(plekton_study({"--only", "2"}).exit_code, kFailed);

  const Outcome outcome = plekton_study({"--collect"});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.out, HasSubstr("2 runs, 1 complete, 1 failed, 0 missing"));
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("1 of 2 runs failed, the first of them run 2: "),
                                 HasSubstr("plekton study " + study() + " --out " + out() +
                                           " tries them again")));
  ASSERT_EQ(table().size(), 3U);
  EXPECT_EQ(table()[2].cells[3], "failed");
  EXPECT_THAT(table()[2].cells[4], HasSubstr("time_step"));
}

TEST_F(StudyCommand, ReplacesNoTableOfSomebodyElse) {
  write_grid_of_64();
  fs::create_directory(out());
  test::write_bytes(folder_ / "out" / "results.csv", "time,force\n0,1\n");

  const Outcome outcome = plekton_study();

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("is there already and no table of plekton study"));
  EXPECT_EQ(test::bytes_of(folder_ / "out" / "results.csv"), "time,force\n0,1\n");
  EXPECT_TRUE(reports().empty());
}

TEST_F(StudyCommand, RefusesANumberThatIsNoRun) {
  write_grid_of_64();

  EXPECT_THAT(plekton_study({"--only", "65"}).err, HasSubstr("the study has runs 1 to 64"));
}

}  // namespace
}  // namespace plekton::apps::study_command_test

#endif
