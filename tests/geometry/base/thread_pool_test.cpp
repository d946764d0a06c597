// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/thread_pool.hpp"

#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace plekton::geometry::thread_pool_test {
namespace {

struct Part {
  std::size_t begin;
  std::size_t end;
};

/// The part each worker was given.
std::vector<Part> parts_of(ThreadPool& pool, std::size_t count) {
  constexpr Part kNotCalled{1, 0};
  std::vector<Part> parts(static_cast<std::size_t>(pool.thread_count()), kNotCalled);
  pool.for_each_range(count, [&](std::size_t begin, std::size_t end, int worker) {
    parts[static_cast<std::size_t>(worker)] = {begin, end};
  });
  return parts;
}

class ThreadPools : public testing::TestWithParam<int> {
 protected:
  ThreadPool pool{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(ThreadCounts, ThreadPools, testing::Values(1, 2, 4, 7),
                         testing::PrintToStringParamName());

TEST_P(ThreadPools, HaveTheThreadsAskedFor) {
  EXPECT_EQ(pool.thread_count(), GetParam());
}

TEST_P(ThreadPools, GiveEveryWorkerOneOfNearlyEqualPartsThatFollowEachOther) {
  for (const std::size_t count : {1u, 2u, 3u, 6u, 7u, 8u, 1000u, 1001u}) {
    SCOPED_TRACE(count);
    const std::vector<Part> parts = parts_of(pool, count);

    std::size_t next = 0;
    for (const Part& part : parts) {
      const std::size_t length = part.end - part.begin;
      EXPECT_EQ(part.begin, next);
      EXPECT_GE(length, count / parts.size());
      EXPECT_LE(length, count / parts.size() + 1);
      next = part.end;
    }
    EXPECT_EQ(next, count);
  }
}

TEST_P(ThreadPools, ShareACountNearTheLargestNumberWithoutOverflow) {
  const std::size_t count = static_cast<std::size_t>(-1);

  const std::vector<Part> parts = parts_of(pool, count);

  EXPECT_EQ(parts.front().begin, 0u);
  EXPECT_EQ(parts.back().end, count);
  for (std::size_t k = 1; k < parts.size(); ++k) EXPECT_EQ(parts[k].begin, parts[k - 1].end);
}

TEST_P(ThreadPools, RunTheFirstPartOnTheCallersThreadAndNoMoreThreadsThanTheProcessorsHaveRoomFor) {
  std::vector<std::thread::id> ids(static_cast<std::size_t>(pool.thread_count()));
  std::set<std::thread::id> all;
  for (int round = 0; round < 100; ++round) {
    pool.for_each_range(1, [&](std::size_t, std::size_t, int worker) {
      ids[static_cast<std::size_t>(worker)] = std::this_thread::get_id();
    });
    EXPECT_EQ(ids.front(), std::this_thread::get_id());
    all.insert(ids.begin(), ids.end());
  }

  EXPECT_LE(all.size(),
            std::min<std::size_t>(ids.size(), std::max(2U, std::thread::hardware_concurrency())));
}

TEST_P(ThreadPools, HandEachLoopTheResultsOfTheLoopBefore) {
  std::vector<int> values(1000, 0);
  std::vector<int> reversed(1000, 0);

  for (int round = 0; round < 500; ++round) {
    pool.for_each_range(values.size(), [&](std::size_t begin, std::size_t end, int) {
      for (std::size_t i = begin; i < end; ++i) reversed[i] = values[values.size() - 1 - i] + 1;
    });
    std::swap(values, reversed);
  }

  EXPECT_EQ(values, std::vector<int>(1000, 500));
}

TEST_P(ThreadPools, WakeAgainAfterALongPause) {
  for (int round = 0; round < 3; ++round) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    std::atomic<int> calls = 0;

    pool.for_each_range(3, [&](std::size_t, std::size_t, int) { ++calls; });

    EXPECT_EQ(calls, pool.thread_count());
  }
}

TEST_P(ThreadPools, WaitForASlowWorker) {
  const int slow = pool.thread_count() - 1;
  bool done = false;

  pool.for_each_range(10, [&](std::size_t, std::size_t, int worker) {
    if (worker != slow) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    done = true;
  });

  EXPECT_TRUE(done);
}

TEST_P(ThreadPools, ThrowWhatTheLowestFailingWorkerThrewAfterAllHaveEnded) {
  const int lowest = std::min(1, pool.thread_count() - 1);
  std::atomic<int> calls = 0;
  const auto fail = [&](std::size_t, std::size_t, int worker) {
    ++calls;
    if (worker >= lowest) throw std::runtime_error("worker " + std::to_string(worker));
  };

  try {
    pool.for_each_range(100, fail);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()), "worker " + std::to_string(lowest));
  }
  EXPECT_EQ(calls, pool.thread_count());
}

