// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/generate/lattice.hpp"

#include "geometry/primitives/elements.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <vector>

namespace plekton::geometry::lattice_test {
namespace {

using ::testing::HasSubstr;

TEST(Chain, GoesThroughItsPointsInLinksOfEqualLength) {
  const Lattice lattice = chain({{Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(3, 0, 1)}, 4});

  ASSERT_EQ(lattice.points.size(), 9u);
  EXPECT_EQ(lattice.points[1], Vec3(0.75, 0, 0));
  EXPECT_EQ(lattice.points[4], Vec3(3, 0, 0));
  EXPECT_EQ(lattice.points[8], Vec3(3, 0, 1));
  for (std::size_t i = 0; i < lattice.edges.size(); ++i)
    EXPECT_EQ(lattice.edges[i],
              (LatticeEdge{{id_at<NodeId>(i), id_at<NodeId>(i + 1)}, LatticePart::link}));
}

TEST(Chain, ClosesWhereItEndsAtItsBeginning) {
  const Lattice lattice = chain({{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 0)}, 1});
  const Surface surface(cylinders_of(lattice, 0.01), {}, lattice.points.size());

  EXPECT_EQ(lattice.points.size(), 3u);
  EXPECT_EQ(surface.edge_count(), 3u);
  EXPECT_EQ(surface.euler_characteristic(), 0);
  EXPECT_TRUE(std::is_sorted(lattice.edges.begin(), lattice.edges.end(),
                             [](const auto& a, const auto& b) { return a.nodes < b.nodes; }));
}

TEST(Chain, RefusesPointsThatMakeNoWay) {
  const auto error_of = [](const Chain& bad) -> std::string {
    try {
      chain(bad);
    } catch (const MeshError& error) {
      return error.what();
    }
    return "";
  };

  EXPECT_THAT(error_of({{Vec3::Zero()}, 1}), HasSubstr("through 1 points"));
  EXPECT_THAT(error_of({{Vec3::Zero(), Vec3::Zero()}, 1}), HasSubstr("points 0 and 1 of a chain"));
  EXPECT_THAT(error_of({{Vec3::Zero(), Vec3::Ones()}, 0}), HasSubstr("expected at least 1"));
  EXPECT_THAT(error_of({{Vec3::Zero(), Vec3::Ones() / 0.0}, 1}), HasSubstr("is not finite"));
  EXPECT_THAT(error_of({{Vec3(-1e308, 0, 0), Vec3(1e308, 0, 0)}, 1}), HasSubstr("too far away"));
  EXPECT_THAT(error_of({{Vec3::Zero(), Vec3::Ones(), Vec3::Zero()}, 1}), HasSubstr("has 2 links"));
}

constexpr HexagonalNet kNet = {
    .mesh_size = 0.08, .twist_length = 0.04, .wire_height = 0.03, .meshes_across = 5, .rows = 4};

/// A lattice in one piece, every edge once and in order; then the number of its meshes is that of
/// its independent cycles.
std::size_t meshes_of(const Lattice& lattice) {
  const Surface surface(cylinders_of(lattice, 0.001), {}, lattice.points.size());
  EXPECT_EQ(surface.structure_count(), 1u);
  EXPECT_EQ(surface.edge_count(), lattice.edges.size());
  EXPECT_TRUE(std::is_sorted(lattice.edges.begin(), lattice.edges.end(),
                             [](const auto& a, const auto& b) { return a.nodes < b.nodes; }));
  return lattice.edges.size() + 1 - lattice.points.size();
}

double length(const Lattice& lattice, const LatticeEdge& edge) {
  return (lattice.points[index_of(edge.nodes[1])] - lattice.points[index_of(edge.nodes[0])]).norm();
}

std::map<LatticePart, int> count_of_parts(const Lattice& lattice) {
  std::map<LatticePart, int> count;
  for (const LatticeEdge& edge : lattice.edges) ++count[edge.part];
  return count;
}

/// Number of edges at each node.
std::vector<int> degrees(const Lattice& lattice) {
  std::vector<int> degree(lattice.points.size(), 0);
  for (const auto& [nodes, part] : lattice.edges)
    for (const NodeId node : nodes) ++degree[index_of(node)];
  return degree;
}

/// Half of the size along an axis; the lattice must be centred on the origin.
double half_size(const Lattice& lattice, Eigen::Index axis) {
  double lower = std::numeric_limits<double>::infinity(), upper = -lower;
  for (const Vec3& p : lattice.points) {
    EXPECT_EQ(p[2], 0.0);
    lower = std::min(lower, p[axis]);
    upper = std::max(upper, p[axis]);
  }
  EXPECT_NEAR(lower, -upper, 4e-16 * upper);
  return upper;
}

TEST(BiaxialGeogrid, HasTheAperturesAndDividedRibsThatWereAskedFor) {
  const Lattice grid = biaxial_geogrid(
      {.pitch_x = 0.03, .pitch_y = 0.04, .apertures_x = 6, .apertures_y = 5, .rib_divisions = 3});

  EXPECT_EQ(meshes_of(grid), 30u);
  EXPECT_EQ(count_of_parts(grid)[LatticePart::rib], 7 * 5 * 3);
  EXPECT_EQ(count_of_parts(grid)[LatticePart::bar], 6 * 6 * 3);
  for (const LatticeEdge& edge : grid.edges)
    EXPECT_NEAR(length(grid, edge), edge.part == LatticePart::rib ? 0.04 / 3 : 0.01, 1e-16);
  EXPECT_NEAR(half_size(grid, 0), 0.09, 1e-16);
  EXPECT_NEAR(half_size(grid, 1), 0.1, 1e-16);
}

TEST(UniaxialGeogrid, HasLongDividedRibsBetweenUndividedBars) {
  const Lattice grid =
      uniaxial_geogrid({.rib_pitch = 0.02, .bar_pitch = 0.25, .apertures_x = 3, .apertures_y = 2});

  EXPECT_EQ(meshes_of(grid), 6u);
  EXPECT_EQ(count_of_parts(grid)[LatticePart::rib], 4 * 2 * 4);
  EXPECT_EQ(count_of_parts(grid)[LatticePart::bar], 3 * 3);
  for (const LatticeEdge& edge : grid.edges)
    EXPECT_NEAR(length(grid, edge), edge.part == LatticePart::rib ? 0.0625 : 0.02, 2e-16);
}

constexpr RingNet kRings = {.ring_diameter = 0.3, .rings_x = 4, .rings_y = 3, .arc_divisions = 4};

TEST(RingNet, HasPolygonsWithTheirCornersOnCirclesSideBySide) {
  const Lattice net = ring_net(kRings);

  EXPECT_EQ(net.edges.size(), 12u * 16u);
  EXPECT_EQ(count_of_parts(net)[LatticePart::ring], 12 * 16);
  EXPECT_EQ(net.points.size(), 12u * 16u - (3u * 3u + 4u * 2u));
  // The rings, and what four of them enclose.
  EXPECT_EQ(meshes_of(net), 12u + 6u);
  EXPECT_NEAR(half_size(net, 0), 0.6, 1e-15);
  EXPECT_NEAR(half_size(net, 1), 0.45, 1e-15);
  const double side = 0.3 * std::sin(std::acos(-1.0) / 16.0);
  for (const LatticeEdge& edge : net.edges) EXPECT_NEAR(length(net, edge), side, 1e-15);
  for (const Vec3& x : net.points) {
    double nearest = 1.0;  // m, from a circle
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 3; ++j) {
        const Vec3 centre(0.3 * (i - 1.5), 0.3 * (j - 1.0), 0.0);
        nearest = std::min(nearest, std::abs((x - centre).norm() - 0.15));
      }
    EXPECT_LT(nearest, 1e-15);
  }
}

