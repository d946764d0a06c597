// SPDX-License-Identifier: GPL-3.0-or-later
// A run that goes on from any of its checkpoints is the run that was never stopped, to the last
// byte of all that it writes. Each of the scenes is run by 1 and by 4 threads and goes on with 2 and
// 1; with PLEKTON_RESUMES=all in the environment from every checkpoint, otherwise from a few.
#include "apps/run/build_info.hpp"
#include "apps/run/checkpoints.hpp"
#include "dynamics/checkpoint/checkpoint_file.hpp"
#include "tests/apps/command_line/program_fixture.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::apps::resume_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSameBits = "tests/same_bits/scenes/";
constexpr const char* kScenes = "tests/apps/run/scenes/";

struct Scene {
  const char* name;
  const char* folder;
  double duration;          ///< ms, shorter than its own, so that the test takes seconds
  bool has_stages = false;  ///< then it is its own
};

std::ostream& operator<<(std::ostream& out, const Scene& scene) {
  return out << scene.name;
}

bool all_are_asked_for() {
  const char* const asked = std::getenv("PLEKTON_RESUMES");
  return asked != nullptr && std::string_view(asked) == "all";
}

class Resume : public testing::TestWithParam<Scene> {
 protected:
  std::string straight(int threads) const {
    return (folder_ / ("straight_" + std::to_string(threads))).string();
  }
  std::string stopped() const { return (folder_ / "stopped").string(); }

  /// The whole run, with some six checkpoints.
  Outcome run_straight(int threads) const {
    const Scene& scene = GetParam();
    const auto ms = [&](const char* key, double part) {
      return key + ("=\"" + std::to_string(scene.duration / part)) + " ms\"";
    };
    std::vector<std::string> arguments = {"run",
                                          scene.folder + std::string(scene.name) + ".toml",
                                          "--quiet",
                                          "--out",
                                          straight(threads),
                                          "--threads",
                                          std::to_string(threads)};
    for (const std::string& key :
         {ms("output.interval", 9), ms("output.history_interval", 70),
          ms("output.checkpoint_interval", 6.3), std::string("output.contact_list=true"),
          std::string("output.hash_interval=50")})
      arguments.insert(arguments.end(), {"--set", key});
    if (!scene.has_stages)
      arguments.insert(arguments.end(), {"--set", ms("simulation.duration", 1)});
    return Program(arguments).wait();
  }

  /// The folder as a kill some time after a checkpoint leaves it, with more rows than the checkpoint
  /// knows and a frame that is listed.
  void stop_after(const fs::path& checkpoint, int threads) const {
    fs::remove_all(stopped());
    fs::copy(straight(threads), stopped(), fs::copy_options::recursive);
    fs::remove(fs::path(stopped()) / "run.json");
    for (const fs::path& file : checkpoints_of(stopped()))
      if (file.filename() > checkpoint.filename()) fs::remove(file);
  }

  void expect_same_files(const std::string& whole, const std::string& other) const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(whole))
      if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), whole));
    for (const fs::path& file : files) {
      if (file == "run.json" || file == "scenario-as-run.toml") continue;  // they tell the threads
      EXPECT_EQ(test::bytes_of(whole / file), test::bytes_of(other / file)) << file;
    }
    std::size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(other))
      count += entry.is_regular_file() ? 1U : 0U;
    EXPECT_EQ(count, files.size());
    const auto report = [](const std::string& folder) {
      std::ifstream file(fs::path(folder) / "run.json");
      return nlohmann::json::parse(file);
    };
    for (const char* const part : {"states", "energy", "momentum_drift", "warnings"})
      EXPECT_EQ(report(whole)[part], report(other)[part]);
  }

  /// @param threads  of the run that is stopped
  void expect_to_go_on(int threads, const fs::path& checkpoint, int later_threads) const {
    stop_after(checkpoint, threads);
    const Outcome resumed = Program({"run", "--resume", stopped(), "--quiet", "--threads",
                                     std::to_string(later_threads)})
                                .wait();
    ASSERT_EQ(resumed.exit_code, kDone) << resumed.err;
    expect_same_files(straight(1), stopped());
    if (HasFailure()) FAIL() << "from " << checkpoint << " with " << later_threads << " threads";
  }

  test::TemporaryFolder folder_;
};

