// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/asked_breaks.hpp"

#include "dynamics/measures/energy_ledger.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/structure/sheet_facets.hpp"
#include "geometry/base/state_archive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace plekton::dynamics::asked_breaks_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kStiffness = 1e6;  // Pa
constexpr double kRadius = 0.01;    // m

/// A beam of 1 m along x between nodes 0 and 1, with its cylinder, and a facet.
Scene beam_and_facet() {
  Scene scene;
  scene.materials = {{kStiffness, 0.3, 0.5}};
  const NodeId a = scene.add_node(Vec3(0, 0, 0));
  const NodeId b = scene.add_node(Vec3(1, 0, 0));
  const NodeId c = scene.add_node(Vec3(0, 1, 0));
  scene.add_beam(a, b, circular_section(kRadius, kStiffness, 0.3), 1000.0);
  scene.add_cylinder(a, b, kRadius, contact::MaterialId{0});
  scene.add_facet(a, b, c, kRadius, contact::MaterialId{0});
  return scene;
}

template <class Ask>
std::string refusal_of(const Ask& ask) {
  try {
    ask();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(AskedBreaks, BreakABondForWhatItStored) {
  Scene scene = beam_and_facet();
  BeamBonds bonds(scene.bonds, scene.state.size());
  SheetFacets sheets(scene.sheet_facets, scene.state.size());
  geometry::ThreadPool pool(1);
  scene.state.position[1].x() = 1.001;
  bonds.advance(scene.state, pool);
  AskedBreaks breaks;
  breaks.ask_bond(0, bonds.size());
  EXPECT_THAT(breaks.parts().bonds, ElementsAre(0u));
  EnergyLedger ledger;
  breaks.break_all(bonds, sheets, scene.state, 0.0, ledger);
  EXPECT_TRUE(bonds.is_broken(0));
  // 1/2 EA/L stretch², of a bar.
  const double area = std::numbers::pi * kRadius * kRadius;
  EXPECT_NEAR(ledger.energy().bond_dissipated, 0.5 * kStiffness * area * 1e-6, 1e-9 * area);
}

TEST(AskedBreaks, TakeACylinderWithTheBondsBetweenItsNodesEitherWayRound) {
  const Scene scene = beam_and_facet();
  AskedBreaks breaks;
  breaks.ask_cylinder(NodeId{1}, NodeId{0}, scene);
  breaks.ask_facet({NodeId{2}, NodeId{0}, NodeId{1}}, scene);
  const BrokenParts& parts = breaks.parts();
  EXPECT_THAT(parts.bonds, ElementsAre(0u));
  EXPECT_THAT(parts.cylinders, ElementsAre(std::array{NodeId{0}, NodeId{1}}));
  EXPECT_THAT(parts.facets, ElementsAre(std::array{NodeId{0}, NodeId{1}, NodeId{2}}));
  breaks.clear();
  EXPECT_TRUE(breaks.empty());
}

TEST(AskedBreaks, RefuseWhatIsNotThere) {
  const Scene scene = beam_and_facet();
  AskedBreaks breaks;
  EXPECT_THAT(refusal_of([&] { breaks.ask_bond(1, 1); }), HasSubstr("break_bond"));
  EXPECT_THAT(refusal_of([&] { breaks.ask_cylinder(NodeId{0}, NodeId{2}, scene); }),
              HasSubstr("no cylinder between nodes 0 and 2"));
  EXPECT_THAT(refusal_of([&] { breaks.ask_cylinder(NodeId{0}, NodeId{9}, scene); }),
              HasSubstr("break_cylinder"));
  EXPECT_THAT(refusal_of([&] {
                breaks.ask_facet({NodeId{0}, NodeId{1}, NodeId{1}}, scene);
              }),
              HasSubstr("no facet on nodes 0 1 1"));
  EXPECT_TRUE(breaks.empty());
}

TEST(AskedBreaks, GoOnFromAStateButNotWithNodesThatAreNone) {
  const Scene scene = beam_and_facet();
  AskedBreaks breaks;
  breaks.ask_cylinder(NodeId{0}, NodeId{1}, scene);
  geometry::StateTree tree;
  breaks.exchange(geometry::StateArchive::writer(tree), 1, 3);
  AskedBreaks other;
  other.exchange(geometry::StateArchive::reader(tree), 1, 3);
  EXPECT_FALSE(other.empty());
  AskedBreaks of_one_node;
  EXPECT_THROW(of_one_node.exchange(geometry::StateArchive::reader(tree), 1, 1),
               geometry::StateMismatch);
}

}  // namespace
}  // namespace plekton::dynamics::asked_breaks_test
