// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/surface_pressure_check.hpp"

#include "dynamics/model/scene.hpp"
#include "geometry/mesh/generate/generators.hpp"
#include "tests/support/seeded_random.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace plekton::dynamics::surface_pressure_check_test {
namespace {

using geometry::FaceId;
using geometry::Facet;
using test::Random;
using testing::IsEmpty;

/// How often facets go from one node to another.
std::map<std::pair<NodeId, NodeId>, int> directed_sides(const std::vector<Facet>& facets) {
  std::map<std::pair<NodeId, NodeId>, int> sides;
  for (const Facet& facet : facets)
    for (std::size_t k = 0; k < 3; ++k) ++sides[{facet.nodes[k], facet.nodes[(k + 1) % 3]}];
  return sides;
}

int count_in(const std::map<std::pair<NodeId, NodeId>, int>& sides, NodeId from, NodeId to) {
  const auto found = sides.find({from, to});
  return found == sides.end() ? 0 : found->second;
}

/// Facets between few nodes, so that many share sides: some with their opposites, and then closed.
std::vector<Facet> random_facets(Random& random) {
  std::vector<Facet> facets;
  const int count = random.integer(1, 5);
  for (int i = 0; i < count; ++i) {
    std::array<int, 5> nodes{0, 1, 2, 3, 4};
    for (std::size_t k = 0; k < 3; ++k) std::swap(nodes[k], nodes[k + random.index(5 - k)]);
    facets.push_back({{NodeId{nodes[0]}, NodeId{nodes[1]}, NodeId{nodes[2]}}, 0.01});
  }
  if (random.coin()) {
    for (std::size_t i = facets.size(); i-- > 0;) {
      Facet other = facets[i];
      std::swap(other.nodes[0], other.nodes[1]);
      facets.push_back(other);
    }
  }
  return facets;
}

TEST(ClosedFacets, GoAlongEverySideAsOftenOneWayAsTheOther) {
  Random random(11);
  int closed = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const std::vector<Facet> facets = random_facets(random);
    const auto sides = directed_sides(facets);
    bool expected = true;
    for (const auto& [side, count] : sides)
      expected = expected && count == count_in(sides, side.second, side.first);
    closed += expected;

    EXPECT_EQ(are_closed(facets), expected);
  }
  EXPECT_GT(closed, 100);
  EXPECT_LT(closed, 400);
}

TEST(OppositeNeighbours, AreTwoFacetsThatGoTheSameWayAlongASideOfTheirsAlone) {
  Random random(12);
  int found = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const std::vector<Facet> facets = random_facets(random);
    const auto sides = directed_sides(facets);
    const auto is_opposite = [&](const std::pair<NodeId, NodeId>& side) {
      return count_in(sides, side.first, side.second) == 2 &&
             count_in(sides, side.second, side.first) == 0;
    };

    const auto two = opposite_neighbours(facets);

    EXPECT_EQ(two.has_value(), std::any_of(sides.begin(), sides.end(), [&](const auto& side) {
                return is_opposite(side.first);
              }));
    if (!two) continue;
    ++found;
    const auto of_one = directed_sides({facets[(*two)[0]]});
    const auto of_other = directed_sides({facets[(*two)[1]]});
    EXPECT_NE((*two)[0], (*two)[1]);
    EXPECT_TRUE(std::any_of(of_one.begin(), of_one.end(), [&](const auto& side) {
      return is_opposite(side.first) && of_other.contains(side.first);
    }));
  }
  EXPECT_GT(found, 50);
}

TEST(LowestGasPressure, IsReachedWhereThePressureOverTheOutsideIsLowest) {
  SurfacePressure load;
  load.gas = Gas{1e5, 1.0};
  load.factor = TimeTable({{0.0, 1.0}, {1.0, -2.0}, {2.0, 3.0}});

  load.pressure = 2e4;
  EXPECT_EQ(lowest_gas_pressure(load), 1e5 - 4e4);
  load.pressure = -2e4;
  EXPECT_EQ(lowest_gas_pressure(load), 1e5 - 6e4);
}

/// A closed box of 1 m³ that faces outward.
Scene box() {
  Scene scene;
  const geometry::Mesh mesh = geometry::box_shell(Vec3::Ones());
  for (const Vec3& x : mesh.points) scene.add_node(x);
  for (const auto& [a, b, c] : mesh.facets) scene.add_facet(a, b, c, 0.01, contact::MaterialId{0});
  return scene;
}

SurfacePressure pressure_on_all(const Scene& scene) {
  SurfacePressure load;
  for (std::size_t i = 0; i < scene.elements.facets.size(); ++i)
    load.facets.push_back(geometry::id_at<FaceId>(i));
  return load;
}

std::string problems_of(const SurfacePressure& load, const Scene& scene) {
  std::ostringstream text;
  list_problems(load, scene, "load", text);
  return text.str();
}

TEST(SurfacePressureCheck, WantsAVolumeForAGasAndForAPressureByVolume) {
  Scene scene = box();
  SurfacePressure gas = pressure_on_all(scene), by_volume = gas;
  gas.gas = Gas{};
  by_volume.by_volume = {{{{1.0, 2.0}}}};
  EXPECT_THAT(problems_of(gas, scene) + problems_of(by_volume, scene), IsEmpty());

  // Flat: nothing is left of the volume.
  for (Vec3& x : scene.state.position) x.z() = 0.0;
  EXPECT_EQ(problems_of(gas, scene),
            "load: a gas needs a volume, and this surface encloses 0 m3; let its facets face "
            "outward\n");
  EXPECT_EQ(problems_of(by_volume, scene),
            "load: a pressure by volume needs a volume, and this surface encloses 0 m3; let its "
            "facets face outward\n");

  // Neither is asked of a pressure alone.
  EXPECT_THAT(problems_of(pressure_on_all(scene), scene), IsEmpty());
}

TEST(SurfacePressureCheck, WritesTheLineOfWhatIsWrongAndNoOther) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Scene scene = box();
  const SurfacePressure sound = pressure_on_all(scene);

  SurfacePressure load = sound;
  load.by_volume.emplace();
  EXPECT_EQ(problems_of(load, scene),
            "load: its pressure by volume has no rows; give at least one\n");
  load.by_volume->rows = {{1.0, 0.0}, {kInfinity, 0.0}, {3.0, 1.0}};
  EXPECT_EQ(problems_of(load, scene),
            "load: row 1 of its pressure by volume is not finite\n"
            "load: row 2 of its pressure by volume is at 3 m3, not above "
            "inf m3 of the row before; list the rows by increasing "
            "volume\n");

  load = sound;
  load.start_volume = kInfinity;
  EXPECT_EQ(problems_of(load, scene),
            "load: its volume at the start is inf m3; it must be positive and finite\n");

  load = sound;
  load.facets.clear();
  EXPECT_EQ(problems_of(load, scene), "load: has no facets; give at least one\n");

  load = sound;
  load.facets = {FaceId{5}, FaceId{-1}};
  EXPECT_EQ(problems_of(load, scene), "load: there is no facet -1, only 12 facets\n");
}

/// Facets of nodes that do not exist are other problems, and have no volume to look at.
TEST(SurfacePressureCheck, LooksAtNoPlacesOfNodesThatAreNotThere) {
  Scene scene = box();
  SurfacePressure load = pressure_on_all(scene);
  load.gas = Gas{};
  scene.elements.facets[3].nodes[1] = NodeId{1000};

  EXPECT_THAT(problems_of(load, scene), IsEmpty());
}

}  // namespace
}  // namespace plekton::dynamics::surface_pressure_check_test