TEST_P(Resume, IsTheRunThatWasNotStoppedFromAnyCheckpointWithAnyThreads) {
  for (const int threads : {1, 4}) {
    const Outcome whole = run_straight(threads);
    ASSERT_EQ(whole.exit_code, kDone) << whole.err;
  }
  expect_same_files(straight(1), straight(4));
  std::vector<fs::path> checkpoints = checkpoints_of(straight(1));
  ASSERT_GE(checkpoints.size(), 6U);
  checkpoints.pop_back();  // at the end
  const bool all = all_are_asked_for();
  for (std::size_t i = 0; i < checkpoints.size(); ++i) {
    if (all || i % 3 == 1) {
      ASSERT_NO_FATAL_FAILURE(expect_to_go_on(1, checkpoints[i], 2));
    }
    if (all || i == 2) {
      ASSERT_NO_FATAL_FAILURE(expect_to_go_on(4, checkpoints[i], 1));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    , Resume,
    testing::Values(Scene{"catch", kSameBits, 60}, Scene{"net", kSameBits, 12},
                    Scene{"shells", kScenes, 25}, Scene{"cohesive", kScenes, 25},
                    Scene{"hertz", kSameBits, 40}, Scene{"rolling", kScenes, 60},
                    Scene{"servo", kScenes, 30}, Scene{"tube", kSameBits, 12},
                    Scene{"adhesion", kScenes, 8}, Scene{"glued", kScenes, 12},
                    Scene{"turn", kSameBits, 50}, Scene{"boulder", kScenes, 20},
                    Scene{"rigid", kScenes, 30}, Scene{"staged", kScenes, 35, true},
                    Scene{"sheets", kSameBits, 60}, Scene{"lattice", kScenes, 40},
                    Scene{"loose", kScenes, 15}, Scene{"packed", kScenes, 20}),
    [](const auto& scene) { return std::string(scene.param.name); });

/// Two facets under a grain.
constexpr const char* kFacets =
    "OFF\n4 2 0\n0 0 0\n0.1 0 0\n0.1 0.1 0\n0 0.1 0\n3 0 1 2\n3 0 2 3\n";
constexpr const char* kOnFacets = R"(
[simulation]
duration = "5 ms"
[materials.soil]
density = "2650 kg/m3"
young_modulus = "20 MPa"
friction_angle = "30 deg"
[[membranes]]
name = "two"
mesh = "two.off"
thickness = "2 mm"
material = "soil"
young_modulus = "20 MPa"
density = "1000 kg/m3"
hold = "rim"
[[grains]]
name = "one"
material = "soil"
radius = "5 mm"
centres = [["4 cm", "5 cm", "6.2 mm"]]
[output]
checkpoint_interval = "1 ms"
)";

class ResumeErrors : public testing::Test {
 protected:
  ResumeErrors() {
    test::write_bytes(folder_ / "two.off", kFacets);
    test::write_bytes(folder_ / "a.toml", kOnFacets);
  }
  Outcome run() const {
    return Program({"run", (folder_ / "a.toml").string(), "--quiet", "--out", out()}).wait();
  }
  Outcome resume(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"run", "--resume", out(), "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Program(arguments).wait();
  }
  std::string out() const { return (folder_ / "out").string(); }

  test::TemporaryFolder folder_;
};

TEST_F(ResumeErrors, NameAChangedMeshAndLoseNothing) {
  ASSERT_EQ(run().exit_code, kDone);
  const std::string energies = test::bytes_of(folder_ / "out/energy.csv");
  std::string moved = kFacets;
  moved.replace(moved.find("0.1 0.1"), 7, "0.1 0.2");
  test::write_bytes(folder_ / "two.off", moved);
  const Outcome outcome = resume({"--set", "simulation.duration=10 ms"});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_NE(outcome.err.find("another scene"), std::string::npos) << outcome.err;
  EXPECT_EQ(test::bytes_of(folder_ / "out/energy.csv"), energies);
  EXPECT_TRUE(fs::exists(folder_ / "out/run.json"));
}

// A run knows its file by its whole path once it goes on.
TEST_F(ResumeErrors, WarnOnceOfAScenarioThatWasNamedFromTheCurrentFolder) {
  test::write_bytes(folder_ / "a.toml", std::string(kOnFacets) + R"(
[[contacts]]
between = "soil"
and = "soil"
law = "cohesive_frictional"
)");
  const std::string file = fs::relative(folder_ / "a.toml").string();
  ASSERT_EQ(Program({"run", file, "--quiet", "--out", out()}).wait().exit_code, kDone);
  const fs::path last = checkpoints_of(out()).back();
  const std::string bytes = test::bytes_of(last);
  fs::remove(last);
  ASSERT_EQ(resume().exit_code, kDone);

  const auto report = nlohmann::json::parse(test::bytes_of(folder_ / "out/run.json"));
  const auto& warnings = report["warnings"];
  EXPECT_EQ(std::count_if(warnings.begin(), warnings.end(),
                          [](const nlohmann::json& warning) {
                            return warning.get<std::string>().find("glue nothing") !=
                                   std::string::npos;
                          }),
            1)
      << warnings;
  EXPECT_TRUE(test::bytes_of(last) == bytes);
}

TEST_F(ResumeErrors, GoOnFromTheCheckpointBeforeADamagedOne) {
  ASSERT_EQ(run().exit_code, kDone);
  const std::vector<fs::path> checkpoints = checkpoints_of(out());
  const std::string last = test::bytes_of(checkpoints.back());
  test::write_bytes(checkpoints.back(), last.substr(0, last.size() / 2));
  const Outcome outcome = resume();

  EXPECT_EQ(outcome.exit_code, kDone);
  EXPECT_NE(outcome.err.find("is damaged"), std::string::npos) << outcome.err;
  EXPECT_EQ(test::bytes_of(checkpoints.back()), last);
}

/// As a power cut may leave it where the disk does not keep its word.
TEST_F(ResumeErrors, GoOnFromTheCheckpointThatKnowsNoMoreRowsThanThereAre) {
  ASSERT_EQ(run().exit_code, kDone);
  const fs::path energies = folder_ / "out/energy.csv";
  const std::string whole = test::bytes_of(energies);
  const fs::path last = checkpoints_of(out()).back();
  const std::string checkpoint = test::bytes_of(last);
  fs::resize_file(energies, whole.size() - 10);
  const Outcome outcome = resume();

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_NE(outcome.err.find("energy.csv has " + std::to_string(whole.size() - 10) +
                             " bytes, fewer than the "),
            std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("goes on from an earlier checkpoint"), std::string::npos);
  EXPECT_EQ(test::bytes_of(energies), whole);
  EXPECT_EQ(test::bytes_of(last), checkpoint);
}

TEST_F(ResumeErrors, TellThatNoCheckpointGoesOnWithTheFilesThatThereAre) {
  ASSERT_EQ(run().exit_code, kDone);
  fs::remove(folder_ / "out/energy.csv");
  const Outcome outcome = resume();

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_NE(outcome.err.find("is not there any more"), std::string::npos) << outcome.err;
}

TEST_F(ResumeErrors, WarnOfACheckpointOfAnotherRevision) {
  ASSERT_EQ(run().exit_code, kDone);
  const std::string revision(build_info().revision);
  EXPECT_EQ(resume({"--set", "simulation.duration=6 ms"}).err.find("revision"), std::string::npos);
  const fs::path last = checkpoints_of(out()).back();
  std::string bytes = test::bytes_of(last);
  bytes.replace(bytes.find("revision ") + 9, 1, "?");
  test::write_bytes(last, bytes);
  const Outcome outcome = resume({"--set", "simulation.duration=7 ms"});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_NE(outcome.err.find("was written by revision ?"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("this is " + revision), std::string::npos) << outcome.err;
}

TEST_F(ResumeErrors, RefuseWhatWouldMakeItAnotherRun) {
  ASSERT_EQ(run().exit_code, kDone);
  const Outcome outcome = resume({"--set", "materials.soil.young_modulus=\"1 MPa\""});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_NE(outcome.err.find("would make it another run"), std::string::npos) << outcome.err;
}

// Tables of keys that may change were refused with "may change simulation.duration, ... and stop".
TEST_F(ResumeErrors, TakeTablesOfWhatMayChange) {
  ASSERT_EQ(run().exit_code, kDone);
  const std::string part = (folder_ / "part").string();
  for (const std::string table : {"stop={kinetic_energy=\"1e-3 J\"}", "output={interval=\"1 ms\"}",
                                  "simulation={duration=\"6 ms\"}"}) {
    const Outcome outcome =
        resume({"--from", "2 ms", "--out", part, "--overwrite", "--set", table});
    EXPECT_EQ(outcome.exit_code, kDone) << table << ": " << outcome.err;
  }
  const Outcome other = resume({"--set", "simulation={duration=\"6 ms\", damping=0.3}"});

  EXPECT_EQ(other.exit_code, kFailed);
  EXPECT_NE(other.err.find("as simulation.damping is another"), std::string::npos) << other.err;
}

// A column or file went on with another wall or region under its old name.
TEST_F(ResumeErrors, NameOutputsThatWouldGoOnWithAnotherThing) {
  test::write_bytes(folder_ / "a.toml", std::string(kOnFacets) + R"(
[[output.reactions]]
name = "edge"
kind = "support"
membrane = "two"
nodes = "x_min"
[[output.measures]]
name = "core"
sphere = { centre = [0, 0, 0], radius = "1 cm" }
)");
  ASSERT_EQ(run().exit_code, kDone);
  const std::string report = test::bytes_of(folder_ / "out/run.json");
  const auto resume_with = [&](const std::string& value, std::vector<std::string> more = {}) {
    more.insert(more.end(), {"--set", "simulation.duration=6 ms", "--set", value});
    return resume(std::move(more));
  };
  const std::string side = "output.reactions.edge.nodes=\"x_max\"";
  const std::string wider = "output.measures.core.sphere.radius=\"20 mm\"";

  const Outcome other_side = resume_with(side), other_region = resume_with(wider);
  EXPECT_EQ(other_side.exit_code, kFailed);
  EXPECT_NE(other_side.err.find("output.reactions: \"edge\" in reactions.csv is of the supports of "
                                "x_min of membrane \"two\" so far, and would go on with the "
                                "supports of x_max of membrane \"two\"; give that another name"),
            std::string::npos)
      << other_side.err;
  EXPECT_EQ(other_region.exit_code, kFailed);
  EXPECT_NE(other_region.err.find("\"core\" in measures/core.csv is of the sphere around [0, 0, 0] "
                                  "with radius 0.01 m so far, and would go on with the sphere "
                                  "around [0, 0, 0] with radius 0.02 m"),
            std::string::npos)
      << other_region.err;
  EXPECT_EQ(test::bytes_of(folder_ / "out/run.json"), report);
  EXPECT_EQ(resume_with(side, {"--out", (folder_ / "part").string()}).exit_code, kDone);
  EXPECT_EQ(resume_with("output.measures.core.sphere.radius=\"10 mm\"").exit_code, kDone);
}

// It was said to have no checkpoints.
TEST_F(ResumeErrors, TellThatAFolderIsNotThere) {
  for (const std::string& file : {out(), (folder_ / "a.toml").string()}) {
    const std::string problem =
        file == out() ? "there is no such folder; name the folder of a run" : "is no folder";
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"run", "--resume", file},
          {"verify", file},
          {"export-ondem", file}}) {
      const Outcome outcome = Program(command).wait();

      EXPECT_EQ(outcome.exit_code, kFailed);
      EXPECT_NE(outcome.err.find(file + ": " + problem), std::string::npos) << outcome.err;
    }
  }
}

