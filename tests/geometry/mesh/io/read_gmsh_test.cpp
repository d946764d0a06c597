// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/io/import.hpp"
#include "geometry/mesh/io/mesh_file.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace plekton::geometry::read_gmsh_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kFormat22 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string kFormat41 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";

/// A unit square of a triangle pair beside a quadrangle; node numbers with gaps, not ascending.
const std::string kNodes22 =
    "$Nodes\n6\n10 0 0 0\n7 1 0 0\n30 1 1 0\n2 0 1 0\n99 2 0 0\n98 2 1 0\n$EndNodes\n";

PolygonSoup parsed(const std::string& text) {
  return parse_mesh(text, MeshFormat::gmsh, "membrane");
}

std::string message_of(const std::string& text) {
  try {
    parsed(text);
  } catch (const MeshError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(GmshReader, ReadsTrianglesAndQuadranglesOfVersion22AndCountsTheRest) {
  const PolygonSoup soup =
      parsed(kFormat22 + "$PhysicalNames\n1\n2 1 \"the $Nodes of a sheet\"\n$EndPhysicalNames\n" +
             kNodes22 +
             "$Elements\n6\n1 15 2 0 1 10\n2 1 2 0 1 10 7\n3 2 2 0 1 10 7 30\n4 2 3 0 1 5 10 30 2\n"
             "5 3 0 7 99 98 30\n6 4 2 0 1 10 7 30 98\n$EndElements\n"
             "$NodeData\n1\n\"pressure\"\n1\n0.0\n$EndNodeData\n");

  EXPECT_THAT(soup.polygons,
              ElementsAre(ElementsAre(0, 1, 2), ElementsAre(0, 2, 3), ElementsAre(1, 4, 5, 2)));
  EXPECT_EQ(soup.points[4], Vec3(2, 0, 0));
  EXPECT_EQ(soup.skipped_elements, 3u) << "a point, a line and a tetrahedron";
}

TEST(GmshReader, ReadsTheBlocksOfVersion41) {
  const PolygonSoup soup =
      parsed(kFormat41 +
             "$Entities\n0 0 1 0\n1 0 0 0 1 1 0 0 0\n$EndEntities\n"
             "$Nodes\n3 6 2 99\n0 1 0 1\n10\n0 0 0\n1 4 1 2\n7\n30\n1 0 0 0.25\n1 1 0 0.5\n"
             "2 1 0 3\n2\n99\n98\n0 1 0\n2 0 0\n2 1 0\n$EndNodes\n"
             "$Elements\n3 4 1 6\n1 4 1 1\n1 7 30\n2 1 2 2\n3 10 7 30\n4 10 30 2\n2 1 3 1\n"
             "5 7 99 98 30\n$EndElements\n");

  EXPECT_THAT(soup.polygons,
              ElementsAre(ElementsAre(0, 1, 2), ElementsAre(0, 2, 3), ElementsAre(1, 4, 5, 2)));
  EXPECT_EQ(soup.points[2], Vec3(1, 1, 0));
  EXPECT_EQ(soup.points[4], Vec3(2, 0, 0));
  EXPECT_EQ(soup.skipped_elements, 1u);
}

TEST(GmshReader, PutsTheSkippedElementsIntoTheReport) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "a.msh",
                    kFormat22 + kNodes22 +
                        "$Elements\n4\n1 15 0 10\n2 1 0 10 7\n3 2 0 10 7 30\n4 2 0 10 30 2\n"
                        "$EndElements\n");

  const ImportedMesh imported = import_mesh(folder / "a.msh");

  EXPECT_EQ(imported.report.found.skipped_elements, 2u);
  EXPECT_THAT(to_text(imported.report), HasSubstr("points, lines and solids left out       2\n"));
  EXPECT_THAT(to_json(imported.report), HasSubstr("\"skipped_elements\": 2"));
  EXPECT_EQ(imported.mesh.facets.size(), 2u);
}

