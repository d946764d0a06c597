// SPDX-License-Identifier: GPL-3.0-or-later
// A run that goes on with other outputs than it had.
#include "apps/run/checkpoints.hpp"
#include "tests/apps/command_line/program_fixture.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace plekton::apps::changed_outputs_test {
namespace {

namespace fs = std::filesystem;

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;

/// A grain that rests on a floor, in steps of 50 us. What is written at the end of a run, because it
/// is the end, is not there any more where that goes on.
constexpr const char* kScenario = R"(
[simulation]
duration = "10 ms"
time_step = "50 us"
damping = 0.7
[materials.sand]
density = "2650 kg/m3"
young_modulus = "1 MPa"
friction_angle = "30 deg"
[[grains]]
name = "one"
material = "sand"
radius = "5 mm"
centres = [[0, 0, "4.997 mm"]]
[[planes]]
name = "floor"
point = [0, 0, 0]
material = "sand"
[output]
interval = "10 ms"
history_interval = "5 ms"
checkpoint_interval = "4 ms"
)";
constexpr const char* kFloor = R"(output.reactions=[{ kind = "plane", plane = "floor" }])";
constexpr const char* kNone = "output.reactions=[]";

class ChangedOutputs : public testing::Test {
 protected:
  ChangedOutputs() { test::write_bytes(folder_ / "a.toml", kScenario); }

  std::string out() const { return (folder_ / "out").string(); }

  Outcome call(std::vector<std::string> arguments, const std::vector<std::string>& settings) const {
    for (const std::string& setting : settings)
      arguments.insert(arguments.end(), {"--set", setting});
    return Program(arguments).wait();
  }
  Outcome run(const std::vector<std::string>& settings) const {
    return call({"run", (folder_ / "a.toml").string(), "--quiet", "--out", out()}, settings);
  }
  Outcome resume(const std::vector<std::string>& settings) const {
    return call({"run", "--resume", out(), "--quiet"}, settings);
  }

  /// The times (ms, rounded) of the rows of a history.
  std::vector<int> times(const std::string& file) const {
    std::istringstream rows(test::bytes_of(folder_ / "out" / file));
    std::string row;
    std::getline(rows, row);
    std::vector<int> times;
    while (std::getline(rows, row))
      times.push_back(static_cast<int>(std::lround(1000.0 * std::stod(row))));
    return times;
  }

  std::vector<std::string> checkpoints() const {
    std::vector<std::string> names;
    for (const fs::path& file : checkpoints_of(out())) names.push_back(file.filename());
    return names;
  }

  test::TemporaryFolder folder_;
};

// It ended with SIGSEGV: reactions were due, and there was no file.
TEST_F(ChangedOutputs, NeedNoReactionsAnyMore) {
  ASSERT_EQ(run({kFloor}).exit_code, kDone);
  const Outcome outcome = resume({"simulation.duration=15 ms", kNone});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(times("reactions.csv"), ElementsAre(0, 5));
  EXPECT_THAT(times("energy.csv"), ElementsAre(0, 5, 10, 15));
}

// The first of them was due at the end.
TEST_F(ChangedOutputs, BeginWithReactions) {
  ASSERT_EQ(run({kNone}).exit_code, kDone);
  ASSERT_EQ(resume({"simulation.duration=25 ms", kFloor}).exit_code, kDone);

  EXPECT_THAT(times("reactions.csv"), ElementsAre(15, 20, 25));
}

// What was due next was due as it had been with the interval before, an hour later.
// Also where anything is changed, as what is asked of reactions is compared then.
TEST_F(ChangedOutputs, GoOnWithTheSectionOfAMembrane) {
  test::write_bytes(folder_ / "a.toml", std::string(kScenario) + R"(
[[output.reactions]]
kind = "section"
membrane = "rope"
nodes = "x_min"
[[membranes]]
name = "rope"
shape = { kind = "chain", points = [[0, 1, 1], [1, 1, 1]], divisions = 4 }
mode = "lattice"
thickness = "1 cm"
young_modulus = "1 MPa"
density = "1000 kg/m3"
material = "sand"
)");
  ASSERT_EQ(run({}).exit_code, kDone);

  const Outcome outcome = resume({"simulation.duration=20 ms"});

  EXPECT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(times("reactions.csv"), ElementsAre(0, 5, 10, 15, 20));
}

TEST_F(ChangedOutputs, ComeMoreOftenFromThereOn) {
  ASSERT_EQ(run({"output.interval=1 h", "output.history_interval=1 h"}).exit_code, kDone);
  ASSERT_EQ(resume({"simulation.duration=13 ms", "output.interval=2 ms",
                    "output.history_interval=1 ms", "output.checkpoint_interval=1 ms"})
                .exit_code,
            kDone);

  EXPECT_THAT(times("energy.csv"), ElementsAre(0, 11, 12, 13));
  EXPECT_THAT(times("planes.csv"), ElementsAre(0, 12, 13));
  EXPECT_EQ(checkpoints().size(), 6U);  // at 4, 8, 10, 11, 12 and 13 ms
}

// It was begun anew, and what it had was lost.
TEST_F(ChangedOutputs, GoOnWithAListThatWasOffForAWhile) {
  ASSERT_EQ(run({"output.contact_list=true", "output.interval=5 ms"}).exit_code, kDone);
  ASSERT_EQ(resume({"simulation.duration=15 ms", "output.contact_list=false"}).exit_code, kDone);
  ASSERT_EQ(resume({"simulation.duration=20 ms", "output.contact_list=true"}).exit_code, kDone);

  EXPECT_THAT(times("contacts.csv"), ElementsAre(0, 5, 15, 20));
}

TEST_F(ChangedOutputs, KeepNoRowsFromAfterTheCheckpointOfWhatIsOff) {
  ASSERT_EQ(run({"output.contact_list=true", "output.interval=1 ms"}).exit_code, kDone);
  fs::remove(checkpoints_of(out()).back());
  fs::remove(folder_ / "out/run.json");
  ASSERT_EQ(resume({"output.contact_list=false"}).exit_code, kDone);

  EXPECT_EQ(times("contacts.csv").back(), 8);
}

// run.json was removed before it was known that the run cannot go on.
TEST_F(ChangedOutputs, AreRefusedWhereColumnsAreOthersAndNothingIsLost) {
  ASSERT_EQ(run({kFloor}).exit_code, kDone);
  const std::string report = test::bytes_of(folder_ / "out/run.json");
  const Outcome outcome =
      resume({"simulation.duration=15 ms",
              R"(output.reactions=[{ kind = "plane", plane = "floor", name = "ground" }])"});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("has other columns than the run writes now"));
  EXPECT_EQ(test::bytes_of(folder_ / "out/run.json"), report);
  EXPECT_THAT(times("reactions.csv"), ElementsAre(0, 5, 10));
}

// A checkpoint at the end of a run that was to be shorter took the place of the next one.
TEST_F(ChangedOutputs, HaveTheCheckpointsOfARunThatWasNotStopped) {
  ASSERT_EQ(run({"simulation.duration=16 ms"}).exit_code, kDone);
  const std::vector<std::string> whole = checkpoints();
  fs::remove_all(out());
  ASSERT_EQ(run({"simulation.duration=9 ms"}).exit_code, kDone);
  ASSERT_EQ(resume({"simulation.duration=16 ms"}).exit_code, kDone);

  EXPECT_EQ(whole.size(), 4U);
  EXPECT_THAT(checkpoints(), IsSupersetOf(whole));
}

}  // namespace
}  // namespace plekton::apps::changed_outputs_test