// Only a run that goes on told so.
TEST_F(ResumeErrors, TellThatAnEarlierCheckpointIsTakenThanADamagedOne) {
  ASSERT_EQ(run().exit_code, kDone);
  const std::vector<fs::path> checkpoints = checkpoints_of(out());
  test::write_bytes(checkpoints.back(), test::bytes_of(checkpoints.back()).substr(0, 2000));
  const std::string taken = "plekton: warning: " + checkpoints[checkpoints.size() - 2].string() +
                            ": is taken instead, an earlier checkpoint\n";

  for (const char* command : {"inspect", "verify", "export-ondem"}) {
    const Outcome outcome = Program({command, out()}).wait();

    EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
    EXPECT_NE(outcome.err.find(checkpoints.back().string() + ": is damaged"), std::string::npos)
        << command << ": " << outcome.err;
    EXPECT_NE(outcome.err.find(taken), std::string::npos) << command << ": " << outcome.err;
  }
}

TEST_F(ResumeErrors, TellThatAFolderHasNoCheckpoints) {
  fs::create_directory(out());
  const Outcome outcome = resume();

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_NE(outcome.err.find("has no checkpoints"), std::string::npos) << outcome.err;
}

TEST_F(ResumeErrors, GoBeyondTheDurationThatWasAskedForAtFirst) {
  ASSERT_EQ(run().exit_code, kDone);
  ASSERT_EQ(resume({"--set", "simulation.duration=8 ms"}).exit_code, kDone);

  std::ifstream file(folder_ / "out/run.json");
  const auto report = nlohmann::json::parse(file);
  EXPECT_EQ(report["timing"]["simulated_time_s"], 0.008);
  EXPECT_EQ(report["resumed_s"], 0.005);
  // It went on saying what was asked for at first.
  EXPECT_NE(test::bytes_of(folder_ / "out/scenario-as-run.toml")
                .find("# --set simulation.duration=8 ms\n"),
            std::string::npos);
}

