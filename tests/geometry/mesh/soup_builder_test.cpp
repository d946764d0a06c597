// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/soup_builder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace plekton::geometry::soup_builder_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const std::string kAdvice = "; correct the file or export the mesh again";

std::string message_of(SoupBuilder&& builder) {
  try {
    std::move(builder).finish();
  } catch (const MeshError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SoupBuilder, GivesBackWhatItWasGivenInThatOrder) {
  SoupBuilder builder("a.ply", 0);
  builder.expect_points(3);
  builder.add_polygon(std::array<std::int64_t, 2>{2, 0}, 1);  // before the points, as files may
  for (int i = 0; i < 3; ++i) builder.add_point(Vec3(i, 0.5 * i, -i), 2);
  builder.add_polygon(std::array<std::int64_t, 4>{0, 1, 1, 2}, 3);
  builder.add_polygon({}, 4);
  builder.skip_elements(2);
  builder.skip_elements(5);
  EXPECT_EQ(builder.point_count(), 3u);
  EXPECT_EQ(builder.polygon_count(), 3u);

  const PolygonSoup soup = std::move(builder).finish();

  EXPECT_EQ(soup.points, (std::vector<Vec3>{{0, 0, 0}, {1, 0.5, -1}, {2, 1, -2}}));
  EXPECT_EQ(soup.polygons, (std::vector<std::vector<std::size_t>>{{2, 0}, {0, 1, 1, 2}, {}}));
  EXPECT_EQ(soup.skipped_elements, 7u);
}

TEST(SoupBuilder, CountsAsTheFileDoes) {
  for (const std::int64_t first : {0, 1}) {
    SoupBuilder builder("a.obj", first);
    builder.expect_points(2);
    builder.add_point(Vec3(1.0, 2.0, 3.0), 7);
    builder.add_point(Vec3(1.0, -kInfinity, 2.5), 8);
    builder.add_polygon(std::array<std::int64_t, 3>{0, 1, 1}, 9);
    builder.add_polygon(std::array<std::int64_t, 3>{0, 2, 1}, 10);
    const auto number = [first](int i) { return std::to_string(i + first); };

    EXPECT_EQ(message_of(std::move(builder)),
              "a.obj: 2 problems\n  line 8: point " + number(1) +
                  " is at (1, -inf, 2.5), but every coordinate must be a finite number below 1e75 "
                  "in size\n  line 10: facet " +
                  number(1) + " names point " + number(2) +
                  ", but the file has 2 points, numbered " + number(0) + " to " + number(1) +
                  kAdvice);
  }
}

TEST(SoupBuilder, ListsTenProblemsInFullAndCountsTheRest) {
  const auto message_of_problems = [](int count) {
    SoupBuilder builder("a.stl", 0);
    for (int i = 0; i < count; ++i) builder.add_problem("problem " + std::to_string(i), 0);
    return message_of(std::move(builder));
  };
  std::string ten;
  for (int i = 0; i < 10; ++i) ten += "\n  problem " + std::to_string(i);

  EXPECT_EQ(message_of_problems(0), "accepted");
  EXPECT_EQ(message_of_problems(1), "a.stl: problem 0" + kAdvice);
  EXPECT_EQ(message_of_problems(10), "a.stl: 10 problems" + ten + kAdvice);
  EXPECT_EQ(message_of_problems(11), "a.stl: 11 problems" + ten + "\n  and 1 more" + kAdvice);
}

TEST(SoupBuilder, TakesCoordinatesUpToTheLargestOnEveryAxisAndSide) {
  const double below = std::nextafter(kLargestCoordinate, 0.0);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const auto is_taken = [&](double coordinate) {
        SoupBuilder builder("a.off", 0);
        builder.add_point(sign * coordinate * Vec3::Unit(axis), 1);
        return message_of(std::move(builder)) == "accepted";
      };
      EXPECT_TRUE(is_taken(below)) << axis;
      EXPECT_FALSE(is_taken(kLargestCoordinate)) << axis;
    }
    Vec3 point = Vec3::Zero();
    point[axis] = std::nan("");
    SoupBuilder builder("a.off", 0);
    builder.add_point(point, 1);
    EXPECT_NE(message_of(std::move(builder)), "accepted") << axis;
  }
}

TEST(CheckSoup, RefusesPositionsThatAreNotThereHoweverLarge) {
  PolygonSoup soup{{Vec3::Zero(), Vec3::Ones()}, {{0, 1, 1}}};
  EXPECT_NO_THROW(check_soup(soup, "soup"));

  for (const std::size_t position : {std::size_t{2}, std::size_t{1} << 32U, std::size_t{1} << 63U,
                                     std::numeric_limits<std::size_t>::max()}) {
    soup.polygons = {{0, 1, position}};
    EXPECT_THROW(check_soup(soup, "soup"), MeshError) << position;
  }
}

}  // namespace
}  // namespace plekton::geometry::soup_builder_test
