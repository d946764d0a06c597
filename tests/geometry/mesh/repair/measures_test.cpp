// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/measures.hpp"

#include "geometry/mesh/generate/generators.hpp"

#include <gtest/gtest.h>

namespace plekton::geometry::measures_test {
namespace {

/// A cube of side a: area 6 a², the diagonals of its sides sqrt(2) a, angles of 90 and 45 degrees.
TEST(Measure, IsRightOfMeshesWhoseSquaredAreasVanish) {
  for (const double size : {1.0, 1e-60, 1e-100, 1e-140}) {
    const MeshMeasures found = measure(box_shell(Vec3::Constant(size)), false);

    const double eps = 1e-14;  // some roundings
    EXPECT_NEAR(found.area / size, 6.0 * size, 6.0 * size * eps) << size;
    EXPECT_NEAR(found.smallest_angle, 45.0, 45.0 * eps) << size;
    EXPECT_NEAR(found.shortest_edge, size, size * eps) << size;
    EXPECT_NEAR(found.longest_edge, std::sqrt(2.0) * size, 2.0 * size * eps) << size;
  }
}

}  // namespace
}  // namespace plekton::geometry::measures_test