/// The bytes of all files in a folder, by name.
std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[entry.path().string()] = test::bytes_of(entry.path());
  return files;
}

// Frames and rows of after the checkpoint were cut before the columns were looked at.
TEST_F(ResumeErrors, RefuseOtherColumnsBeforeAnythingIsCut) {
  test::write_bytes(folder_ / "a.toml",
                    std::string(kOnFacets) +
                        "interval = \"3 ms\"\nhistory_interval = \"3 ms\"\n"
                        "[[output.reactions]]\nname = \"edge\"\nkind = \"support\"\n"
                        "membrane = \"two\"\nnodes = \"x_min\"\n");
  ASSERT_EQ(run().exit_code, kDone);
  const auto before = files_in(out());

  const Outcome outcome = resume(
      {"--set", "simulation.duration=9 ms", "--set",
       "output.reactions=[{name=\"other\", kind=\"support\", membrane=\"two\", nodes=\"x_max\"}]"});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_NE(outcome.err.find("reactions.csv: has other columns than the run writes now"),
            std::string::npos)
      << outcome.err;
  EXPECT_EQ(files_in(out()), before);
}

// Its step, cut to the duration, was then taken for one that had been given.
TEST_F(ResumeErrors, GoOnChoosingStepsAfterARunThatWasShorterThanOne) {
  ASSERT_EQ(run().exit_code, kDone);
  const auto steps_of = [&] {
    return nlohmann::json::parse(test::bytes_of(folder_ / "out/run.json"))["timing"]["steps"]
        .get<double>();
  };
  const double straight = steps_of();
  fs::remove_all(out());
  ASSERT_EQ(Program({"run", (folder_ / "a.toml").string(), "--quiet", "--out", out(), "--set",
                     "simulation.duration=1 us"})
                .wait()
                .exit_code,
            kDone);

  ASSERT_EQ(resume({"--set", "simulation.duration=5 ms"}).exit_code, kDone);

  EXPECT_NEAR(steps_of(), straight, 2.0);
}

