// SPDX-License-Identifier: GPL-3.0-or-later
// What a run of many steps needs: memory that stays as it is, and counters that go on.
// PLEKTON_LONG_RUN in the environment says how many steps the run has (40,000 if it is not there).
#include "apps/run/checkpoints.hpp"
#include "apps/run/run.hpp"
#include "apps/scenario/scenario_reader.hpp"
#include "dynamics/checkpoint/checkpoint_file.hpp"
#include "tests/apps/command_line/program_fixture.hpp"
#include "tests/apps/run/frequent_outputs.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <malloc.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

/// Of the allocator of a sanitizer, where there is one.
extern "C" [[gnu::weak]] std::size_t __sanitizer_get_current_allocated_bytes();  // NOLINT

namespace plekton::apps::long_run_test {
namespace {

namespace fs = std::filesystem;

/// Bytes that this process has asked for and not given back. Where the allocator does not tell,
/// those that are in memory without pages of files (programs, libraries), which come and go as the
/// system likes.
std::int64_t bytes_in_use() {
  if (__sanitizer_get_current_allocated_bytes != nullptr)
    return static_cast<std::int64_t>(__sanitizer_get_current_allocated_bytes());
  const struct mallinfo2 info = ::mallinfo2();
  const std::size_t in_use = info.uordblks + info.hblkhd;
  if (in_use > 0) return static_cast<std::int64_t>(in_use);
  std::ifstream file("/proc/self/statm");
  std::int64_t all = 0, resident = 0, of_files = 0;
  file >> all >> resident >> of_files;
  return (resident - of_files) * ::sysconf(_SC_PAGESIZE);
}

std::int64_t steps_asked_for() {
  const char* const asked = std::getenv("PLEKTON_LONG_RUN");
  return asked == nullptr ? 40'000 : std::atoll(asked);
}

/// Grains between walls on a sheet that is shaken: contacts come and go, lists are made anew.
constexpr const char* kShaken = R"([simulation]
duration = 1e6
time_step = "10 us"
[materials.sand]
density = "2650 kg/m3"
young_modulus = "5 MPa"
friction_angle = "30 deg"
[[membranes]]
name = "sheet"
shape = { kind = "sheet", width = "8 cm", length = "8 cm", cells = [4, 4] }
mode = "continuum"
young_modulus = "2 MPa"
thickness = "3 mm"
areal_mass = "3 kg/m2"
material = "sand"
[[grains]]
name = "sand"
material = "sand"
count = 20
radius = "5 mm"
velocity = ["0.3 m/s", "0.2 m/s", "-1 m/s"]
box = { min = ["-2 cm", "-2 cm", "2 mm"], max = ["2 cm", "2 cm", "8 cm"] }
[[planes]]
point = ["-25 mm", 0, 0]
normal = [1, 0, 0]
material = "sand"
[[planes]]
point = ["25 mm", 0, 0]
normal = [-1, 0, 0]
material = "sand"
[[planes]]
point = [0, "-25 mm", 0]
normal = [0, 1, 0]
material = "sand"
[[planes]]
point = [0, "25 mm", 0]
normal = [0, -1, 0]
material = "sand"
[[planes]]
point = [0, 0, "10 cm"]
normal = [0, 0, -1]
material = "sand"
[[loads]]
name = "shake"
kind = "motion"
membrane = "sheet"
nodes = "rim"
velocity = [0, 0, "0.3 m/s"]
factor = [FACTORS]
[output]
interval = "10 ms"
history_interval = "0.5 ms"
checkpoint_interval = "20 ms"
contact_list = true
)";

/// Up and down, every 20 ms, for so many steps.
std::string shaken(std::int64_t steps) {
  std::ostringstream factors;
  const auto turns = steps / 2000 + 2;
  for (std::int64_t i = 0; i < turns; ++i)
    factors << (i > 0 ? ", " : "") << "[" << 0.02 * static_cast<double>(i) << ", "
            << (i % 2 == 0 ? 1 : -1) << "]";
  std::string text = kShaken;
  return text.replace(text.find("FACTORS"), 7, factors.str());
}

TEST(LongRun, KeepsItsMemoryAsItIs) {
  const std::int64_t steps = steps_asked_for();
  const test::TemporaryFolder folder;
  const Scenario scenario = parse_scenario(shaken(steps), folder / "shaken.toml", {});
  PreparedRun prepared = prepare_run(scenario);
  std::vector<std::int64_t> in_use;
  std::int64_t step = 0;
  std::ostringstream progress;
  const RunSettings settings{.out = folder / "out",
                             .progress = progress,
                             .style = ProgressStyle::none,
                             .is_interrupted = [&] {
                               if (++step % (steps / 20) == 0) in_use.push_back(bytes_in_use());
                               return step >= steps;
                             }};
  const RunReport report = run(scenario, prepared, settings);

  ASSERT_EQ(report.steps, steps);
  ASSERT_EQ(in_use.size(), 20U);
  EXPECT_EQ(report.lost_grains, 0U);
  for (const std::int64_t bytes : in_use) std::cout << bytes / 1024 << ' ';
  std::cout << "kB\n";
  // Three series of frames have a line of some hundred bytes each for every one, in a text that
  // doubles where it has no room, and is written from a copy.
  const std::int64_t lines = 3 * 100 * 3 * static_cast<std::int64_t>(report.frames);
  EXPECT_LE(in_use.back(), in_use[4] + lines + (std::int64_t{512} << 10));
}

class ManySteps : public testing::Test {
 protected:
  std::string out(const std::string& name) const { return (folder_ / name).string(); }

