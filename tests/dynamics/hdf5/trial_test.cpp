// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/hdf5/trial.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>

namespace plekton::dynamics::hdf5::trial_test {
namespace {

TEST(Trial, TellsWhatKillsAProcess) {
  const auto kill = [] { std::raise(SIGSEGV); };
  const auto do_nothing = [] {};
  const auto fail = [] { throw std::runtime_error("no"); };

  EXPECT_TRUE(try_out(kill, 1).was_killed);
  EXPECT_FALSE(try_out(do_nothing, 1).was_killed);
  EXPECT_FALSE(try_out(do_nothing, 1).error);
  EXPECT_FALSE(try_out(fail, 1).was_killed);
  EXPECT_EQ(try_out(fail, 1).error, "no");
}

TEST(Trial, EndsWhatHasNoEnd) {
  const auto go_on = [] {
    for (volatile bool goes_on = true; goes_on;) {
    }
  };

  EXPECT_TRUE(try_out(go_on, 1).was_killed);
}

TEST(Trial, KeepsNothingOfWhatIsDone) {
  int value = 1;
  const auto change = [&] { value = 2; };

  EXPECT_FALSE(try_out(change, 1).was_killed);
  EXPECT_EQ(value, 1);
}

}  // namespace
}  // namespace plekton::dynamics::hdf5::trial_test
