// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/io/import.hpp"
#include "geometry/mesh/io/mesh_file.hpp"
#include "tests/support/parameter_name.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace plekton::geometry::bad_input_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string message_of(const std::string& text, MeshFormat format) {
  try {
    parse_mesh(text, format, "membrane");
  } catch (const MeshError& error) {
    return error.what();
  }
  return "accepted";
}

/// A broken text and what its message must contain.
struct BadText {
  const char* what;
  MeshFormat format;
  std::string text;
  std::vector<std::string> parts;
  friend std::ostream& operator<<(std::ostream& out, const BadText& bad) { return out << bad.what; }
};

class BadMeshText : public ::testing::TestWithParam<BadText> {};

TEST_P(BadMeshText, IsRefusedWithAMessageThatNamesThePlaceAndWhatWasExpected) {
  const std::string message = message_of(GetParam().text, GetParam().format);

  EXPECT_THAT(message, HasSubstr("membrane: "));
  for (const std::string& part : GetParam().parts) EXPECT_THAT(message, HasSubstr(part));
}

constexpr auto kOff = MeshFormat::off;
constexpr auto kObj = MeshFormat::obj;
constexpr auto kStl = MeshFormat::stl_binary;
constexpr auto kPly = MeshFormat::ply;

const std::string kPoints = "0 0 0\n1 0 0\n0 1 0\n";
const std::string kObjPoints = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string kPlyHeader =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
    "z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kStlFacet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

INSTANTIATE_TEST_SUITE_P(
    Off, BadMeshText,
    ::testing::Values(
        BadText{"index out of range",
                kOff,
                "OFF\n3 1 0\n" + kPoints + "3 0 1 1200\n",
                {"line 6: facet 0 names point 1200, but the file has 3 points, numbered 0 to 2"}},
        BadText{
            "negative index", kOff, "OFF\n3 1 0\n" + kPoints + "3 0 1 -1\n", {"names point -1"}},
        BadText{"huge index",
                kOff,
                "OFF\n3 1 0\n" + kPoints + "3 0 1 99999999999999999999\n",
                {"line 6", "a corner of facet 0"}},
        BadText{"nan",
                kOff,
                "OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n",
                {"line 4: point 1 is at (1, nan, 0)", "finite"}},
        BadText{"infinity",
                kOff,
                "OFF\n3 1 0\n0 0 0\n1 -inf 0\n0 1 0\n3 0 1 2\n",
                {"point 1", "finite"}},
        BadText{"huge coordinate",
                kOff,
                "OFF\n3 1 0\n0 0 0\n1 1e76 0\n0 1 0\n3 0 1 2\n",
                {"1e+76", "below 1e75"}},
        BadText{"overflowing coordinate",
                kOff,
                "OFF\n3 1 0\n0 0 0\n1 1e999 0\n0 1 0\n3 0 1 2\n",
                {"inf"}},
        BadText{"a word for a number",
                kOff,
                "OFF\n3 1 0\n0 0 0\n1 zero 0\n0 1 0\n3 0 1 2\n",
                {"line 4: expected a coordinate of point 1, got 'zero'"}},
        BadText{"cut off in the points",
                kOff,
                "OFF\n1000 2000 0\n" + kPoints,
                {"coordinate of point 3", "the end of the file"}},
        BadText{"a count beyond any memory",
                kOff,
                "OFF\n999999999999 1 0\n" + kPoints,
                {"the end of the file"}},
        BadText{"a facet beyond any memory",
                kOff,
                "OFF\n3 1 0\n" + kPoints + "999999999999 0 1 2\n",
                {"the end of the file"}},
        BadText{"negative count",
                kOff,
                "OFF\n-3 1 0\n",
                {"line 2: expected the number of points, got -3"}},
        BadText{"another format",
                kOff,
                kObjPoints,
                {"line 1: expected the word OFF", "got another kind of file"}},
        BadText{"binary", kOff, "OFF BINARY\n", {"number of points", "'BINARY'"}},
        BadText{"four dimensions", kOff, "4OFF\n1 0 0\n0 0 0 0\n", {"3 dimensions"}},
        BadText{"more facets than announced",
                kOff,
                "OFF\n3 1 0\n" + kPoints + "3 0 1 2\n3 0 2 1\n",
                {"line 7: expected the end of the file after 1 facets"}}),
    test::name_of_parameter);

