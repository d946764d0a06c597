// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/sign_totals.hpp"

#include "geometry/base/thread_pool.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace plekton::geometry::sign_totals_test {
namespace {

/// A right angle, of products that need rounding: only exact arithmetic tells.
int decided_exactly() {
  return sign_past_vertex({0, 0, 0}, {0.1, 0.3, 0}, {-0.3, 0.1, 0});
}

TEST(SignTotals, LeaveOutWhatADoubleDecides) {
  const SignCounters before = sign_totals();

  EXPECT_EQ(sign_past_vertex({0, 0, 0}, {1, 0, 0}, {0.5, 2, 0}), 1);

  EXPECT_EQ(sign_totals().double_double, before.double_double);
}

TEST(SignTotals, HaveWhatLivingAndEndedThreadsHaveCounted) {
  const SignCounters before = sign_totals();
  const SignCounters own = sign_counters();
  decided_exactly();
  const std::uint64_t of_one = sign_counters().double_double - own.double_double;
  ASSERT_EQ(of_one, 1U);

  std::thread([] { decided_exactly(); }).join();
  ThreadPool pool(3);
  pool.for_each_range(30, [](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) decided_exactly();
  });

  EXPECT_EQ(sign_totals().double_double - before.double_double, 32U);
}

TEST(SignTotals, TellStagesApart) {
  const SignCounters before = sign_totals();

  sign_past_vertex({0, 0, 0}, {1, 2, 0},
                   {-2, 1, 0});  // small integers: the interval is the point 0
  decided_exactly();
  const SignCounters after = sign_totals();

  EXPECT_EQ(after.double_double - before.double_double, 2U);
  EXPECT_EQ(after.interval - before.interval, 2U);
  EXPECT_EQ(after.exact - before.exact, 1U);
}

/// Under the thread sanitizer this is a test of races.
TEST(SignTotals, MayBeAskedForWhileOthersCount) {
  const SignCounters before = sign_totals();
  std::thread other([] {
    for (int i = 0; i < 1000; ++i) decided_exactly();
  });
  std::uint64_t seen = before.double_double;
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t now = sign_totals().double_double;
    EXPECT_GE(now, seen);
    seen = now;
  }
  other.join();

  EXPECT_EQ(sign_totals().double_double - before.double_double, 1000U);
}

}  // namespace
}  // namespace plekton::geometry::sign_totals_test
