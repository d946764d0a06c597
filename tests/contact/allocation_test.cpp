// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/allocation_count.hpp"
#include "tests/support/moving_scene.hpp"

#include <gtest/gtest.h>

namespace plekton::test {
namespace {

TEST(Allocation, DoesNotHappenWhenWarmContactsAdvance) {
  // A wide skin: the lists are made once. Forth and back, so that the second time shows what the
  // first one showed.
  for (const int threads : {1, 2}) {
    MovingScene scene(200, 1.0, 3, threads);
    const auto swing = [&] {
      for (int step = 0; step < 50; ++step) scene.step(2e-3);
      for (int step = 0; step < 50; ++step) scene.step(-2e-3);
    };
    swing();
    swing();

    EXPECT_EQ(allocations_of(swing), 0u) << threads << " threads";
    EXPECT_EQ(scene.contacts().neighbours().rebuild_count(), 1);
  }
}

}  // namespace
}  // namespace plekton::test
