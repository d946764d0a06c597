// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/repair/resolution.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace plekton::geometry::resolution_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string message_of(const Mesh& mesh, double length) {
  try {
    require_resolved(mesh, length, "a wrap of 0.1 m");
  } catch (const MeshError& error) {
    return error.what();
  }
  return "accepted";
}

/// Two points this far apart along an axis, one of them at the origin.
Mesh of_size(double size, int axis) {
  return {{Vec3::Zero(), size * Vec3::Unit(axis)}, {}};
}

TEST(RequireResolved, AsksForLengthsOf256Roundings) {
  // Doubles below 2^10 m in size are rounded to at most 2^-42 m.
  const double least = std::ldexp(1.0, 8 - 42);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      Mesh mesh = of_size(1.0, (axis + 1) % 3);
      mesh.points.push_back(1024.0 * sign * Vec3::Unit(axis));

      EXPECT_EQ(message_of(mesh, least), "accepted");
      EXPECT_THAT(message_of(mesh, std::nextafter(least, 0.0)),
                  StartsWith("a wrap of 0.1 m: coordinates of 1024 m are rounded to 2.27374e-13 m"))
          << axis;
    }
  }
}

TEST(RequireResolved, LooksAtTheCoordinatesAndNotAtTheSize) {
  const double length = 1e-6;
  Mesh mesh = of_size(1.0, 0);
  EXPECT_EQ(message_of(mesh, length), "accepted");

  for (Vec3& point : mesh.points) point += Vec3(0.0, 0.0, -1e9);

  EXPECT_THAT(message_of(mesh, length), HasSubstr("bring the mesh nearer to the origin"));
}

TEST(RequireResolved, LeavesWhatIsNoLengthToOthers) {
  const Mesh mesh = of_size(1e9, 0);
  ASSERT_NE(message_of(mesh, 1e-9), "accepted");

  for (const double length : {0.0, -1.0, std::nan("")})
    EXPECT_EQ(message_of(mesh, length), "accepted") << length;
  EXPECT_EQ(message_of({}, 1e-9), "accepted") << "a mesh without points has no coordinates";
}

TEST(RequireResolved, AsksForASizeWhoseProductsAreNumbers) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double size : {1.1e-30, 0.9e30})
      EXPECT_EQ(message_of(of_size(size, axis), size), "accepted") << size;
    for (const double size : {0.0, 0.9e-30, 1.1e30, 1e300})
      EXPECT_THAT(message_of(of_size(size, axis), size), HasSubstr("scale it")) << size;
  }
}

}  // namespace
}  // namespace plekton::geometry::resolution_test
