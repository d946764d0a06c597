// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/generate/membrane.hpp"

#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/io/import.hpp"
#include "geometry/mesh/io/mesh_file.hpp"
#include "geometry/primitives/elements.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace plekton::geometry::membrane_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(MakeMembrane, ThickensFacetsAndListsEveryEdgeOnce) {
  const Mesh mesh = plane_sheet({.width = 1.0, .length = 1.0, .cells_x = 4, .cells_y = 4});

  const Membrane membrane = make_membrane(mesh, {.thickness = 0.01});

  EXPECT_EQ(membrane.nodes, mesh.points);
  ASSERT_EQ(membrane.facets.size(), 32u);
  EXPECT_EQ(membrane.facets[7].nodes, mesh.facets[7]);
  EXPECT_EQ(membrane.facets[7].radius, 0.005);
  EXPECT_EQ(membrane.edges.size(), 56u);  // V - E + F = 1 with 25 nodes
  EXPECT_TRUE(std::is_sorted(membrane.edges.begin(), membrane.edges.end()));
  EXPECT_THAT(membrane.warnings, IsEmpty());
}

TEST(MakeMembrane, NumbersNodesFromTheFirstOne) {
  const Membrane membrane =
      make_membrane(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{NodeId{0}, NodeId{1}, NodeId{2}}}},
                    {.thickness = 0.1, .first_node = 100});

  EXPECT_THAT(membrane.facets[0].nodes, ElementsAre(NodeId{100}, NodeId{101}, NodeId{102}));
  EXPECT_THAT(membrane.edges, ElementsAre(ElementsAre(NodeId{100}, NodeId{101}),
                                          ElementsAre(NodeId{100}, NodeId{102}),
                                          ElementsAre(NodeId{101}, NodeId{102})));
}

TEST(MakeMembrane, RefusesNumbersThatNoNodeHas) {
  const Mesh mesh = plane_sheet({1.0, 1.0, 2, 2});
  for (const std::size_t first : {std::numeric_limits<std::size_t>::max() - 2, std::size_t{1} << 40,
                                  std::size_t{2147483640}}) {
    EXPECT_THROW(make_membrane(mesh, {.thickness = 0.01, .first_node = first}), MeshError);
  }
  EXPECT_NO_THROW(make_membrane(mesh, {.thickness = 0.01, .first_node = 2147483647 - 9}));
}

TEST(MakeMembrane, NamesAFacetThatRepeatsANode) {
  Mesh mesh = plane_sheet({1.0, 1.0, 2, 2});
  mesh.facets[5][2] = mesh.facets[5][0];

  EXPECT_THAT([&] { make_membrane(mesh, {.thickness = 0.01}); },
              ::testing::ThrowsMessage<MeshError>(HasSubstr("facet 5 repeats a node")));
}

TEST(MakeMembrane, GivesASurfaceThatContactCanUse) {
  const Mesh mesh = icosphere(1.0, 2);

  const Membrane membrane = make_membrane(mesh, {.thickness = 0.05});
  const Surface surface({}, membrane.facets, membrane.nodes.size());

  EXPECT_EQ(surface.edge_count(), membrane.edges.size());
  EXPECT_EQ(surface.euler_characteristic(), 2);
}

TEST(MakeMembrane, WarnsWhenTheThicknessExceedsAnEdge) {
  const Mesh mesh = plane_sheet({.width = 1.0, .length = 1.0, .cells_x = 10, .cells_y = 2});

  EXPECT_THAT(make_membrane(mesh, {.thickness = 0.11}).warnings,
              ElementsAre(HasSubstr("exceeds the length of 30 of")));
}

TEST(MakeMembrane, WarnsWhenTheSheetIsThickerThanItsFoldsAreWide) {
  // A strip folded back by nearly pi: heights 1, so the fold has a radius of about 1 / pi.
  const Mesh fold{{{0, 0, 0}, {0, 1, 0}, {1, 0.5, 0.01}, {1, 0.5, -0.01}},
                  {{NodeId{0}, NodeId{2}, NodeId{1}}, {NodeId{0}, NodeId{1}, NodeId{3}}}};

  EXPECT_THAT(make_membrane(fold, {.thickness = 0.6}).warnings, IsEmpty());
  EXPECT_THAT(make_membrane(fold, {.thickness = 0.7}).warnings,
              ElementsAre(HasSubstr("exceeds the radius of 1 folds")));
}

TEST(ImportMembrane, GoesFromAFileToAMembraneInOneCall) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "ball.stl";
  write_mesh_file(file, icosphere(1.0, 2));

  const ImportedMembrane thin = import_membrane(file, {.thickness = 0.05, .first_node = 10});
  const ImportedMembrane thick = import_membrane(file, {.thickness = 1.0});

  EXPECT_EQ(thin.membrane.facets.size(), 320u);
  EXPECT_EQ(thin.membrane.nodes, thin.mesh.points);
  EXPECT_EQ(thin.report.verdict, MeshVerdict::ok);
  EXPECT_EQ(thick.report.verdict, MeshVerdict::usable_with_warnings);
  EXPECT_THAT(thick.report.reasons, ElementsAre(HasSubstr("exceeds the length of")));
  EXPECT_THROW(import_membrane(file, {.thickness = 0.0}), MeshError);
  EXPECT_THROW(import_membrane(folder.path() / "none.stl", {.thickness = 0.1}), MeshError);
}

TEST(MakeMembrane, RefusesAThicknessThatIsNoLengthAndAnEmptyMesh) {
  EXPECT_THROW(make_membrane(icosphere(1.0, 0), {.thickness = 0.0}), MeshError);
  EXPECT_THROW(make_membrane(icosphere(1.0, 0), {.thickness = -1.0}), MeshError);
  EXPECT_THROW(make_membrane({}, {.thickness = 1.0}), MeshError);
  EXPECT_THROW(make_membrane(icosphere(1.0, 0), {.thickness = 0.1, .first_node = 2147483640}),
               MeshError);
}

}  // namespace
}  // namespace plekton::geometry::membrane_test
