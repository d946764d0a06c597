// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/io/byte_order.hpp"
#include "geometry/mesh/io/readers.hpp"
#include "geometry/mesh/io/text_scanner.hpp"
#include "geometry/mesh/soup_builder.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace plekton::geometry {
namespace {

constexpr std::size_t kHeaderSize = 84;  // 80 bytes of anything, then the number of facets in 4
constexpr std::size_t kFacetSize =
    50;  // normal and three corners in 12 floats, then two unused bytes

bool is_text(std::string_view bytes) {
  return std::none_of(bytes.begin(), bytes.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r' && byte != '\f' &&
           byte != '\v';
  });
}

std::size_t claimed_size(std::string_view bytes) {
  return kHeaderSize + kFacetSize * std::size_t{load<std::uint32_t>(bytes, 80, ByteOrder::little)};
}

PolygonSoup read_binary(std::string_view bytes, const std::string& name) {
  if (bytes.size() < kHeaderSize)
    throw MeshError(name + ": a binary STL of " + std::to_string(bytes.size()) +
                    " bytes, but its header alone has 84; the file is cut off or of another kind; "
                    "export it again");
  if (bytes.size() != claimed_size(bytes))
    throw MeshError(name + ": a binary STL whose header claims " +
                    std::to_string((claimed_size(bytes) - kHeaderSize) / kFacetSize) +
                    " facets, that is " + std::to_string(claimed_size(bytes)) +
                    " bytes, but the file has " + std::to_string(bytes.size()) +
                    "; it is cut off or damaged; export it again");

  const std::size_t count = (bytes.size() - kHeaderSize) / kFacetSize;
  SoupBuilder soup(name, 0);
  soup.expect_points(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    std::array<std::int64_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t at = kHeaderSize + kFacetSize * i + 12 * (k + 1);
      const auto coordinate = [&](std::size_t axis) {
        return static_cast<double>(load<float>(bytes, at + 4 * axis, ByteOrder::little));
      };
      corners[k] = static_cast<std::int64_t>(soup.point_count());
      soup.add_point(Vec3(coordinate(0), coordinate(1), coordinate(2)), 0);
    }
    soup.add_polygon(corners, 0);
  }
  return std::move(soup).finish();
}

/// True if a word is the keyword, in upper or lower case.
bool is_keyword(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(), [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
  });
}

void expect_keyword(TextScanner& text, std::string_view keyword) {
  const std::string_view word = text.word(keyword);
  if (!is_keyword(word, keyword)) text.fail(keyword, quoted(word));
}

/// A facet behind its first word: normal, loop of corners, closing words.
void read_facet(TextScanner& text, SoupBuilder& soup, std::vector<std::int64_t>& corners) {
  const std::size_t line = text.line();
  expect_keyword(text, "normal");
  // The normal follows from the corners; exporters write nan for facets without area.
  for (int axis = 0; axis < 3; ++axis) text.word("a component of the normal");
  expect_keyword(text, "outer");
  expect_keyword(text, "loop");
  corners.clear();
  for (auto word = text.word("vertex or endloop"); !is_keyword(word, "endloop");
       word = text.word("vertex or endloop")) {
    if (!is_keyword(word, "vertex")) text.fail("vertex or endloop", quoted(word));
    Vec3 point;
    for (double& coordinate : point) coordinate = text.number("a coordinate of a corner");
    corners.push_back(static_cast<std::int64_t>(soup.point_count()));
    soup.add_point(point, text.line());
  }
  expect_keyword(text, "endfacet");
  soup.expect_points(soup.point_count());
  soup.add_polygon(corners, line);
}

PolygonSoup read_ascii(std::string_view bytes, const std::string& name) {
  constexpr const char* kInSolid = "facet or endsolid";
  TextScanner text(bytes, name);
  SoupBuilder soup(name, 0);
  std::vector<std::int64_t> corners;
  if (!is_keyword(text.word("solid"), "solid")) text.fail("solid", kAnotherKind);
  while (true) {
    text.rest_of_line();  // The name, in any words.
    for (auto word = text.word(kInSolid); !is_keyword(word, "endsolid");
         word = text.word(kInSolid)) {
      if (!is_keyword(word, "facet")) text.fail(kInSolid, quoted(word));
      read_facet(text, soup, corners);
    }
    text.rest_of_line();
    if (text.at_end()) return std::move(soup).finish();
    expect_keyword(text, "solid");
  }
}

}  // namespace

bool is_binary_stl(std::string_view bytes) noexcept {
  return bytes.size() >= kHeaderSize && bytes.size() == claimed_size(bytes);
}

PolygonSoup read_stl(std::string_view bytes, const std::string& name) {
  return is_binary_stl(bytes) || !is_text(bytes) ? read_binary(bytes, name)
                                                 : read_ascii(bytes, name);
}

}  // namespace plekton::geometry
