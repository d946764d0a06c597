// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/neighbor/cell_neighbours.hpp"

#include "geometry/closest/core_pair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace plekton::geometry::cell_neighbours_test {
namespace {

/// A strip of squares, two facets each, folded once into a U whose sides are a gap apart.
struct Strip {
  std::vector<Vec3> x;
  std::vector<Facet> facets;
};

Strip folded_strip(int squares, double length, double gap, double radius) {
  Strip strip;
  for (int i = 0; i <= squares; ++i) {
    const double s = static_cast<double>(i) / squares;
    const bool is_back = s > 0.5;
    const double along = (is_back ? 1.0 - s : s) * length;
    for (const double y : {0.0, 0.1}) strip.x.emplace_back(along, y, is_back ? gap : 0.0);
  }
  for (int i = 0; i < squares; ++i) {
    const auto node = [&](int k) { return NodeId{2 * i + k}; };
    strip.facets.push_back({{node(0), node(2), node(1)}, radius});
    strip.facets.push_back({{node(2), node(3), node(1)}, radius});
  }
  return strip;
}

double distance(const Surface& surface, const CellPair& pair, Positions x) {
  const auto core = [&](CellId cell) {
    Core found;
    for (const NodeId node : surface.nodes_of(cell)) found.x[found.count++] = x[index_of(node)];
    return found;
  };
  return closest_points(core(pair.a), core(pair.b)).distance;
}

TEST(CellNeighbours, ListNoCellsThatHangTogether) {
  const Strip flat = folded_strip(40, 2.0, 0.0, 0.01);
  std::vector<Vec3> rest = flat.x;
  for (std::size_t i = 0; i < rest.size(); ++i)
    rest[i].x() = 0.05 * static_cast<double>(i / 2);  // unfolded
  const Surface surface({}, flat.facets, rest.size());
  ThreadPool pool(1);
  CellNeighbours neighbours(surface, rest, 0.05, true);
  EXPECT_TRUE(neighbours.pairs().empty());
  neighbours.update(rest, pool);
  for (const CellPair& pair : neighbours.pairs()) {
    EXPECT_GT(distance(surface, pair, rest), 2.0 * 0.01);
  }
}

TEST(CellNeighbours, ListBothSidesOfAFold) {
  const double radius = 0.01;
  const Strip strip = folded_strip(40, 2.0, 1.9 * radius, radius);
  std::vector<Vec3> rest = strip.x;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    rest[i].x() = 0.05 * static_cast<double>(i / 2);
    rest[i].z() = 0.0;
  }
  const Surface surface({}, strip.facets, rest.size());
  ThreadPool pool(1);
  CellNeighbours folded(surface, rest, 0.002, true);
  folded.update(strip.x, pool);
  EXPECT_GT(folded.pairs().size(), 40u);
  CellNeighbours without(surface, rest, 0.002, false);
  without.update(strip.x, pool);
  EXPECT_TRUE(without.pairs().empty());
}

/// As BothSidesOfAFold, with cells of a fiftieth of the thickness: 10 002 nodes, 2 cm of strip.
TEST(CellNeighbours, ListBothSidesOfAFoldOfCellsFarShorterThanThick) {
  const double radius = 0.01, length = 1.0;
  const int squares = 5000;
  const Strip strip = folded_strip(squares, length, 1.9 * radius, radius);
  std::vector<Vec3> rest = strip.x;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    rest[i].x() = static_cast<double>(i / 2) * length / squares;
    rest[i].z() = 0.0;
  }
  const Surface surface({}, strip.facets, rest.size());
  ThreadPool pool(1);
  CellNeighbours folded(surface, rest, 0.0, true);
  folded.update(strip.x, pool);
  std::vector<int> listed(surface.cell_count(), 0);
  for (const CellPair& pair : folded.pairs()) {
    ++listed[index_of(pair.a)];
    ++listed[index_of(pair.b)];
  }
  // But for those near the fold along the strip: two diameters, and two groups.
  const auto from_fold = [&](std::size_t cell) {
    return std::abs(static_cast<double>(cell / 2) * length / squares - 0.5 * length);
  };
  for (std::size_t cell = 0; cell < listed.size(); ++cell) {
    EXPECT_TRUE(listed[cell] > 0 || from_fold(cell) < (2.0 + 0.4 + 0.1) * radius) << cell;
  }
  CellNeighbours flat(surface, rest, 0.0, true);
  flat.update(rest, pool);
  EXPECT_TRUE(flat.pairs().empty());
}

/// Nothing that comes into contact before the list is made anew is missing from it.
TEST(CellNeighbours, MissNothingWhileNodesMoveByLessThanHalfTheSkin) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const double radius = 0.05, skin = 0.04;
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Vec3> x;
    std::vector<Facet> facets;
    for (int f = 0; f < 20; ++f) {
      const Vec3 centre(u(random), u(random), u(random));
      for (int k = 0; k < 3; ++k) x.push_back(centre + 0.3 * Vec3(u(random), u(random), u(random)));
      facets.push_back({{NodeId{3 * f}, NodeId{3 * f + 1}, NodeId{3 * f + 2}}, radius});
    }
    const Surface surface({}, facets, x.size());
    ThreadPool pool(1);
    CellNeighbours neighbours(surface, x, skin, true);
    neighbours.update(x, pool);
    for (Vec3& point : x) point += 0.49 * skin * Vec3(u(random), u(random), u(random)).normalized();
    neighbours.update(x, pool);
    for (int a = 0; a < 20; ++a) {
      for (int b = a + 1; b < 20; ++b) {
        const CellPair pair{CellId{a}, CellId{b}};
        if (distance(surface, pair, x) >= 2.0 * radius) continue;
        const bool keeps = surface.structure_of(pair.a) <= surface.structure_of(pair.b);
        const CellPair listed = keeps ? pair : CellPair{pair.b, pair.a};
        EXPECT_TRUE(
            std::binary_search(neighbours.pairs().begin(), neighbours.pairs().end(), listed));
      }
    }
  }
}

}  // namespace
}  // namespace plekton::geometry::cell_neighbours_test