INSTANTIATE_TEST_SUITE_P(
    Obj, BadMeshText,
    ::testing::Values(
        BadText{"index out of range",
                kObj,
                kObjPoints + "f 1 2 4\n",
                {"line 4: facet 1 names point 4, but the file has 3 points, numbered 1 to 3"}},
        BadText{"index zero", kObj, kObjPoints + "f 0 1 2\n", {"names point 0"}},
        BadText{"negative index too far back", kObj, kObjPoints + "f -4 1 2\n", {"names point 0"}},
        BadText{"a word for a corner",
                kObj,
                kObjPoints + "f 1 2 x\n",
                {"line 4: expected corners of a facet", "'x'"}},
        BadText{"a point of two coordinates",
                kObj,
                "v 0 0\n",
                {"line 1: expected three coordinates", "end of the line"}},
        BadText{"nan", kObj, "v 0 nan 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", {"line 1: point 1"}},
        BadText{"facets without points", kObj, "f 1 2 3\n", {"the file has 0 points"}}),
    test::name_of_parameter);

INSTANTIATE_TEST_SUITE_P(
    Stl, BadMeshText,
    ::testing::Values(
        BadText{"too short for binary",
                kStl,
                std::string(60, '\0'),
                {"60 bytes", "header alone has 84"}},
        BadText{"cut off binary",
                kStl,
                format_mesh(box_shell({1.0, 1.0, 1.0}), kStl).substr(0, 300),
                {"claims 12 facets, that is 684 bytes, but the file has 300"}},
        BadText{"nan",
                kStl,
                "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 nan 0\nvertex 1 0 0\nvertex 0 1 "
                "0\nendloop\nendfacet\nendsolid",
                {"line 4: point 0"}},
        BadText{"cut off between facets",
                kStl,
                "solid a\n" + kStlFacet,
                {"expected facet or endsolid, got the end of the file"}},
        BadText{"cut off in a facet",
                kStl,
                "solid a\n" + kStlFacet + "facet normal 0 0 1\nouter loop\nvertex 0 0",
                {"coordinate of a corner", "end of the file"}},
        BadText{"garbage",
                kStl,
                "once upon a time\n",
                {"line 1: expected solid, got another kind of file"}},
        BadText{"a word for a number",
                kStl,
                "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 o 0\n",
                {"line 4", "'o'"}}),
    test::name_of_parameter);