// It went on from its end to an earlier one, and told of success.
TEST_F(ResumeErrors, RefuseAnEndThatIsOver) {
  ASSERT_EQ(run().exit_code, kDone);

  const Outcome shorter = resume({"--set", "simulation.duration=2 ms"});
  const Outcome part = resume({"--to", "2 ms", "--out", (folder_ / "part").string()});

  EXPECT_EQ(shorter.exit_code, kFailed);
  EXPECT_NE(shorter.err.find("the run is at 0.005 s already"), std::string::npos) << shorter.err;
  EXPECT_EQ(part.exit_code, kFailed);
  EXPECT_NE(part.err.find("give --from with a time before it"), std::string::npos) << part.err;
  EXPECT_FALSE(fs::exists(folder_ / "part"));
}

// A part that was computed again took the place of the run that it was a part of.
TEST_F(ResumeErrors, KeepTheRunThatAPartIsComputedFrom) {
  ASSERT_EQ(run().exit_code, kDone);
  fs::create_directory_symlink("out", folder_ / "link");
  const std::string energies = test::bytes_of(folder_ / "out/energy.csv");
  const std::vector<fs::path> checkpoints = checkpoints_of(out());

  for (const std::string& place : {out(), (folder_ / "link").string()}) {
    const Outcome part = resume({"--from", "2 ms", "--out", place, "--overwrite"});

    EXPECT_EQ(part.exit_code, kFailed);
    EXPECT_NE(part.err.find("--resume: " + out() + " is to be kept; give another folder"),
              std::string::npos)
        << part.err;
  }
  EXPECT_EQ(test::bytes_of(folder_ / "out/energy.csv"), energies);
  EXPECT_EQ(checkpoints_of(out()), checkpoints);
}

