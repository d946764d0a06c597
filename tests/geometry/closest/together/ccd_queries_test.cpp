// SPDX-License-Identifier: GPL-3.0-or-later
// Queries of a benchmark of continuous collision detection (Wang et al., A large-scale benchmark
// and an inclusion-based algorithm for continuous collision detection, ACM TOG 40 (2021)), kept
// beside the repository: scenes that touch, slide and lie in one plane. Standing still at the start
// and at the end of each motion they are pairs of edges, or of a vertex and a face, in the worst
// places.
#include "geometry/closest/core_pair.hpp"
#include "tests/support/closest_checks.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace plekton::geometry::ccd_queries_test {
namespace {

namespace fs = std::filesystem;

const fs::path kQueries = fs::path(PLEKTON_SOURCE_DIR) / "../shared/queries";

/// num_x, den_x, num_y, den_y, num_z, den_z, and whether they collide on the way, which is not
/// asked here.
Vec3 point_of(const std::string& row) {
  std::istringstream text(row);
  Vec3 point;
  for (int k = 0; k < 3; ++k) {
    double numerator = 0.0, denominator = 1.0;
    char comma = 0;
    if (!(text >> numerator >> comma >> denominator >> comma))
      throw std::runtime_error("not a row of a query: " + row);
    point[k] = numerator / denominator;
  }
  return point;
}

Core core_of(std::span<const Vec3> corners) {
  Core core;
  for (const Vec3& corner : corners) core.x[core.count++] = corner;
  return core;
}

/// Judges every query of a list of rows, eight rows each: four corners at the start, four at the
/// end.
/// @param corners_a  2 of edge and edge, 1 of vertex and face
/// @returns how many configurations that were
int expect_exact_answers(std::istream& rows, std::size_t corners_a) {
  std::vector<Vec3> points;
  for (std::string row; std::getline(rows, row);) {
    if (!row.empty()) points.push_back(point_of(row));
  }
  EXPECT_EQ(points.size() % 8, 0U);
  test::Tally tally;
  int count = 0;
  for (std::size_t first = 0; first + 4 <= points.size(); first += 4, ++count) {
    const auto corners = std::span(points).subspan(first, 4);
    const Core a = core_of(corners.first(corners_a));
    const Core b = core_of(corners.subspan(corners_a));
    const ClosestPoints found = closest_points(a, b);
    tally.add(test::judge(a.corners(), b.corners(), found));
    EXPECT_TRUE(test::are_opposite(found, closest_points(b, a)));
  }
  EXPECT_EQ(tally.wrong_regions, 0);
  EXPECT_EQ(tally.wrong_relations, 0);
  EXPECT_EQ(tally.not_numbers, 0);
  EXPECT_LE(tally.relative_error, test::kDistanceTolerance);
  EXPECT_LE(tally.mismatch, test::kWeightTolerance);
  return count;
}

TEST(CollisionQueries, OfTheBenchmarkAreAnsweredExactlyAtBothTimes) {
  if (!fs::exists(kQueries))
    GTEST_SKIP() << "no benchmark queries in " << kQueries
                 << "; those of the small set are asked in their place";
  int files = 0;
  for (const auto& entry : fs::directory_iterator(kQueries)) {
    if (entry.path().extension() != ".csv") continue;
    SCOPED_TRACE(entry.path().filename().string());
    std::ifstream rows(entry.path());
    const bool is_edges = entry.path().filename().string().find("edge-edge") != std::string::npos;
    EXPECT_EQ(expect_exact_answers(rows, is_edges ? 2 : 1), 250);
    ++files;
  }
  EXPECT_EQ(files, 8);
}

TEST(CollisionQueries, OfASmallSetAreAnsweredExactlyAtBothTimes) {
  // Two edges that lie on one line, then cross; two that touch at their ends.
  std::istringstream edges(
      "0,1,0,1,0,1,0\n1,1,0,1,0,1,0\n1,2,0,1,0,1,0\n3,1,0,1,0,1,0\n"
      "0,1,0,1,0,1,0\n1,1,0,1,0,1,0\n1,2,-1,1,0,1,0\n1,2,1,1,0,1,0\n"
      "0,1,0,1,0,1,1\n1,1,0,1,0,1,1\n1,1,0,1,0,1,1\n1,1,5,3,1,7,1\n"
      "0,1,0,1,1,4503599627370496,1\n1,1,0,1,0,1,1\n1,2,-1,1,0,1,1\n1,2,1,1,0,1,1\n");
  // A vertex on a side of a face, then on a corner; one just off the plane of a face, then inside.
  std::istringstream faces(
      "1,2,0,1,0,1,0\n0,1,0,1,0,1,0\n1,1,0,1,0,1,0\n0,1,1,1,0,1,0\n"
      "1,1,0,1,0,1,0\n0,1,0,1,0,1,0\n1,1,0,1,0,1,0\n0,1,1,1,0,1,0\n"
      "1,4,1,4,1,4503599627370496,1\n0,1,0,1,0,1,1\n1,1,0,1,0,1,1\n0,1,1,1,0,1,1\n"
      "1,4,1,4,0,1,1\n0,1,0,1,0,1,1\n1,1,0,1,0,1,1\n0,1,1,1,0,1,1\n");

  EXPECT_EQ(expect_exact_answers(edges, 2), 4);
  EXPECT_EQ(expect_exact_answers(faces, 1), 4);
}

}  // namespace
}  // namespace plekton::geometry::ccd_queries_test
