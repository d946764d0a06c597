// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/allocation_count.hpp"
#include "tests/support/beam_structure.hpp"

#include <gtest/gtest.h>

namespace plekton::test {
namespace {

TEST(Allocation, IsNoneInTheForcesOfBeams) {
  Scene scene = chain(50, 1.0, dynamics::circular_section(0.01, 1e6, 0.3));
  BeamBonds bonds(scene.bonds, scene.state.size());
  contact::NodeForces forces(scene.state.size());
  for (const int threads : {1, 2}) {
    geometry::ThreadPool pool(threads);

    const std::size_t count = allocations_of([&] {
      bonds.advance(scene.state, pool);
      bonds.add_forces(forces, pool);
    });

    EXPECT_EQ(count, 0U);
  }
}

}  // namespace
}  // namespace plekton::test
