// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/io/readers.hpp"
#include "geometry/mesh/io/text_scanner.hpp"
#include "geometry/mesh/io/vtk_array.hpp"
#include "geometry/mesh/io/xml_elements.hpp"
#include "geometry/mesh/soup_builder.hpp"

#include <array>
#include <span>
#include <utility>
#include <vector>

namespace plekton::geometry {
namespace {

class VtpReader {
 public:
  VtpReader(std::string_view bytes, const std::string& name)
      : name_(name), elements_(read_xml(bytes, name, "VTKFile")), soup_(name, 0) {
    encoding_.file_size = bytes.size();
  }

  PolygonSoup read() && {
    if (elements_[0].attribute("type") != "PolyData")
      fail(
          0,
          "the data are of type " + quoted(elements_[0].attribute("type")) +
              "; expected PolyData; extract the surface (ParaView: Extract Surface) and save it as "
              ".vtp");
    read_encoding();
    std::vector<std::size_t> pieces;
    for (const std::size_t data : children_of(elements_, 0, "PolyData"))
      for (const std::size_t piece : children_of(elements_, data, "Piece")) pieces.push_back(piece);
    for (const std::size_t piece : pieces) read_points(piece);
    soup_.expect_points(soup_.point_count());
    first_point_ = 0;
    for (const std::size_t piece : pieces) read_cells(piece);
    return std::move(soup_).finish();
  }

 private:
  [[noreturn]] void fail(std::size_t element, const std::string& what) const {
    throw MeshError(name_ + ": line " + std::to_string(elements_[element].line) + ": " + what);
  }
  [[noreturn]] void damaged(std::size_t element, const std::string& what) const {
    fail(element, what + "; the file is damaged; save the mesh again");
  }

  void read_encoding() {
    const XmlElement& root = elements_[0];
    if (root.attribute("byte_order") == "BigEndian") encoding_.byte_order = ByteOrder::big;
    if (root.attribute("header_type") == "UInt64") encoding_.header_size = 8;
    encoding_.compressor = root.attribute("compressor");
    const XmlElement& last = elements_.back();
    if (last.name != "AppendedData") return;
    encoding_.appended_raw = last.attribute("encoding") == "raw";
    const std::size_t underscore = last.text.find('_');
    if (underscore != std::string_view::npos) encoding_.appended = last.text.substr(underscore + 1);
  }

  std::size_t count(std::size_t piece, std::string_view key) const {
    const std::string_view text = elements_[piece].attribute(key);
    const auto number = text.empty() ? 0 : parse_integer(text);
    if (!number || *number < 0)
      damaged(piece, std::string(key) + " is " + quoted(text) + "; expected a number from 0 on");
    return static_cast<std::size_t>(*number);
  }

  /// The array of a section of a piece.
  /// @param array  Its name; empty for the first one.
  std::size_t array_of(std::size_t piece, std::string_view section, std::string_view array) const {
    for (const std::size_t s : children_of(elements_, piece, section))
      for (const std::size_t a : children_of(elements_, s, "DataArray"))
        if (array.empty() || elements_[a].attribute("Name") == array) return a;
    damaged(piece,
            "the piece lacks the array " + std::string(array) + " of " + std::string(section));
  }

  void read_points(std::size_t piece) {
    const std::size_t points = count(piece, "NumberOfPoints");
    if (points == 0) return;
    const std::size_t array = array_of(piece, "Points", "");
    const auto x = vtk_numbers(elements_[array], encoding_, name_);
    encoding_.numbers_read += x.size();
    if (x.size() % 3 != 0 || x.size() / 3 != points)
      damaged(array, "expected 3 coordinates of " + std::to_string(points) + " points, got " +
                         std::to_string(x.size()) + " numbers");
    for (std::size_t i = 0; i < x.size(); i += 3)
      soup_.add_point(Vec3(x[i], x[i + 1], x[i + 2]), 0);
  }

  void read_cells(std::size_t piece) {
    soup_.skip_elements(count(piece, "NumberOfVerts"));
    soup_.skip_elements(count(piece, "NumberOfLines"));
    read_section(piece, "Polys", "NumberOfPolys",
                 [&](std::span<const std::int64_t> corners) { soup_.add_polygon(corners, 0); });
    read_section(piece, "Strips", "NumberOfStrips",
                 [&](std::span<const std::int64_t> corners) { add_strip(corners); });
    first_point_ += static_cast<std::int64_t>(count(piece, "NumberOfPoints"));
  }

  /// Every corner after the second makes a triangle with the two before it, every other time turned
  /// over, so that all face one side.
  void add_strip(std::span<const std::int64_t> corners) {
    for (std::size_t k = 2; k < corners.size(); ++k) {
      std::array<std::int64_t, 3> triangle = {corners[k - 2], corners[k - 1], corners[k]};
      if (k % 2 == 1) std::swap(triangle[0], triangle[1]);
      soup_.add_polygon(triangle, 0);
    }
  }

  std::vector<std::int64_t> integers(std::size_t array) {
    auto numbers = vtk_integers(elements_[array], encoding_, name_);
    encoding_.numbers_read += numbers.size();
    return numbers;
  }

  /// Cell i has the corners connectivity[offsets[i - 1]] to connectivity[offsets[i]].
  template <class AddCell>
  void read_section(std::size_t piece, std::string_view section, std::string_view key,
                    const AddCell& add_cell) {
    const std::size_t cells = count(piece, key);
    if (cells == 0) return;
    const std::size_t array = array_of(piece, section, "offsets");
    auto corners = integers(array_of(piece, section, "connectivity"));
    const auto offsets = integers(array);
    if (offsets.size() != cells)
      damaged(array, "expected " + std::to_string(cells) + " offsets of " + std::string(section) +
                         ", got " + std::to_string(offsets.size()));
    check_corners(piece, corners);
    std::size_t begin = 0;
    for (const std::int64_t offset : offsets) {
      const auto end = static_cast<std::size_t>(offset);
      if (offset < 0 || end < begin || end > corners.size())
        damaged(array, "the offset " + std::to_string(offset) + " after " + std::to_string(begin) +
                           "; expected offsets that do not fall and end at " +
                           std::to_string(corners.size()));
      add_cell(std::span(corners).subspan(begin, end - begin));
      begin = end;
    }
    if (begin != corners.size())
      damaged(array, "the last offset is " + std::to_string(begin) + "; expected " +
                         std::to_string(corners.size()) + ", the number of corners");
  }

  /// Corners count from the first point of their piece; from here on from that of the file.
  void check_corners(std::size_t piece, std::vector<std::int64_t>& corners) const {
    const auto points = static_cast<std::int64_t>(count(piece, "NumberOfPoints"));
    for (std::int64_t& corner : corners) {
      if (corner < 0 || corner >= points)
        damaged(piece, "a cell names point " + std::to_string(corner) + ", but the piece has " +
                           std::to_string(points) + " points, numbered from 0");
      corner += first_point_;
    }
  }

  std::string name_;
  std::vector<XmlElement> elements_;
  SoupBuilder soup_;
  VtkEncoding encoding_;
  std::int64_t first_point_ = 0;  ///< of the current piece
};

}  // namespace

PolygonSoup read_vtp(std::string_view bytes, const std::string& name) {
  return VtpReader(bytes, name).read();
}

}  // namespace plekton::geometry
