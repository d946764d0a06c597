// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/study/run_key.hpp"

#include "apps/scenario/problems.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace plekton::apps::run_key_test {
namespace {

constexpr const char* kText = "[simulation]\nduration = \"1 s\"\n[[membranes]]\nmesh = \"a.off\"\n";

class RunKey : public testing::Test {
 protected:
  RunKey() { test::write_bytes(folder_ / "a.off", "OFF"); }

  std::string key(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return RunKeys(folder_ / "case.toml").key_of(text, overrides);
  }

  test::TemporaryFolder folder_;
};

TEST_F(RunKey, DependsOnNothingThatTheResultDoesNotDependOn) {
  const std::string same = key(kText);

  EXPECT_EQ(same.size(), 16U);
  EXPECT_EQ(key(std::string("# a comment\n") + kText + "\n\n"), same);
  EXPECT_EQ(key(kText, {"simulation.threads=2"}), same);
  EXPECT_EQ(key(kText, {"simulation.duration=1 s"}), same);
}

TEST_F(RunKey, IsAnotherOneForEveryOtherRun) {
  const std::string before = key(kText);

  EXPECT_NE(key(kText, {"simulation.duration=2 s"}), before);
  EXPECT_NE(key(kText, {"simulation.seed=2"}), before);
  EXPECT_NE(key(kText, {"simulation.seed=\"2\""}), key(kText, {"simulation.seed=2"}));
  test::write_bytes(folder_ / "a.off", "OFG");
  EXPECT_NE(key(kText), before);
}

TEST_F(RunKey, NeedsATextThatIsToml) {
  EXPECT_THROW(key("[simulation"), InputError);
  EXPECT_THROW(key(kText, {"simulation.duration.x=1"}), InputError);
}

}  // namespace
}  // namespace plekton::apps::run_key_test
