// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/neighbor/near_nodes.hpp"

#include "geometry/mesh/generate/generators.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace plekton::geometry::near_nodes_test {
namespace {

/// m, lengths of the shortest ways along edges from one node: Bellman and Ford, until nothing gets
/// shorter.
std::vector<double> lengths_from(std::size_t start, const Surface& surface, Positions x) {
  std::vector<double> lengths(x.size(), std::numeric_limits<double>::infinity());
  lengths[start] = 0.0;
  for (bool changes = true; changes;) {
    changes = false;
    for (std::size_t e = 0; e < surface.edge_count(); ++e) {
      const auto& [a, b] = surface.nodes_of(id_at<EdgeId>(e));
      const double edge = (x[index_of(a)] - x[index_of(b)]).norm();
      for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
        const double further = lengths[index_of(from)] + edge;
        if (further >= lengths[index_of(to)]) continue;
        lengths[index_of(to)] = further;
        changes = true;
      }
    }
  }
  return lengths;
}

/// A sheet of squares of two facets each, all cut the same way.
struct Sheet {
  std::vector<Vec3> x;
  Surface surface;

  Sheet(double side, int cells, double radius) {
    const Mesh mesh = plane_sheet({side, side, cells, cells});
    x = mesh.points;
    std::vector<Facet> facets;
    for (const auto& nodes : mesh.facets) facets.push_back({nodes, radius});
    surface = Surface({}, facets, x.size());
  }
};

TEST(NearNodes, AreThoseWithinTwoDiametersWhereEdgesAreLong) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-0.2, 0.2);
  Sheet sheet(1.0, 12, 0.05);
  for (Vec3& x : sheet.x) x += Vec3(u(random), u(random), u(random)) / 12.0;
  const NearNodes near(sheet.surface, sheet.x);

  EXPECT_EQ(near.group_count(), sheet.x.size());
  for (std::size_t a = 0; a < sheet.x.size(); a += 7) {
    const std::vector<double> lengths = lengths_from(a, sheet.surface, sheet.x);
    for (std::size_t b = 0; b < sheet.x.size(); ++b) {
      EXPECT_EQ(near.are_near(id_at<NodeId>(a), id_at<NodeId>(b)), lengths[b] <= 4.0 * 0.05);
    }
  }
}

TEST(NearNodes, AreOffByNoMoreThanTwoGroupsWhereEdgesAreShort) {
  const double radius = 0.25;
  const Sheet sheet(1.0, 40, radius);
  const NearNodes near(sheet.surface, sheet.x);

  EXPECT_LT(near.group_count(), sheet.x.size() / 4);
  int undecided = 0;
  for (std::size_t a = 0; a < sheet.x.size(); a += 97) {
    const std::vector<double> lengths = lengths_from(a, sheet.surface, sheet.x);
    for (std::size_t b = 0; b < sheet.x.size(); ++b) {
      const bool are_near = near.are_near(id_at<NodeId>(a), id_at<NodeId>(b));
      if (lengths[b] <= 3.2 * radius) {
        EXPECT_TRUE(are_near) << lengths[b];
      } else if (lengths[b] > 4.8 * radius) {
        EXPECT_FALSE(are_near) << lengths[b];
      } else {
        ++undecided;
      }
    }
  }
  EXPECT_GT(undecided, 0) << "or the bounds were not looked at";
}

/// Cells of a tenth and of a fortieth of the thickness: sixteen times as many nodes, and about the
/// same groups.
TEST(NearNodes, TakeListsThatDoNotGrowAsEdgesBecomeShorter) {
  const auto entries = [](int cells) {
    const double radius = 0.1;
    const Sheet sheet(5.0 * radius, cells, radius);
    const NearNodes near(sheet.surface, sheet.x);
    std::size_t sum = 0;
    for (std::size_t g = 0; g < near.group_count(); ++g)
      sum += near.groups_near(static_cast<std::int32_t>(g)).size();
    return sum;
  };

  const std::size_t coarse = entries(25), fine = entries(100);

  EXPECT_LT(fine, 2 * coarse);
  EXPECT_GT(fine, coarse / 2);
}

/// Spokes of a wheel: from end to end it is two of them, half of two diameters.
TEST(NearNodes, AreRefusedWhereTheirListsWouldFillTheMemory) {
  const double radius = 0.1;
  std::vector<Vec3> x{Vec3::Zero()};
  std::vector<Cylinder> spokes;
  for (int i = 1; i <= 200; ++i) {
    x.push_back(radius * Vec3(std::cos(0.01 * i), std::sin(0.01 * i), 0.0));
    spokes.push_back({{NodeId{0}, NodeId{i}}, radius});
  }
  const Surface surface(spokes, {}, x.size());

  EXPECT_NO_THROW(NearNodes(surface, x, 201 * 201));
  try {
    const NearNodes near(surface, x, 201 * 201 - 1);
    ADD_FAILURE() << "accepted";
  } catch (const std::length_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("self-contact: about 40401 pairs of nodes"));
    EXPECT_THAT(error.what(), testing::HasSubstr("expected at most 40400; use fewer edges"));
  }
}

}  // namespace
}  // namespace plekton::geometry::near_nodes_test