TEST(RingNet, HasFourBarsWhereRingsMeetAndTwoElsewhere) {
  const std::vector<int> degree = degrees(ring_net(kRings));
  EXPECT_EQ(std::count(degree.begin(), degree.end(), 4), 3 * 3 + 4 * 2);
  EXPECT_EQ(std::count(degree.begin(), degree.end(), 2),
            static_cast<std::ptrdiff_t>(degree.size()) - 17);
}

TEST(RingNet, IsASquareOfFourNodesAtTheLeast) {
  const Lattice net = ring_net({0.2, 1, 1, 1});
  EXPECT_EQ(net.points.size(), 4u);
  EXPECT_EQ(net.edges.size(), 4u);
}

TEST(RingNet, RefusesWhatIsNoNet) {
  EXPECT_THROW(ring_net({0.0, 1, 1, 1}), MeshError);
  EXPECT_THROW(ring_net({0.3, 0, 1, 1}), MeshError);
  EXPECT_THROW(ring_net({0.3, 1, 0, 1}), MeshError);
  EXPECT_THROW(ring_net({0.3, 1, 1, 0}), MeshError);
  EXPECT_THROW(ring_net({0.3, 100000, 100000, 3}), MeshError);
}

TEST(HexagonalNet, HasRowsOfMeshesOffsetByHalfAMesh) {
  const Lattice net = hexagonal_net(kNet);

  EXPECT_EQ(meshes_of(net), 5u + 4u + 5u + 4u);
  EXPECT_EQ(count_of_parts(net)[LatticePart::twist], 6 + 5 + 6 + 5);
  EXPECT_NEAR(half_size(net, 0), 2.5 * 0.08, 1e-16);
  // Rows of twists and, between and around them, of single wires.
  EXPECT_NEAR(half_size(net, 1), 0.5 * (4 * 0.04 + 5 * 0.03), 1e-15);
}

