// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/io/mesh_file.hpp"

#include "geometry/mesh/generate/generators.hpp"
#include "geometry/mesh/io/byte_order.hpp"
#include "geometry/mesh/io/text_scanner.hpp"
#include "geometry/mesh/repair/repair.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/parameter_name.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace plekton::geometry::mesh_file_test {
namespace {

using ::testing::ElementsAre;

/// Corner positions of every polygon: what a file means, however it numbers its points.
std::vector<std::vector<Vec3>> positions(const PolygonSoup& soup) {
  std::vector<std::vector<Vec3>> all;
  for (const auto& polygon : soup.polygons) {
    auto& corners = all.emplace_back();
    for (const std::size_t corner : polygon) corners.push_back(soup.points[corner]);
  }
  return all;
}

Mesh awkward_mesh() {
  Mesh mesh = icosphere(0.1, 1);
  mesh.points[0] = {1.0 / 3.0, -1e-17, 6.02214076e23};
  mesh.points[1] = {5e-324, 1e6 + 1e-9, -0.1};
  return mesh;
}

struct TextFormat {
  MeshFormat format;
  const char* name;
};

void PrintTo(const TextFormat& of, std::ostream* out) {
  *out << of.name;
}

class EveryTextFormat : public ::testing::TestWithParam<TextFormat> {};

TEST_P(EveryTextFormat, ReadsBackTheSameCoordinates) {
  const Mesh mesh = awkward_mesh();

  const PolygonSoup read =
      parse_mesh(format_mesh(mesh, GetParam().format), GetParam().format, "mesh");

  EXPECT_EQ(positions(read), positions(to_soup(mesh)));
}

TEST_P(EveryTextFormat, ReadsFilesWithWindowsLineEnds) {
  const Mesh mesh = icosphere(0.1, 0);
  std::string text;
  for (const char c : format_mesh(mesh, GetParam().format))
    text += c == '\n' ? "\r\n" : std::string(1, c);

  EXPECT_EQ(positions(parse_mesh(text, GetParam().format, "mesh")), positions(to_soup(mesh)));
}

INSTANTIATE_TEST_SUITE_P(MeshFile, EveryTextFormat,
                         ::testing::Values(TextFormat{MeshFormat::off, "off"},
                                           TextFormat{MeshFormat::obj, "obj"},
                                           TextFormat{MeshFormat::stl_ascii, "stl_ascii"},
                                           TextFormat{MeshFormat::ply, "ply"},
                                           TextFormat{MeshFormat::gmsh, "gmsh"},
                                           TextFormat{MeshFormat::vtp, "vtp"}),
                         test::name_of_parameter);

TEST(MeshFile, KeepsBinaryStlToSinglePrecision) {
  const Mesh mesh = icosphere(0.1, 1);

  const auto read = positions(
      parse_mesh(format_mesh(mesh, MeshFormat::stl_binary), MeshFormat::stl_binary, "mesh"));

  const auto expected = positions(to_soup(mesh));
  ASSERT_EQ(read.size(), expected.size());
  for (std::size_t f = 0; f < read.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      for (const int axis : {0, 1, 2})
        EXPECT_EQ(read[f][k][axis], static_cast<double>(static_cast<float>(expected[f][k][axis])));
}

TEST(MeshFile, WritesAndReadsFilesOfEveryEndingInEitherCase) {
  const test::TemporaryFolder folder;
  const Mesh mesh = box_shell({1.0, 2.0, 4.0});

  for (const char* name : {"a.off", "a.OBJ", "a.stl", "a.ply"}) {
    write_mesh_file(folder / name, mesh);
    EXPECT_EQ(positions(read_mesh_file(folder / name)), positions(to_soup(mesh))) << name;
  }

  EXPECT_THAT(folder.names(), ElementsAre("a.OBJ", "a.off", "a.ply", "a.stl"));
}

TEST(MeshFile, SaysWhyAFileCannotBeWrittenAndLeavesNone) {
  const test::TemporaryFolder folder;

  EXPECT_THROW(write_mesh_file(folder / "none/a.off", box_shell({1.0, 1.0, 1.0})), UnwrittenMesh);
  EXPECT_THROW(write_mesh_file(folder / "a.step", box_shell({1.0, 1.0, 1.0})), MeshError);
  EXPECT_TRUE(folder.names().empty());
}

TEST(MeshFile, RefusesToWriteCoordinatesThatNoFileIsReadWith) {
  const test::TemporaryFolder folder;
  for (const double value : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e75, -1e75}) {
    Mesh mesh = box_shell({1.0, 2.0, 4.0});
    mesh.points[5][1] = value;
    for (const char* name : {"a.off", "a.obj", "a.stl", "a.ply", "a.msh", "a.vtp"})
      EXPECT_THAT([&] { write_mesh_file(folder / name, mesh); },
                  testing::ThrowsMessage<MeshError>(testing::HasSubstr("point 5 is at (")))
          << name << ' ' << value;
  }
  Mesh large = box_shell({1.0, 2.0, 4.0});
  large.points[5][1] = 3.5e38;  // above the largest float
  EXPECT_THROW(format_mesh(large, MeshFormat::stl_binary), MeshError);
  EXPECT_NO_THROW(format_mesh(large, MeshFormat::stl_ascii));
  EXPECT_TRUE(folder.names().empty());
}

TEST(MeshFile, KeepsTheOldFileWhenTheDiskFillsUp) {
  const test::TemporaryFolder folder;
  write_mesh_file(folder / "a.off", box_shell({1.0, 1.0, 1.0}));
  const std::string before = test::bytes_of(folder / "a.off");

  {
    const test::FileSizeLimit limit(1000);
    EXPECT_THROW(write_mesh_file(folder / "a.off", icosphere(1.0, 4)), MeshError);
  }

  EXPECT_EQ(test::bytes_of(folder / "a.off"), before);
  EXPECT_THAT(folder.names(), ElementsAre("a.off"));
}

TEST(MeshFile, FollowsNoLinkInThePlaceOfItsTemporaryFile) {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "victim", "precious");
  std::filesystem::create_symlink(folder / "victim", folder / "a.off.part");