TEST(GmshReader, RefusesABinaryFileWithAdvice) {
  EXPECT_THAT(message_of("$MeshFormat\n4.1 1 8\n\1$EndMeshFormat\n"),
              AllOf(HasSubstr("line 2: a binary .msh file"), HasSubstr("Mesh.Binary = 0")));
}

TEST(GmshReader, RefusesOtherVersionsWithAdvice) {
  EXPECT_THAT(message_of("$MeshFormat\n4 0 8\n$EndMeshFormat\n"),
              AllOf(HasSubstr("line 2: expected version 2.2 or 4.1"), HasSubstr("got '4'")));
}

TEST(GmshReader, RefusesCurvedElementsBecauseTheirCornersAreAnotherSurface) {
  EXPECT_THAT(
      message_of(kFormat22 + kNodes22 + "$Elements\n1\n5 9 0 10 7 30 2 99 98\n$EndElements\n"),
      AllOf(HasSubstr("line 15: element 5 of type 9 is curved"), HasSubstr("first order")));
}

TEST(GmshReader, NamesTheLineOfWhatIsWrong) {
  const std::string elements = "$Elements\n1\n1 2 0 10 7 31\n$EndElements\n";
  EXPECT_THAT(message_of(kFormat22 + kNodes22 + elements),
              HasSubstr("line 15: element 1 names node 31, which the file does not have"));
  EXPECT_THAT(message_of(kFormat22 + "$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n"),
              HasSubstr("line 7: node 1 is there twice"));
  EXPECT_THAT(message_of(kFormat22 + "$Nodes\n1\n1 0 nan 0\n$EndNodes\n"),
              AllOf(HasSubstr("line 6: point 0"), HasSubstr("finite")));
  EXPECT_THAT(message_of(kFormat22 + "$Nodes\n1\n1 0 zero 0\n$EndNodes\n"),
              HasSubstr("line 6: expected a coordinate of a node, got 'zero'"));
  EXPECT_THAT(message_of(kFormat22 + "$Nodes\n-1\n"), HasSubstr("line 5: expected the number"));
  EXPECT_THAT(message_of(kFormat22 + "$Nodes\n0\n1 0 0 0\n$EndNodes\n"),
              HasSubstr("line 6: expected $EndNodes, got '1'"));
  EXPECT_THAT(message_of(kFormat22 + kNodes22 + kNodes22), HasSubstr("line 13"));
  EXPECT_THAT(message_of(kFormat22 + "$Comments\nfor ever"), HasSubstr("expected $EndComments"));
  EXPECT_THAT(message_of("v 0 0 0\n"), HasSubstr("line 1: expected a section"));
}

TEST(GmshReader, WantsTheSectionsItNeeds) {
  EXPECT_THAT(message_of(kFormat22), HasSubstr("no section $Nodes"));
  EXPECT_THAT(message_of(kFormat22 + "$Elements\n0\n$EndElements\n"),
              HasSubstr("no section $Nodes"));
  EXPECT_THAT(message_of(kNodes22), HasSubstr("no section $MeshFormat"));
}

TEST(GmshReader, BelievesNoCount) {
  for (const std::string& text :
       {kFormat22 + "$Nodes\n999999999999\n1 0 0 0\n", kFormat41 + "$Nodes\n999999999999 1 1 1\n",
        kFormat41 + "$Nodes\n1 1 1 1\n2 1 0 999999999999\n1 2\n",
        kFormat22 + kNodes22 + "$Elements\n1\n1 2 999999999999 0\n",
        kFormat41 + "$Nodes\n0 0 0 0\n$EndNodes\n$Elements\n1 1 1 1\n1 1 1 999999999999\n1 1 2\n"})
    EXPECT_THAT(message_of(text), HasSubstr("the end of the file"));
}

}  // namespace
}  // namespace plekton::geometry::read_gmsh_test