/// Output that was not asked for at first: the rows at the same times have the same digits.
TEST_F(ResumeErrors, ComputeAPartOfARunAgainWithOtherOutput) {
  ASSERT_EQ(run().exit_code, kDone);
  const fs::path part = folder_ / "part";
  const Outcome outcome = resume({"--out", part.string(), "--from", "1.5 ms", "--to", "4 ms",
                                  "--set", "output.history_interval=\"1e-4 s\""});
  ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;

  const auto rows_of = [](const fs::path& file) {
    std::istringstream text(test::bytes_of(file));
    std::vector<std::string> rows;
    for (std::string row; std::getline(text, row);) rows.push_back(row);
    return rows;
  };
  const std::vector<std::string> whole = rows_of(folder_ / "out/energy.csv");
  const std::vector<std::string> again = rows_of(part / "energy.csv");
  EXPECT_GE(again.size(), 20U);
  EXPECT_GE(std::stod(again[1]), 0.001);
  EXPECT_NEAR(std::stod(again.back()), 0.004, 1e-4);
  EXPECT_EQ(again.front(), whole.front());
  EXPECT_GE(
      std::count_if(again.begin() + 1, again.end(),
                    [&](const std::string& row) { return std::ranges::count(whole, row) == 1; }),
      2);
}

// The checkpoint that is due at 1 ms is of the first step after it, and was refused as later.
TEST_F(ResumeErrors, GoOnFromTheCheckpointOfTheStepInWhichATimeLies) {
  ASSERT_EQ(run().exit_code, kDone);
  const geometry::StateTree first = dynamics::read_checkpoint(checkpoints_of(out()).front());
  ASSERT_GT(time_of(first), 0.001);
  const std::string steps = ", steps " + std::to_string(steps_of(first)) + " to ";
  const auto again = [&](const char* from, const char* to) {
    return resume(
        {"--out", (folder_ / "part").string(), "--overwrite", "--from", from, "--to", to});
  };

  const Outcome verified = Program({"verify", out(), "--interval", "1 ms", "2 ms"}).wait();
  const Outcome exported = Program({"export-ondem", out(), "--at", "1 ms"}).wait();
  const Outcome resumed = again("1 ms", "2 ms");
  const Outcome early = again("0.9 ms", "2 ms");
  const Outcome short_one = again("2 ms", "2.001 ms");

  EXPECT_EQ(verified.exit_code, kDone) << verified.err;
  EXPECT_NE(verified.out.find(steps), std::string::npos) << verified.out;
  EXPECT_EQ(exported.exit_code, kDone) << exported.err;
  EXPECT_EQ(resumed.exit_code, kDone) << resumed.err;
  EXPECT_EQ(early.exit_code, kFailed);
  EXPECT_NE(early.err.find("its first checkpoint comes after 0.0009 s, at 0.0010"),
            std::string::npos)
      << early.err;
  EXPECT_EQ(short_one.exit_code, kDone) << short_one.err;
}

// Only the damaged one was told.
TEST_F(ResumeErrors, TellOfATimeBeforeAllCheckpointsThoughOneIsDamaged) {
  ASSERT_EQ(run().exit_code, kDone);
  test::write_bytes(checkpoints_of(out()).back(), "");
  const Outcome outcome = Program({"export-ondem", out(), "--at", "0.5 ms"}).wait();

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_NE(outcome.err.find("its first checkpoint comes after 0.0005 s"), std::string::npos)
      << outcome.err;
}

/// Where its step is the last one there would be nothing to compute.
TEST_F(ResumeErrors, GoOnFromBeforeTheCheckpointInWhoseStepTheRunEnds) {
  ASSERT_EQ(run().exit_code, kDone);
  const fs::path part = folder_ / "part";
  const Outcome outcome = resume({"--out", part.string(), "--from", "4.999 ms"});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_GE(test::bytes_of(part / "energy.csv").size(), 100U);
}