  EXPECT_THAT(
      [&] {
        write_mesh_file(folder / "a.off", box_shell({1.0, 1.0, 1.0}));
      },
      testing::ThrowsMessage<MeshError>(testing::HasSubstr("a.off.part")));
  EXPECT_EQ(test::bytes_of(folder / "victim"), "precious");
  EXPECT_THAT(folder.names(), ElementsAre("a.off.part", "victim"));
}

TEST(MeshFile, TellsTheFormatByItsFirstWordsAndOnlyThenByItsEnding) {
  const Mesh mesh = box_shell({1.0, 2.0, 4.0});
  for (const MeshFormat format :
       {MeshFormat::off, MeshFormat::obj, MeshFormat::ply, MeshFormat::stl_ascii,
        MeshFormat::stl_binary, MeshFormat::gmsh, MeshFormat::vtp}) {
    EXPECT_EQ(detect_mesh_format(format_mesh(mesh, format), "renamed.off"), format);
    EXPECT_EQ(detect_mesh_format(format_mesh(mesh, format), "without_ending"), format);
  }
  EXPECT_EQ(detect_mesh_format("# by hand\n\n NOFF 0 0 0", "a.txt"), MeshFormat::off);
  EXPECT_EQ(detect_mesh_format("<!-- by hand -->\n<VTKFile type=\"PolyData\"", "a"),
            MeshFormat::vtp);
  EXPECT_EQ(detect_mesh_format("v 0 0 0", "a.OBJ"), MeshFormat::obj);
  EXPECT_EQ(detect_mesh_format("", "a.MSH"), MeshFormat::gmsh);
  EXPECT_THROW(detect_mesh_format("0 0 0", "a.txt"), MeshError);
}

TEST(MeshFile, TellsObjByItsFirstWordAndBinaryStlByItsSizeWhateverItsHeaderSays) {
  for (const std::string word : {"v", "vt", "vn", "o", "g", "mtllib", "usemtl"})
    EXPECT_EQ(detect_mesh_format("# by hand\n" + word + " 0 0 0", "a.ply"), MeshFormat::obj);
  std::string stl = format_mesh(box_shell({1.0, 2.0, 4.0}), MeshFormat::stl_binary);
  for (const std::string header : {"v ", "OFF ", "solid ", "ply "}) {
    stl.replace(0, header.size(), header);
    EXPECT_EQ(detect_mesh_format(stl, "a.obj"), MeshFormat::stl_binary) << header;
  }
  EXPECT_EQ(detect_mesh_format(stl + ' ', "a.stl"), MeshFormat::ply);
}

TEST(MeshFile, TellsBinaryFromAsciiStlByContent) {
  const Mesh mesh = box_shell({1.0, 2.0, 4.0});
  std::string binary = format_mesh(mesh, MeshFormat::stl_binary);
  binary.replace(0, 10, "solid cube");

  EXPECT_EQ(parse_mesh(binary, MeshFormat::stl_ascii, "mesh").polygons.size(), 12u);
  EXPECT_EQ(parse_mesh(format_mesh(mesh, MeshFormat::stl_ascii), MeshFormat::stl_binary, "mesh")
                .polygons.size(),
            12u);
}

TEST(MeshFile, ReadsAsciiStlWithSeveralSolidsCapitalsAndNanNormals) {
  const std::string solid =
      "SOLID a part of facet\nFACET NORMAL nan nan nan\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 "
      "0\nVERTEX 0 1e0 +0\n"
      "ENDLOOP\nENDFACET\nENDSOLID a part of facet\n";

  const PolygonSoup soup = parse_mesh(solid + solid, MeshFormat::stl_ascii, "mesh");

  EXPECT_EQ(soup.polygons.size(), 2u);
  EXPECT_EQ(soup.points.size(), 6u)
      << "points of an STL file are not shared; merging them is for repair to count";
}