TEST_P(ThreadPools, WorkAsBeforeAfterAnException) {
  const auto fail = [](std::size_t, std::size_t, int) { throw std::runtime_error("all of them"); };
  EXPECT_THROW(pool.for_each_range(1, fail), std::runtime_error);
  EXPECT_THROW(pool.for_each_range(3, fail), std::runtime_error);

  const std::vector<Part> parts = parts_of(pool, 10);

  EXPECT_EQ(parts.back().end, 10u);
}

TEST_P(ThreadPools, TakeAConstantBodyAndATemporaryOne) {
  std::atomic<std::size_t> covered = 0;
  const auto body = [&](std::size_t begin, std::size_t end, int) { covered += end - begin; };

  pool.for_each_range(5, body);
  pool.for_each_range(6, [&](std::size_t begin, std::size_t end, int) { covered += end - begin; });

  EXPECT_EQ(covered, 11u);
}

TEST_P(ThreadPools, CallNobodyWhereThereIsNothingToDo) {
  pool.for_each_range(0, [](std::size_t, std::size_t, int) { FAIL(); });
  pool.for_each_shared(0, [](std::size_t, int) { FAIL(); });
}

TEST_P(ThreadPools, GoThroughASharedLoopOnceForEveryIndex) {
  for (const std::size_t count : {1u, 2u, 5u, 1000u}) {
    std::vector<std::atomic<int>> calls(count);

    for (int round = 0; round < 20; ++round) {
      pool.for_each_shared(count, [&](std::size_t index, int worker) {
        EXPECT_GE(worker, 0);
        EXPECT_LT(worker, pool.thread_count());
        ++calls[index];
      });
    }

    for (const std::atomic<int>& of_index : calls) EXPECT_EQ(of_index, 20);
  }
}

TEST_P(ThreadPools, ThrowWhatTheBodyOfASharedLoopThrew) {
  const auto loop = [&] {
    pool.for_each_shared(100, [](std::size_t index, int) {
      if (index == 57) throw std::runtime_error("57");
    });
  };
  for (int round = 0; round < 3; ++round) EXPECT_THROW(loop(), std::runtime_error);
}

TEST(ThreadPool, GivesWhatALateWorkerHasNotBegunToTheOthers) {
  ThreadPool pool(2);
  std::vector<int> worker_of(20, -1);
  std::atomic<int> others = 0;

  // The first of worker 0's ten indices takes until worker 1 has done the other nine.
  pool.for_each_shared(worker_of.size(), [&](std::size_t index, int worker) {
    worker_of[index] = worker;
    if (index == 0) {
      while (others < 19) std::this_thread::yield();
    } else {
      ++others;
    }
  });

  EXPECT_EQ(worker_of[0], 0);
  for (std::size_t index = 1; index < worker_of.size(); ++index) EXPECT_EQ(worker_of[index], 1);
}

/// All threads on one processor, as on a machine where others have the rest.
TEST(ThreadPool, DoesThePartsOfThreadsThatHaveNotBegun) {
  std::vector<std::thread::id> ids(2);
  int done_by_caller = 0;
  std::thread([&] {
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(static_cast<std::size_t>(::sched_getcpu()), &one);
    ::sched_setaffinity(0, sizeof one, &one);
    ThreadPool pool(2);
    for (int round = 0; round < 2000; ++round) {
      pool.for_each_range(2, [&](std::size_t, std::size_t, int worker) {
        ids[static_cast<std::size_t>(worker)] = std::this_thread::get_id();
      });
      if (ids[0] == ids[1]) ++done_by_caller;
    }
  }).join();

  EXPECT_GT(done_by_caller, 0);
}

TEST(ThreadPool, RefusesALoopInsideALoopWhenItHasSeveralThreads) {
  ThreadPool pool(2);
  const auto nothing = [](std::size_t, std::size_t, int) {};

  EXPECT_THROW(pool.for_each_range(
                   2, [&](std::size_t, std::size_t, int) { pool.for_each_range(2, nothing); }),
               std::logic_error);
  EXPECT_NO_THROW(pool.for_each_range(2, nothing));
}

TEST(ThreadPool, CanBeUsedInsideALoopOfAnotherPool) {
  ThreadPool outer(2);
  std::vector<ThreadPool> inner(2);
  std::vector<std::size_t> sums(2, 0);

  outer.for_each_range(2, [&](std::size_t, std::size_t, int worker) {
    const auto mine = static_cast<std::size_t>(worker);
    inner[mine].for_each_range(
        mine + 1, [&](std::size_t begin, std::size_t end, int) { sums[mine] = end - begin; });
  });

  EXPECT_EQ(sums, (std::vector<std::size_t>{1, 2}));
}

TEST(ThreadPool, RefusesToHaveNoThread) {
  EXPECT_THROW(ThreadPool(0), std::invalid_argument);
  EXPECT_THROW(ThreadPool(-3), std::invalid_argument);
}

TEST(ThreadPool, MayEndWithoutEverHavingWorked) {
  for (int round = 0; round < 50; ++round) ThreadPool pool(4);
}

}  // namespace
}  // namespace plekton::geometry::thread_pool_test
