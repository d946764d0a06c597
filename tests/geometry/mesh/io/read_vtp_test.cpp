// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/io/mesh_file.hpp"
#include "tests/support/vtp_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <string>
#include <utility>
#include <vector>

namespace plekton::geometry::read_vtp_test {
namespace {

using test::VtpPiece;
using test::VtpStyle;
using test::VtpText;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

PolygonSoup parsed(const std::string& text) {
  return parse_mesh(text, MeshFormat::vtp, "membrane");
}

std::string message_of(const std::string& text) {
  try {
    parsed(text);
  } catch (const MeshError& error) {
    return error.what();
  }
  return "accepted";
}

/// A triangle and a quadrangle; coordinates that a float holds exactly.
const VtpPiece kPolygons = {.coordinates = {0, 0, 0, 1, 0, 0, 1, 1.5, 0, 0, 1, -0.25, 2, 0, 0},
                            .polys = {1, 4, 2, 0, 1, 2, 3},
                            .poly_offsets = {3, 7},
                            .strips = {},
                            .strip_offsets = {}};
/// Five corners in a strip: three triangles; and two lines.
const VtpPiece kStrip = {.coordinates = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0},
                         .polys = {},
                         .poly_offsets = {},
                         .strips = {0, 1, 2, 3, 4},
                         .strip_offsets = {5},
                         .lines = 2};

std::vector<VtpStyle> all_styles() {
  using Where = VtpStyle::Where;
  std::vector<VtpStyle> styles = {{}};
  for (const Where where : {Where::in_place, Where::appended_base64, Where::appended_raw})
    for (int bits = 0; bits < 16; ++bits)
      styles.push_back({where, (bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0});
  return styles;
}

TEST(VtpReader, ReadsPolygonsStripsAndPiecesInEveryEncoding) {
  for (const VtpStyle& style : all_styles()) {
    const PolygonSoup soup = parsed(VtpText(style).file({kPolygons, kStrip}));

    ASSERT_EQ(soup.points.size(), 10u);
    EXPECT_EQ(soup.points[3], Vec3(0, 1, -0.25));
    EXPECT_THAT(soup.polygons,
                ElementsAre(ElementsAre(1, 4, 2), ElementsAre(0, 1, 2, 3), ElementsAre(5, 6, 7),
                            ElementsAre(7, 6, 8), ElementsAre(7, 8, 9)));
    EXPECT_EQ(soup.skipped_elements, 2u);
  }
}

TEST(VtpReader, KeepsTheSideOfAStrip) {
  const PolygonSoup soup = parsed(VtpText({}).file({kStrip}));

  for (const auto& corners : soup.polygons) {
    const Vec3& a = soup.points[corners[0]];
    EXPECT_LT((soup.points[corners[1]] - a).cross(soup.points[corners[2]] - a)[2], 0.0);
  }
}

TEST(VtpReader, ReadsAnEmptyFile) {
  EXPECT_TRUE(parsed("<VTKFile type=\"PolyData\"><PolyData/></VTKFile>").polygons.empty());
  EXPECT_TRUE(parsed(VtpText({}).file({VtpPiece{}})).polygons.empty());
}

/// A file of text with a part replaced.
std::string with(const std::string& old_part, const std::string& new_part) {
  std::string text = VtpText({}).file({kPolygons});
  const std::size_t at = text.find(old_part);
  EXPECT_NE(at, std::string::npos) << old_part;
  return text.replace(at, old_part.size(), new_part);
}

TEST(VtpReader, NamesTheLineOfWhatIsWrong) {
  EXPECT_THAT(
      message_of(with("\"PolyData\"", "\"UnstructuredGrid\"")),
      AllOf(HasSubstr("line 2"), HasSubstr("'UnstructuredGrid'"), HasSubstr("Extract Surface")));
  EXPECT_THAT(message_of(with("NumberOfPoints=\"5\"", "NumberOfPoints=\"6\"")),
              HasSubstr("line 7: expected 3 coordinates of 6 points, got 15 numbers"));
  EXPECT_THAT(message_of(with("NumberOfPoints=\"5\"", "NumberOfPoints=\"-5\"")),
              HasSubstr("line 4: NumberOfPoints is '-5'"));
  EXPECT_THAT(message_of(with("NumberOfPolys=\"2\"", "NumberOfPolys=\"3\"")),
              HasSubstr("expected 3 offsets of Polys, got 2"));
  EXPECT_THAT(message_of(with("1 4 2", "1 5 2")), HasSubstr("a cell names point 5"));
  EXPECT_THAT(message_of(with("1 4 2", "1 x 2")), HasSubstr("line 13: expected a whole number"));
  EXPECT_THAT(message_of(with("\n3 7 ", "\n7 3 ")), HasSubstr("the offset 3 after 7"));
  EXPECT_THAT(message_of(with("\n3 7 ", "\n3 8 ")), HasSubstr("end at 7"));
  EXPECT_THAT(message_of(with("\n3 7 ", "\n3 6 ")), HasSubstr("the last offset is 6; expected 7"));
  EXPECT_THAT(message_of(with("Name=\"offsets\"", "Name=\"of\"")), HasSubstr("array offsets"));
  EXPECT_THAT(message_of(with("</Points>", "</Point>")),
              HasSubstr("expected the end tag of 'Points', got that of 'Point'"));
  EXPECT_THAT(message_of(with("ascii\">\n0.0", "hex\">\n0.0")), HasSubstr("format 'hex'"));
  EXPECT_THAT(message_of("<VTKFile type=PolyData>"), HasSubstr("a value in quotes"));
  EXPECT_THAT(message_of("once upon a time"), HasSubstr("expected the root VTKFile"));
}

TEST(VtpReader, RefusesArraysOfAnotherCompressorButReadsTheTextBesideIt) {
  const std::string text = with("<VTKFile", "<VTKFile compressor=\"vtkLZ4DataCompressor\"");
  std::string packed = VtpText({.where = VtpStyle::Where::in_place}).file({kPolygons});
  packed.replace(packed.find("<VTKFile"), 8, "<VTKFile compressor=\"vtkLZ4DataCompressor\"");

  EXPECT_EQ(parsed(text).polygons.size(), 2u);
  EXPECT_THAT(message_of(packed), AllOf(HasSubstr("packed by 'vtkLZ4DataCompressor'"),
                                        HasSubstr("expected vtkZLibDataCompressor or none")));
}

TEST(VtpReader, RefusesMoreLevelsThanAnyFileHas) {
  std::string text = "<VTKFile>";
  for (int k = 0; k < 100000; ++k) text += "<a>";

  EXPECT_THAT(message_of(text), HasSubstr("64 levels"));
}

TEST(VtpReader, BelievesNoLengthOfAnArray) {
  const std::string start =
      "<VTKFile type=\"PolyData\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">"
      "<PolyData><Piece NumberOfPoints=\"1\"><Points><DataArray type=\"Float64\" "
      "format=\"appended\" offset=\"0\"/></Points></Piece></PolyData>"
      "<AppendedData encoding=\"raw\">_";
  std::string huge_block, many_blocks;
  for (const std::uint64_t number : {1ull, 1ull << 60, 0ull, 4ull})
    append_little(huge_block, number);
  append_little(many_blocks, ~std::uint64_t{0});

  EXPECT_THAT(message_of(start + huge_block + "abcd"), HasSubstr("unpacks to more numbers"));
  EXPECT_THAT(message_of(start + many_blocks + std::string(64, 'x')), HasSubstr("ends before"));
}

/// Zeros, packed as VTK does it, in one block.
std::string packed_zeros(std::size_t count) {
  const std::string zeros(count, '\0');
  uLongf size = compressBound(count);
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(zeros.data()), count);
  std::string bytes;
  for (const std::uint64_t number :
       {std::uint64_t{1}, std::uint64_t{count}, std::uint64_t{0}, std::uint64_t{size}})
    append_little(bytes, number);
  return bytes + packed.substr(0, size);
}

TEST(VtpReader, UnpacksNoMoreThanAMeshOfTheFileCanHold) {
  // Ten kilobytes that would become ten million polygons without a corner.
  const std::size_t cells = 10'000'000;
  const std::string array = packed_zeros(cells);
  const std::string offset = "offset=\"0\"/>";
  const std::string file =
      "<VTKFile type=\"PolyData\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">"
      "<PolyData><Piece NumberOfPoints=\"1\" NumberOfPolys=\"" +
      std::to_string(cells) +
      "\">"
      "<Points><DataArray type=\"Float64\" format=\"ascii\">0 0 0</DataArray></Points><Polys>"
      "<DataArray Name=\"connectivity\" type=\"UInt8\" format=\"appended\" " +
      offset + "<DataArray Name=\"offsets\" type=\"UInt8\" format=\"appended\" " + offset +
      "</Polys></Piece></PolyData><AppendedData encoding=\"raw\">_" + array;

  EXPECT_LT(file.size(), 12'000u);
  EXPECT_THAT(message_of(file),
              AllOf(HasSubstr("the array 'connectivity' unpacks to more numbers"),
                    HasSubstr("16 for each of its " + std::to_string(file.size()) + " bytes")));
}

TEST(VtpReader, UnpacksAnArrayThatManyPiecesNameNoMoreOftenThanTheFileAllows) {
  const std::string array = packed_zeros(3 * 8 * 1000);
  std::string file =
      "<VTKFile type=\"PolyData\" header_type=\"UInt64\" "
      "compressor=\"vtkZLibDataCompressor\"><PolyData>";
  for (int piece = 0; piece < 1000; ++piece)
    file +=
        "<Piece NumberOfPoints=\"1000\"><Points><DataArray Name=\"x\" type=\"Float64\" "
        "format=\"appended\" offset=\"0\"/></Points></Piece>";
  file += "</PolyData><AppendedData encoding=\"raw\">_" + array;

  EXPECT_THAT(message_of(file), HasSubstr("the array 'x' unpacks to more numbers"));
}

TEST(VtpReader, NeverCrashesOnACutOffOrDamagedFileInAnyEncoding) {
  for (const VtpStyle& style : all_styles()) {
    const std::string whole = VtpText(style).file({kPolygons, kStrip});
    for (std::size_t at = 0; at < whole.size(); ++at) {
      std::vector<std::string> texts = {whole.substr(0, at)};
      for (const char damage : {'\0', '9', '\xff', '<'}) {
        texts.push_back(whole);
        texts.back()[at] = damage;
      }
      for (const std::string& text : texts) {
        try {
          parsed(text);
        } catch (const MeshError&) {
        }
      }
    }
  }
}

}  // namespace
}  // namespace plekton::geometry::read_vtp_test