TEST(MeshFile, ReadsEveryFormOfAnObjCorner) {
  const std::string text =
      "# a comment\nmtllib x.mtl\no name\nv 0 0 0 0.5 0.5 nan\nv 1 0 0\nv 0 1 0 # trailing\nvt 0 "
      "0\nvn 0 0 1\nusemtl m\n"
      "s 1\nf 1 2 3\nf 1/1 2/1 3/1\nf 1//1 2//1 3//1\nf 1/1/1\t2/1/1\t3/1/1\nf -3 -2 -1\nf 1// 2// "
      "3//\nf 2 \\\n 3 \\\r\n 1\nl 1 2\n";

  const PolygonSoup soup = parse_mesh(text, MeshFormat::obj, "mesh");

  ASSERT_EQ(soup.polygons.size(), 7u);
  for (std::size_t f = 0; f < 6; ++f)
    EXPECT_THAT(soup.polygons[f], ElementsAre(0, 1, 2)) << "facet " << f;
  EXPECT_THAT(soup.polygons[6], ElementsAre(1, 2, 0));
}

TEST(MeshFile, CountsNegativeObjCornersFromThePointsReadSoFar) {
  const PolygonSoup soup =
      parse_mesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 1\nf -3 -2 -1\nf 5 1 2\nv 1 1 1\n",
                 MeshFormat::obj, "mesh");

  EXPECT_THAT(soup.polygons[0], ElementsAre(0, 1, 2));
  EXPECT_THAT(soup.polygons[1], ElementsAre(1, 2, 3));
  EXPECT_THAT(soup.polygons[2], ElementsAre(4, 0, 1))
      << "a facet may name a point that only follows";
}

TEST(MeshFile, PassesOverColoursCommentsAndTheMissingEdgeCountOfOff) {
  const PolygonSoup soup = parse_mesh(
      "\xef\xbb\xbf# made by hand\nCOFF # with colours\n4 2\n\n0 0 0 255 0 0 255\n1 0 0 255 0 0 "
      "255\n1 1 0 0 0 0 0\n0 1 0 0 0 0 0\n"
      "3 0 1 2 0.5 0.5 0.5\n# between\n4 0 1 2 3",
      MeshFormat::off, "mesh");

  EXPECT_EQ(soup.points.size(), 4u);
  EXPECT_THAT(soup.polygons, ElementsAre(ElementsAre(0, 1, 2), ElementsAre(0, 1, 2, 3)));
}

TEST(MeshFile, PassesOverTheByteOrderMarkOfAPlyOfText) {
  constexpr std::string_view kText =
      "\xef\xbb\xbfply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

  EXPECT_EQ(detect_mesh_format(kText, "a.ply"), MeshFormat::ply);
  EXPECT_THAT(parse_mesh(kText, MeshFormat::ply, "mesh").polygons,
              ElementsAre(ElementsAre(0, 1, 2)));
}

/// A binary PLY of one quadrilateral with properties and an element that nobody asked for.
template <class Append>
std::string ply_with(const std::string& format, const Append& append) {
  std::string bytes = "ply\nformat " + format +
                      " 1.0\ncomment made by hand\nelement material 1\nproperty list uchar short "
                      "data\nelement vertex 4\n"
                      "property uchar red\nproperty double x\nproperty float y\nproperty short z\n"
                      "element face 1\nproperty float quality\nproperty list ushort uint "
                      "vertex_index\nend_header\n";
  append(bytes, std::uint8_t{2});
  append(bytes, std::int16_t{7});
  append(bytes, std::int16_t{8});
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    append(bytes, std::uint8_t{10});
    append(bytes, static_cast<double>(x));
    append(bytes, static_cast<float>(y));
    append(bytes, std::int16_t{-3});
  }
  append(bytes, 0.5f);
  append(bytes, std::uint16_t{4});
  for (const std::uint32_t corner : {0u, 1u, 2u, 3u}) append(bytes, corner);
  return bytes;
}

TEST(MeshFile, ReadsBinaryPlyOfEitherByteOrder) {
  const auto little = [](std::string& bytes, auto number) { append_little(bytes, number); };
  const auto big = [](std::string& bytes, auto number) {
    std::string one;
    append_little(one, number);
    bytes.append(one.rbegin(), one.rend());
  };

  for (const std::string& bytes :
       {ply_with("binary_little_endian", little), ply_with("binary_big_endian", big)}) {
    const PolygonSoup soup = parse_mesh(bytes, MeshFormat::ply, "mesh");
    EXPECT_THAT(soup.polygons, ElementsAre(ElementsAre(0, 1, 2, 3)));
    EXPECT_EQ(soup.points[2], Vec3(1.0, 1.0, -3.0));
  }
}

TEST(ParseNumber, AcceptsWholeDecimalNumbersOnly) {
  EXPECT_EQ(parse_number("-1.5e-3"), -1.5e-3);
  EXPECT_EQ(parse_number("+.5"), 0.5);
  EXPECT_EQ(parse_number("1e-999"), 0.0);
  EXPECT_EQ(parse_number("-1e999"), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(parse_number("nan").value()));
  for (const char* word : {"", "+", "-", "--1", "+-1", "1,5", "1.5m", "0x10", "one"})
    EXPECT_FALSE(parse_number(word)) << word;
}

}  // namespace
}  // namespace plekton::geometry::mesh_file_test
