// SPDX-License-Identifier: GPL-3.0-or-later
// Hashes of the state in run.json, and that the width of vectors does not change them.
#include "geometry/base/vector_width.hpp"
#include "tests/apps/command_line/command_fixture.hpp"

#include <cstdlib>
#include <set>

namespace plekton::apps::same_bits_test {
namespace {

using testing::HasSubstr;

class SameBits : public Command {
 protected:
  /// `plekton run`, in a process that has not yet chosen a width, with one asked for.
  Outcome outcome_with_width(const std::string& width) const {
    const std::string err = (folder_ / "err.txt").string();
    const std::string command = std::string(geometry::kVectorWidthVariable) + "='" + width +
                                "' '" PLEKTON_PROGRAM "' run '" + scenario() + "' --out '" + out() +
                                "' --overwrite --quiet --set output.hash_interval=100 2> '" + err +
                                "'";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, "", test::bytes_of(err)};
  }
};

TEST_F(SameBits, RunTellsHashesOfTheStateAtFixedStepsAndAtTheEnd) {
  outcome_of({"run", scenario(), "--out", out(), "--set", "output.hash_interval=100"});

  const auto json = report();
  const auto states = json["states"];
  const std::int64_t last = json["timing"]["steps"];
  EXPECT_EQ(states["interval_steps"], 100);
  EXPECT_EQ(states["chain"].get<std::string>().size(), 16U);
  std::int64_t expected = 0;
  std::set<std::string> different;
  for (const auto& state : states["step_time_hash"]) {
    EXPECT_EQ(state[0], std::min(expected, last));
    expected += 100;
    different.insert(state[2]);
  }
  EXPECT_GT(last, 300);
  EXPECT_GE(expected, last + 100);
  EXPECT_EQ(different.size(), states["step_time_hash"].size());
  EXPECT_EQ(states["step_time_hash"].back()[1], json["timing"]["simulated_time_s"]);
}

TEST_F(SameBits, RunTellsTheFirstAndTheLastStateUnlessAsked) {
  outcome_of({"run", scenario(), "--out", out()});

  EXPECT_EQ(report()["states"]["interval_steps"], 10000);
  EXPECT_EQ(report()["states"]["step_time_hash"].size(), 2U);
}

TEST_F(SameBits, RunHasTheSameStatesForAnyNumberOfThreads) {
  std::set<std::string> chains;
  for (const std::string threads : {"1", "3"}) {
    outcome_of({"run", scenario(), "--out", out(), "--overwrite", "--threads", threads, "--set",
                "output.hash_interval=100"});
    chains.insert(report()["states"]["chain"]);
  }

  EXPECT_EQ(chains.size(), 1U);
}

TEST_F(SameBits, RunHasTheSameStatesWithEveryWidthOfVectors) {
  std::set<std::string> chains;
  for (const int width : {2, 4, 8}) {
    if (width > geometry::widest_vectors()) continue;
    const Outcome outcome = outcome_with_width(std::to_string(width));
    ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;
    EXPECT_EQ(report()["vector_width"], width);
    chains.insert(report()["states"]["chain"]);
  }

  EXPECT_EQ(chains.size(), 1U);
}

TEST_F(SameBits, RunRefusesAWidthOfVectorsThatIsNotKnown) {
  const Outcome outcome = outcome_with_width("3");

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err,
              HasSubstr("plekton: PLEKTON_VECTOR_WIDTH: \"3\" is no width of vectors"));
  EXPECT_FALSE(std::filesystem::exists(out()));
}

TEST_F(SameBits, RunRefusesAHashIntervalBelowOneStep) {
  EXPECT_THAT(failure_of({"output.hash_interval=0"}).err, HasSubstr("output.hash_interval"));
}

}  // namespace
}  // namespace plekton::apps::same_bits_test
