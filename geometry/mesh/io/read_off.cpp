// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/io/readers.hpp"
#include "geometry/mesh/io/text_scanner.hpp"
#include "geometry/mesh/soup_builder.hpp"

#include <utility>
#include <vector>

namespace plekton::geometry {
namespace {

std::size_t count_of(TextScanner& text, const char* what) {
  const std::int64_t count = text.integer(what);
  if (count < 0) text.fail(what, std::to_string(count));
  return static_cast<std::size_t>(count);
}

void read_header(TextScanner& text) {
  constexpr const char* kExpected =
      "the word OFF (or COFF, NOFF, CNOFF, STOFF), ASCII, 3 dimensions";
  const std::string_view word = text.word(kExpected);
  const bool known = word.ends_with("OFF") &&
                     word.find_first_not_of("STCN") == word.size() - std::string_view("OFF").size();
  if (!known) text.fail(kExpected, kAnotherKind);
}

}  // namespace

PolygonSoup read_off(std::string_view bytes, const std::string& name) {
  TextScanner text(bytes, name, '#');
  read_header(text);
  const std::size_t point_count = count_of(text, "the number of points");
  const std::size_t polygon_count = count_of(text, "the number of facets");
  text.rest_of_line();  // The number of edges, which may be missing and is never needed.

  SoupBuilder soup(name, 0);
  soup.expect_points(point_count);
  for (std::size_t i = 0; i < point_count; ++i) {
    Vec3 point;
    for (double& coordinate : point)
      coordinate = text.number("a coordinate of point " + std::to_string(i));
    soup.add_point(point, text.line());
    text.rest_of_line();  // Colour, normal, texture.
  }

  std::vector<std::int64_t> corners;
  for (std::size_t i = 0; i < polygon_count; ++i) {
    const std::string facet = "facet " + std::to_string(i);
    const std::size_t corner_count = count_of(text, "the number of corners of facet");
    corners.clear();
    const std::size_t line = text.line();
    for (std::size_t k = 0; k < corner_count; ++k)
      corners.push_back(text.integer("a corner of " + facet));
    soup.add_polygon(corners, line);
    text.rest_of_line();  // Colour.
  }
  if (!text.at_end())
    text.fail("the end of the file after " + std::to_string(polygon_count) + " facets",
              quoted(text.word("")));
  return std::move(soup).finish();
}

}  // namespace plekton::geometry
