// SPDX-License-Identifier: GPL-3.0-or-later
// A run that goes on from any of its checkpoints is the run that was never stopped, to the last
// byte of all that it writes.
#include "apps/run/checkpoints.hpp"
#include "dynamics/checkpoint/checkpoint_file.hpp"
#include "tests/apps/command_line/program_fixture.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <string>
#include <vector>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSameBits = "tests/same_bits/scenes/";
constexpr const char* kScenes = "tests/apps/run/scenes/";

struct Scene {
  const char* name;
  const char* folder;
  const char* duration;  ///< shorter than its own, so that the test takes seconds
};

std::ostream& operator<<(std::ostream& out, const Scene& scene) {
  return out << scene.name;
}

class Resume : public testing::TestWithParam<Scene> {
 protected:
  std::string straight() const { return (folder_ / "straight").string(); }
  std::string stopped() const { return (folder_ / "stopped").string(); }

  /// The whole run, with some six checkpoints.
  Outcome run_straight() const {
    const Scene& scene = GetParam();
    const double duration = std::stod(scene.duration);
    const auto set = [&](const char* key, double part) {
      return std::string("output.") + key + "=\"" + std::to_string(duration / part) + " ms\"";
    };
    return Program({"run", scene.folder + std::string(scene.name) + ".toml", "--quiet", "--out",
                    straight(), "--threads", "1", "--set",
                    "simulation.duration=\"" + std::string(scene.duration) + " ms\"", "--set",
                    set("interval", 9), "--set", set("history_interval", 70), "--set",
                    set("checkpoint_interval", 6.3), "--set", "output.contact_list=true", "--set",
                    "output.hash_interval=50"})
        .wait();
  }

  /// The folder as a kill some time after a checkpoint leaves it, with more rows than the checkpoint
  /// knows and a frame that is listed.
  void stop_after(const fs::path& checkpoint) const {
    fs::remove_all(stopped());
    fs::copy(straight(), stopped(), fs::copy_options::recursive);
    fs::remove(fs::path(stopped()) / "run.json");
    for (const fs::path& file : checkpoints_of(stopped()))
      if (file.filename() > checkpoint.filename()) fs::remove(file);
  }

  void expect_same_files() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(straight()))
      if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), straight()));
    for (const fs::path& file : files) {
      if (file == "run.json") continue;
      EXPECT_EQ(test::bytes_of(straight() / file), test::bytes_of(stopped() / file)) << file;
    }
    std::size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(stopped()))
      count += entry.is_regular_file() ? 1U : 0U;
    EXPECT_EQ(count, files.size());
    const auto report = [](const std::string& folder) {
      std::ifstream file(fs::path(folder) / "run.json");
      return nlohmann::json::parse(file);
    };
    EXPECT_EQ(report(straight())["states"], report(stopped())["states"]);
    EXPECT_EQ(report(straight())["energy"], report(stopped())["energy"]);
    EXPECT_EQ(report(straight())["warnings"], report(stopped())["warnings"]);
  }

  test::TemporaryFolder folder_;
};

TEST_P(Resume, IsTheRunThatWasNotStoppedFromAnyCheckpointWithAnyThreads) {
  const Outcome whole = run_straight();
  ASSERT_EQ(whole.exit_code, kDone) << whole.err;
  const std::vector<fs::path> checkpoints = checkpoints_of(straight());
  ASSERT_GE(checkpoints.size(), 5U);
  int threads = 2;
  for (const fs::path& checkpoint : checkpoints) {
    stop_after(checkpoint);
    const Outcome resumed =
        Program({"run", "--resume", stopped(), "--quiet", "--threads", std::to_string(threads)})
            .wait();
    ASSERT_EQ(resumed.exit_code, kDone) << resumed.err;
    expect_same_files();
    threads = 5 - threads;
    if (HasFailure()) FAIL() << "from " << checkpoint;
  }
}

INSTANTIATE_TEST_SUITE_P(
    , Resume,
    testing::Values(Scene{"catch", kSameBits, "60"}, Scene{"hertz", kSameBits, "40"},
                    Scene{"net", kSameBits, "12"}, Scene{"sheets", kSameBits, "60"},
                    Scene{"tube", kSameBits, "12"}, Scene{"turn", kSameBits, "50"},
                    Scene{"glued", kScenes, "12"}, Scene{"rolling", kScenes, "60"},
                    Scene{"shells", kScenes, "25"}, Scene{"lattice", kScenes, "40"},
                    Scene{"loose", kScenes, "15"}),
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

TEST_F(ResumeErrors, RefuseWhatWouldMakeItAnotherRun) {
  ASSERT_EQ(run().exit_code, kDone);
  const Outcome outcome = resume({"--set", "materials.soil.young_modulus=\"1 MPa\""});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_NE(outcome.err.find("would make it another run"), std::string::npos) << outcome.err;
}

TEST_F(ResumeErrors, TellThatAFolderHasNoCheckpoints) {
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
}

TEST_F(ResumeErrors, VerifyComputesARunAgainAndFindsEveryBit) {
  ASSERT_EQ(run().exit_code, kDone);
  const Outcome last = Program({"verify", out()}).wait();
  const Outcome most = Program({"verify", out(), "--interval", "1.2 ms", "9 ms"}).wait();

  EXPECT_EQ(last.exit_code, kDone) << last.err;
  EXPECT_NE(most.out.find("the same to the last bit"), std::string::npos) << most.out << most.err;
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
}  // namespace plekton::apps
