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
                    Scene{"shells", kScenes, "25"}, Scene{"lattice", kScenes, "40"}),
    [](const auto& scene) { return std::string(scene.param.name); });

}  // namespace
}  // namespace plekton::apps
