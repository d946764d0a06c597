// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/io/byte_order.hpp"
#include "geometry/mesh/io/ply_header.hpp"
#include "geometry/mesh/io/readers.hpp"
#include "geometry/mesh/io/text_scanner.hpp"
#include "geometry/mesh/soup_builder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace plekton::geometry {
namespace {

/// The numbers behind the header, one after the other, in any encoding.
class PlyBody {
 public:
  PlyBody(std::string_view bytes, const PlyHeader& header, const std::string& name)
      : bytes_(bytes.substr(header.body)),
        text_(header.encoding == PlyEncoding::ascii ? bytes_ : std::string_view(), name, '\0',
              header.body_line),
        name_(name),
        encoding_(header.encoding) {}

  double number(PlyType type, const char* what) {
    if (encoding_ == PlyEncoding::ascii) return text_.number(what);
    const ByteOrder order =
        encoding_ == PlyEncoding::big_endian ? ByteOrder::big : ByteOrder::little;
    require_bytes(size_of(type), what);
    const std::size_t at = position_;
    position_ += size_of(type);
    switch (type) {
      case PlyType::int8:
        return load<std::int8_t>(bytes_, at, order);
      case PlyType::uint8:
        return load<std::uint8_t>(bytes_, at, order);
      case PlyType::int16:
        return load<std::int16_t>(bytes_, at, order);
      case PlyType::uint16:
        return load<std::uint16_t>(bytes_, at, order);
      case PlyType::int32:
        return load<std::int32_t>(bytes_, at, order);
      case PlyType::uint32:
        return load<std::uint32_t>(bytes_, at, order);
      case PlyType::float32:
        return static_cast<double>(load<float>(bytes_, at, order));
      case PlyType::float64:
        return load<double>(bytes_, at, order);
    }
    return 0.0;
  }

  /// An index or a length: 32 bits at most, so a double holds it exactly.
  std::int64_t integer(PlyType type, const char* what) {
    const double value = number(type, what);
    constexpr double kLargest = 4294967295.0;
    if (!(std::abs(value) <= kLargest) || value != std::floor(value))
      fail(what, "the number " + std::to_string(value));
    return static_cast<std::int64_t>(value);
  }

  std::size_t length(const PlyProperty& list) {
    const std::int64_t length = integer(list.length_type, "the length of a list");
    if (length < 0) fail("the length of a list", std::to_string(length));
    return static_cast<std::size_t>(length);
  }

  /// Reads a property that nobody asked for.
  void skip(const PlyProperty& property) {
    const std::size_t count = property.is_list ? length(property) : 1;
    for (std::size_t i = 0; i < count; ++i) number(property.type, property.name.c_str());
  }

  /// Line of the last number in the file; 0 in a binary file.
  std::size_t line() const { return encoding_ == PlyEncoding::ascii ? text_.line() : 0; }

 private:
  void require_bytes(std::size_t size, const char* what) const {
    if (bytes_.size() - position_ < size) fail(what, "the end of the file");
  }
  [[noreturn]] void fail(const std::string& expected, const std::string& got) const {
    const std::string place = line() == 0 ? "" : ": line " + std::to_string(line());
    throw MeshError(name_ + place + ": expected " + expected + ", got " + got +
                    "; the file is cut off or damaged; export it again");
  }

  std::string_view bytes_;
  TextScanner text_;
  std::string name_;
  PlyEncoding encoding_;
  std::size_t position_ = 0;
};

/// Position of a property in an element; the number of properties if it has none of that name.
std::size_t find(const PlyElement& element, std::string_view name) {
  const auto& list = element.properties;
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const PlyProperty& p) { return p.name == name; });
  return static_cast<std::size_t>(found - list.begin());
}

void read_points(PlyBody& body, const PlyElement& element, SoupBuilder& soup,
                 const std::string& name) {
  const std::array<std::size_t, 3> axes = {find(element, "x"), find(element, "y"),
                                           find(element, "z")};
  for (const std::size_t axis : axes)
    if (axis == element.properties.size() || element.properties[axis].is_list)
      throw MeshError(
          name + ": the vertices lack a property x, y or z; export the mesh again with positions");

  for (std::uint64_t i = 0; i < element.count; ++i) {
    Vec3 point = Vec3::Zero();
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const auto axis = std::find(axes.begin(), axes.end(), k);
      if (axis == axes.end())
        body.skip(element.properties[k]);
      else
        point[axis - axes.begin()] =
            body.number(element.properties[k].type, "a coordinate of a point");
    }
    soup.add_point(point, body.line());
  }
}

void read_faces(PlyBody& body, const PlyElement& element, SoupBuilder& soup,
                const std::string& name) {
  const std::size_t list = std::min(find(element, "vertex_indices"), find(element, "vertex_index"));
  if (list == element.properties.size() || !element.properties[list].is_list ||
      !is_integer(element.properties[list].type))
    throw MeshError(
        name +
        ": the faces lack an integer list vertex_indices; export the mesh again with facets");

  std::vector<std::int64_t> corners;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    corners.clear();
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (k != list) {
        body.skip(property);
        continue;
      }
      const std::size_t count = body.length(property);
      for (std::size_t c = 0; c < count; ++c)
        corners.push_back(body.integer(property.type, "a corner of a facet"));
    }
    soup.add_polygon(corners, body.line());
  }
}

void skip_element(PlyBody& body, const PlyElement& element) {
  if (element.properties.empty()) return;
  for (std::uint64_t i = 0; i < element.count; ++i)
    for (const PlyProperty& property : element.properties) body.skip(property);
}

}  // namespace

PolygonSoup read_ply(std::string_view bytes, const std::string& name) {
  const PlyHeader header = read_ply_header(bytes, name);
  PlyBody body(bytes, header, name);
  SoupBuilder soup(name, 0);
  for (const PlyElement& element : header.elements)
    if (element.name == "vertex") soup.expect_points(element.count);
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex")
      read_points(body, element, soup, name);
    else if (element.name == "face")
      read_faces(body, element, soup, name);
    else if (element.name == "tristrips")
      throw MeshError(
          name + ": the facets come in triangle strips; export the mesh again with single facets");
    else
      skip_element(body, element);
  }
  return std::move(soup).finish();
}

}  // namespace plekton::geometry