  /// A run that goes on from one of its checkpoints, which has so many steps more.
  void run_from(const std::string& name, std::int64_t more) const {
    std::vector<std::string> arguments = test::frequent_outputs::arguments(out(name));
    arguments.insert(arguments.end(), {"--set", "simulation.time_step=\"15 us\""});
    ASSERT_EQ(Program(arguments).wait().exit_code, kDone);
    const std::vector<fs::path> checkpoints = checkpoints_of(out(name));
    ASSERT_GT(checkpoints.size(), 10U);
    geometry::StateTree state = dynamics::read_checkpoint(checkpoints[5]);
    for (const fs::path& file : checkpoints) fs::remove(file);
    auto& steps = std::get<std::vector<std::int64_t>>(state.arrays.at("steps").numbers);
    steps[0] += more;
    write_run_checkpoint(out(name), steps[0], state);
    const Outcome outcome = Program({"run", "--resume", out(name), "--quiet"}).wait();
    ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;
  }

  test::TemporaryFolder folder_;
};

/// What is looked at every so many steps is looked at in the same ones: 1024 is a multiple of all.
TEST_F(ManySteps, OfMoreThan32BitsWriteTheSameResults) {
  constexpr std::int64_t kMany = std::int64_t{1} << 32;
  constexpr std::int64_t kMore = kMany - 1024;
  ASSERT_NO_FATAL_FAILURE(run_from("few", 0));
  ASSERT_NO_FATAL_FAILURE(run_from("many", kMore));

  auto few = test::frequent_outputs::contents_of(out("few"));
  auto many = test::frequent_outputs::contents_of(out("many"));
  for (auto* const contents : {&few, &many})
    std::erase_if(*contents, [](const auto& file) { return file.first.ends_with(".h5"); });
  EXPECT_THAT(test::frequent_outputs::differences(few, many), testing::IsEmpty());
  const std::vector<fs::path> few_files = checkpoints_of(out("few"));
  const std::vector<fs::path> many_files = checkpoints_of(out("many"));
  ASSERT_EQ(many_files.size(), few_files.size());
  EXPECT_GT(steps_of(dynamics::read_checkpoint(many_files.back())), kMany);
  for (std::size_t i = 0; i < few_files.size(); ++i)
    EXPECT_EQ(steps_of(dynamics::read_checkpoint(many_files[i])),
              steps_of(dynamics::read_checkpoint(few_files[i])) + kMore);
}

}  // namespace
}  // namespace plekton::apps::long_run_test