TEST_F(ResumeErrors, InspectTellsWhatACheckpointHolds) {
  ASSERT_EQ(run().exit_code, kDone);
  const fs::path last = checkpoints_of(out()).back();
  const Outcome outcome = Program({"inspect", last.string()}).wait();

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  const std::string revision = ", revision " + std::string(build_info().revision) + "\n";
  EXPECT_NE(outcome.out.find(revision), std::string::npos) << outcome.out;
  for (const char* told : {": checkpoint of version ", "time 0.005 s, step ", "a.toml", " 5 nodes",
                           " 2 facets", "hash of the checkpoint ", " arrays, which --all lists\n"})
    EXPECT_NE(outcome.out.find(told), std::string::npos) << told << " in\n" << outcome.out;
  EXPECT_EQ(Program({"inspect", out()}).wait().out, outcome.out) << "of a folder its last one";
  const Outcome all = Program({"inspect", last.string(), "--all"}).wait();
  EXPECT_LT(std::ranges::count(outcome.out, '\n'), 24) << "more than a screen:\n" << outcome.out;
  EXPECT_NE(all.out.find("nodes/velocity "), std::string::npos) << all.out;
  const Outcome other = Program({"inspect", (folder_ / "two.off").string()}).wait();
  EXPECT_EQ(other.exit_code, kFailed);
  EXPECT_NE(other.err.find("no checkpoint of Plekton"), std::string::npos) << other.err;
}

TEST_F(ResumeErrors, VerifyComputesARunAgainAndFindsEveryBit) {
  ASSERT_EQ(run().exit_code, kDone);
  const Outcome last = Program({"verify", out()}).wait();
  const Outcome most = Program({"verify", out(), "--interval", "1.2 ms", "5 ms"}).wait();

  EXPECT_EQ(last.exit_code, kDone) << last.err;
  EXPECT_NE(most.out.find("the same to the last bit"), std::string::npos) << most.out << most.err;
}

// Another part of the run was verified, or computed, and told of as if it were that.
TEST_F(ResumeErrors, RefuseTimesThatTheRunHasNot) {
  ASSERT_EQ(run().exit_code, kDone);
  const auto refusal_of = [&](const std::vector<std::string>& arguments) {
    const Outcome outcome = Program(arguments).wait();
    EXPECT_EQ(outcome.exit_code, kFailed) << outcome.out;
    return outcome.err;
  };
  const std::string part = (folder_ / "part").string();

  EXPECT_NE(refusal_of({"verify", out(), "--interval", "4 ms", "2 ms"})
                .find("--interval: got \"4 ms\" \"2 ms\"; expected a second time after the first"),
            std::string::npos);
  for (const std::string begin : {"2 ms", "9 ms"}) {
    const std::string error = refusal_of({"verify", out(), "--interval", begin, "10 ms"});
    EXPECT_NE(error.find("--interval: got \"" + (begin == "2 ms" ? std::string("10 ms") : begin) +
                         "\"; expected times up to the last checkpoint of the run, which is of "
                         "0.005 s"),
              std::string::npos)
        << error;
  }
  const std::string beyond =
      refusal_of({"run", "--resume", out(), "--from", "2 ms", "--to", "9 ms", "--out", part});
  EXPECT_NE(beyond.find("--to: got \"9 ms\"; expected a time up to the end of the run, 0.005 s"),
            std::string::npos)
      << beyond;
  EXPECT_FALSE(fs::exists(part));
}

// It was said to be of another build.
TEST_F(ResumeErrors, VerifyComputesWhatALongerDurationAdded) {
  ASSERT_EQ(run().exit_code, kDone);
  ASSERT_EQ(resume({"--set", "simulation.duration=8 ms"}).exit_code, kDone);

  const Outcome after = Program({"verify", out(), "--interval", "5 ms", "8 ms"}).wait();
  const Outcome over = Program({"verify", out(), "--interval", "4 ms", "8 ms"}).wait();

  EXPECT_EQ(after.exit_code, kDone) << after.out;
  EXPECT_EQ(over.exit_code, kFailed);
  EXPECT_NE(over.out.find("was given a longer duration"), std::string::npos) << over.out;
}

/// A checkpoint of one run put into the folder of another.
TEST_F(ResumeErrors, VerifySeesThatARunIsAnother) {
  ASSERT_EQ(run().exit_code, kDone);
  const fs::path last = checkpoints_of(out()).back();
  geometry::StateTree state = dynamics::read_checkpoint(last);
  std::get<std::vector<double>>(state.arrays["nodes/velocity"].numbers).back() *= 1.0 + 1e-15;
  dynamics::write_checkpoint(last, state);
  const Outcome outcome = Program({"verify", out()}).wait();

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_NE(outcome.out.find("nodes/velocity"), std::string::npos) << outcome.out << outcome.err;
}

}  // namespace
}  // namespace plekton::apps::resume_test