INSTANTIATE_TEST_SUITE_P(
    Ply, BadMeshText,
    ::testing::Values(
        BadText{"index out of range",
                kPly,
                kPlyHeader + kPoints + "3 0 1 9\n",
                {"line 13: facet 0 names point 9, but the file has 3 points"}},
        BadText{"nan", kPly, kPlyHeader + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", {"line 11: point 1"}},
        BadText{"a list beyond any memory",
                kPly,
                kPlyHeader + kPoints + "2000000000 0 1 2\n",
                {"end of the file"}},
        BadText{"a negative list",
                kPly,
                kPlyHeader + kPoints + "-3 0 1 2\n",
                {"length of a list", "-3"}},
        BadText{"half an index",
                kPly,
                kPlyHeader + kPoints + "3 0 1 1.5\n",
                {"corner of a facet", "1.5"}},
        BadText{"a word",
                kPly,
                kPlyHeader + "0 0 0\n1 zero 0\n0 1 0\n3 0 1 2\n",
                {"line 11: expected a coordinate of a point, got 'zero'"}},
        BadText{"a fraction of a corner",
                kPly,
                kPlyHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1.5 2\n",
                {"line 13: expected a corner of a facet, got the number 1.5"}},
        BadText{"cut off",
                kPly,
                kPlyHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1",
                {"line 13: expected a corner of a facet, got the end of the file"}},
        BadText{"no header", kPly, "plonk\n", {"line 1: expected the word ply"}},
        BadText{"no end of the header",
                kPly,
                "ply\nformat ascii 1.0\n",
                {"header line", "end of the file"}},
        BadText{"an unknown type",
                kPly,
                "ply\nformat ascii 1.0\nelement vertex 1\nproperty length x\nend_header\n",
                {"line 4: expected property", "'property length x'"}},
        BadText{"no positions",
                kPly,
                "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n",
                {"lack a property x, y or z"}},
        BadText{"no corners",
                kPly,
                "ply\nformat ascii 1.0\nelement face 1\nproperty float x\nend_header\n0\n",
                {"lack an integer list"}},
        BadText{"no format", kPly, "ply\nend_header\n", {"format line"}},
        BadText{"cut off binary",
                kPly,
                "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float "
                "x\nproperty float y\nproperty float z\nend_header\n1234",
                {"a coordinate of a point, got the end of the file"}}),
    test::name_of_parameter);

TEST(BadMeshInput, ReportsAllProblemsOfAFileTogether) {
  const std::string message =
      message_of("OFF\n3 2 0\n0 0 nan\n1 0 0\n0 1 0\n3 0 1 7\n3 0 1 8\n", kOff);

  EXPECT_THAT(message, AllOf(HasSubstr("3 problems"), HasSubstr("line 3"), HasSubstr("line 6"),
                             HasSubstr("line 7")));
}

// A terminal would obey them.
TEST(BadMeshInput, ShowsTheControlCharactersOfAFileInEveryFormat) {
  const std::string bell = "\x1b[2J\a";
  for (const auto& [text, format] :
       std::vector<std::pair<std::string, MeshFormat>>{{bell + "\n", kOff},
                                                       {"OFF\n1 0 0\n0 0 " + bell, kOff},
                                                       {"v 0 0 " + bell + "\n", kObj},
                                                       {bell + "\n", kStl},
                                                       {"ply\n" + bell + "\n", kPly},
                                                       {"ply\nformat " + bell + "\n", kPly},
                                                       {"$" + bell + "\n", MeshFormat::gmsh},
                                                       {"<" + bell, MeshFormat::vtp}}) {
    const std::string message = message_of(text, format);

    EXPECT_NE(message, "accepted");
    EXPECT_EQ(message.find_first_of("\x1b\a"), std::string::npos) << message;
  }
  EXPECT_THAT(message_of("OFF\n1 0 0\n0 0 " + bell, kOff), HasSubstr("got '\\x1b[2J\\x07'"));
}

TEST(BadMeshInput, CutsALongListOfProblemsShort) {
  std::string text = "OFF\n3 500 0\n" + kPoints;
  for (int k = 0; k < 500; ++k) text += "3 0 1 9\n";

  EXPECT_THAT(message_of(text, kOff), AllOf(HasSubstr("500 problems"), HasSubstr("and 490 more")));
}

class BadMeshFile : public ::testing::Test {
 protected:
  std::string import_message(const std::string& name, const std::string& text) const {
    test::write_bytes(folder_ / name, text);
    return import_message(name);
  }
  std::string import_message(const std::string& name) const {
    try {
      import_mesh(folder_ / name);
    } catch (const MeshError& error) {
      return error.what();
    }
    return "accepted";
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(BadMeshFile, IsMissing) {
  EXPECT_THAT(import_message("none.stl"), HasSubstr("none.stl: no such file"));
}

TEST_F(BadMeshFile, IsAFolder) {
  EXPECT_THAT(import_message("."), HasSubstr("not a file"));
}

TEST_F(BadMeshFile, IsEmpty) {
  for (const char* name : {"a.off", "a.obj", "a.stl", "a.ply", "a.msh", "a.vtp"})
    EXPECT_THAT(import_message(name, ""), HasSubstr(std::string(name) + ": the file is empty"));
}

TEST_F(BadMeshFile, HasAnUnknownEnding) {
  EXPECT_THAT(import_message("a.step", "x"),
              AllOf(HasSubstr("'.step'"), HasSubstr(".off, .obj, .stl, .ply, .msh or .vtp")));
}

TEST_F(BadMeshFile, HasNoFacets) {
  EXPECT_THAT(import_message("a.off", "OFF\n3 0 0\n" + kPoints), HasSubstr("a.off: no facets"));
  EXPECT_THAT(import_message("a.obj", kObjPoints), HasSubstr("a.obj: no facets"));
  EXPECT_THAT(import_message("a.stl", "solid Empty\nendsolid Empty"),
              HasSubstr("a.stl: no facets"));
  EXPECT_THAT(import_message("b.stl", format_mesh({}, MeshFormat::stl_binary)),
              HasSubstr("b.stl: no facets"));
}

TEST_F(BadMeshFile, HasOnlyFacetsWithoutArea) {
  EXPECT_THAT(import_message("a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n3 0 0 1\n"),
              AllOf(HasSubstr("no facets are left"), HasSubstr("2 polygons")));
}

TEST_F(BadMeshFile, HasAPolygonThatCrossesItself) {
  EXPECT_THAT(import_message("a.off", "OFF\n4 1 0\n0 0 0\n1 1 0\n1 0 0\n0 1 0\n4 0 1 2 3\n"),
              HasSubstr("polygon 0 cannot be cut"));
}

// Every prefix of a file is a file that was cut off: it must be read or refused, and at once.
TEST(BadMeshInput, NeverCrashesOnACutOffFile) {
  const Mesh mesh = icosphere(1.0, 0);
  const auto start = std::chrono::steady_clock::now();

  for (const MeshFormat format :
       {kOff, kObj, MeshFormat::stl_ascii, kStl, kPly, MeshFormat::gmsh, MeshFormat::vtp}) {
    const std::string whole = format_mesh(mesh, format);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      try {
        parse_mesh(whole.substr(0, size), format, "mesh");
      } catch (const MeshError&) {
      }
    }
  }

  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

/// Seconds that a gmsh file of 84,000 nodes takes whose numbers are the multiples of a step.
double seconds_to_read_nodes(std::int64_t step) {
  constexpr std::int64_t kNodes = 84000;
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n84000\n";
  for (std::int64_t i = 1; i <= kNodes; ++i) text += std::to_string(i * step) + " 0 0 0\n";
  text += "$EndNodes\n";
  const auto start = std::chrono::steady_clock::now();
  parse_mesh(text, MeshFormat::gmsh, "mesh");
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// A table hashed by the number of the node took 100 times as long for them: 85,229 is the number of
// buckets of libstdc++ for so many entries. Half as long a text again is read in half as long
// again.
TEST(BadMeshInput, TakesNoLongerForNodeNumbersThatWouldShareABucket) {
  const double usual = std::min(seconds_to_read_nodes(3), seconds_to_read_nodes(3));

  EXPECT_LT(seconds_to_read_nodes(85229), 15.0 * usual);
}

// A byte changed anywhere: read or refused, and what is read can be repaired or is refused with a
// reason.
TEST(BadMeshInput, NeverCrashesOnADamagedFile) {
  const Mesh mesh = box_shell({1.0, 2.0, 3.0});

  for (const MeshFormat format :
       {kOff, kObj, MeshFormat::stl_ascii, kStl, kPly, MeshFormat::gmsh, MeshFormat::vtp}) {
    const std::string whole = format_mesh(mesh, format);
    for (std::size_t at = 0; at < whole.size(); ++at) {
      for (const char damage : {'\0', '-', '9', ' ', '\n', 'e', '\xff'}) {
        std::string text = whole;
        text[at] = damage;
        try {
          MeshReport report;
          repair(parse_mesh(text, format, "mesh"), {}, report);
        } catch (const MeshError&) {
        }
      }
    }
  }
}

}  // namespace
}  // namespace plekton::geometry::bad_input_test