TEST(HexagonalNet, HasTwistsAlongYAndSlantedSingleWires) {
  const Lattice net = hexagonal_net(kNet);

  for (const LatticeEdge& edge : net.edges) {
    const Vec3 d = net.points[index_of(edge.nodes[1])] - net.points[index_of(edge.nodes[0])];
    const bool twist = edge.part == LatticePart::twist;
    EXPECT_NEAR(std::abs(d[0]), twist ? 0.0 : 0.04, 1e-16);
    EXPECT_NEAR(std::abs(d[1]), twist ? 0.04 : 0.03, 1e-16);
  }
}

TEST(HexagonalNet, HasNoFreeEndsAndThreeBarsAtAnInnerNode) {
  for (const int rows : {1, 2, 3, 4}) {
    HexagonalNet shape = kNet;
    shape.rows = rows;
    const Lattice net = hexagonal_net(shape);
    const std::vector<int> degree = degrees(net);
    for (std::size_t i = 0; i < degree.size(); ++i) {
      EXPECT_GE(degree[i], 2) << "rows " << rows << ", node " << i;
      EXPECT_LE(degree[i], 3);
      const bool inside = std::abs(net.points[i][0]) < half_size(net, 0) - 0.5 * 0.08 - 1e-9 &&
                          std::abs(net.points[i][1]) < half_size(net, 1) - 1e-9;
      if (inside) {
        EXPECT_EQ(degree[i], 3);
      }
    }
  }
}

TEST(Lattice, BecomesCylindersOverTheNodesOfAScene) {
  const Lattice net = hexagonal_net(kNet);

  const auto cylinders = cylinders_of(net, 0.00135, 100);

  ASSERT_EQ(cylinders.size(), net.edges.size());
  for (std::size_t e = 0; e < cylinders.size(); ++e) {
    EXPECT_EQ(index_of(cylinders[e].nodes[0]), index_of(net.edges[e].nodes[0]) + 100);
    EXPECT_EQ(index_of(cylinders[e].nodes[1]), index_of(net.edges[e].nodes[1]) + 100);
    EXPECT_EQ(cylinders[e].radius, 0.00135);
  }
}

template <class Function>
std::string message_of(const Function& function) {
  try {
    function();
  } catch (const MeshError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Lattice, RefusesLengthsAndCountsThatMakeNone) {
  const auto net_message = [](auto change) {
    HexagonalNet net = kNet;
    change(net);
    return message_of([&] { hexagonal_net(net); });
  };
  EXPECT_THAT(net_message([](auto& net) { net.mesh_size = 0.0; }), HasSubstr("a mesh size of 0"));
  EXPECT_THAT(net_message([](auto& net) { net.twist_length = -1.0; }), HasSubstr("twist length"));
  EXPECT_THAT(net_message([](auto& net) { net.wire_height = std::nan(""); }), HasSubstr("wire"));
  EXPECT_THAT(net_message([](auto& net) { net.meshes_across = 1; }), HasSubstr("at least 2"));
  EXPECT_THAT(net_message([](auto& net) { net.rows = 0; }), HasSubstr("at least 1"));
  EXPECT_THAT(message_of([] { uniaxial_geogrid({0.2, 0.02, 1, 1}); }), HasSubstr("exchange them"));
  EXPECT_THAT(message_of([] { biaxial_geogrid({0.1, 0.1, 1, 1, 0}); }), HasSubstr("elements"));
  EXPECT_THAT(message_of([] { cylinders_of(hexagonal_net(kNet), 0.0); }), HasSubstr("radius"));
  EXPECT_THAT(message_of([] { cylinders_of(hexagonal_net(kNet), 1.0, 2147483640); }),
              HasSubstr("end at 2147483647"));
}

TEST(Lattice, RefusesMoreNodesThanNumbersBeforeItMakesAny) {
  constexpr int kMost = std::numeric_limits<int>::max();
  HexagonalNet net = kNet;
  net.meshes_across = kMost;
  const std::string grid = message_of([] { biaxial_geogrid({0.1, 0.1, 50'000, 50'000, 1}); });
  EXPECT_THAT(grid, HasSubstr("a geogrid of about 5.0002e+09 nodes"));
  EXPECT_THAT(message_of([] { biaxial_geogrid({0.1, 0.1, 1, 1, kMost}); }), HasSubstr("nodes"));
  EXPECT_THAT(message_of([&] { hexagonal_net(net); }), HasSubstr("nodes"));
}

/// Each row takes time in proportion to its length: 4e10 steps would not end otherwise.
TEST(Lattice, MakesNetsThatAreFarWiderThanHigh) {
  HexagonalNet net = kNet;
  net.meshes_across = 100'000;
  net.rows = 2;
  const Lattice lattice = hexagonal_net(net);

  // n + 1 and n twists, and 2 n wires in each of the three rows of wires but for the ends of the
  // last, which has n - 1 nodes between n twists.
  const std::size_t n = 100'000;
  EXPECT_EQ(lattice.edges.size(), (2 * n + 1) + 2 * n + 2 * n + 2 * (n - 1));
}

}  // namespace
}  // namespace plekton::geometry::lattice_test
