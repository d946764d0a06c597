// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/io/readers.hpp"
#include "geometry/mesh/io/text_scanner.hpp"
#include "geometry/mesh/soup_builder.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace plekton::geometry {
namespace {

/// Logical lines of an OBJ file: comments cut off, lines that end in a backslash joined with the
/// next one.
class ObjLines {
 public:
  ObjLines(std::string_view text, const std::string& name) : scanner_(text, name) {}

  /// The next line with content; its text is valid until the next call.
  bool next() {
    joined_.clear();
    while (!scanner_.at_end()) {
      std::string_view part = scanner_.rest_of_line();
      line_ = scanner_.line();
      const std::size_t comment = part.find('#');
      if (comment != std::string_view::npos) part = part.substr(0, comment);
      const std::size_t last = part.find_last_not_of(" \t\v\f");
      part = part.substr(0, last == std::string_view::npos ? 0 : last + 1);
      if (part.ends_with('\\')) {
        joined_.append(part.substr(0, part.size() - 1)) += ' ';
        continue;
      }
      joined_ += part;
      if (joined_.find_first_not_of(" \t\v\f") != std::string::npos) return true;
      joined_.clear();
    }
    return joined_.find_first_not_of(" \t\v\f") != std::string::npos;
  }

  /// The next word of the line; empty at its end.
  std::string_view next_word(std::size_t& position) const {
    constexpr const char* kBlanks = " \t\v\f";
    const std::size_t begin =
        std::min(joined_.find_first_not_of(kBlanks, position), joined_.size());
    position = std::min(joined_.find_first_of(kBlanks, begin), joined_.size());
    return std::string_view(joined_).substr(begin, position - begin);
  }

  /// Line number of the end of the logical line.
  std::size_t line() const noexcept { return line_; }
  /// @param is_obj  Whether the file has shown that it is one.
  [[noreturn]] void fail(std::string_view expected, std::string_view got, bool is_obj) const {
    scanner_.fail(expected, got.empty() ? "the end of the line" : quoted(got, is_obj));
  }

 private:
  TextScanner scanner_;
  std::string joined_;
  std::size_t line_ = 1;
};

std::size_t count_points(std::string_view text, const std::string& name) {
  std::size_t count = 0;
  for (ObjLines lines(text, name); lines.next();) {
    std::size_t position = 0;
    if (lines.next_word(position) == "v") ++count;
  }
  return count;
}

/// @param points_so_far  Points read before; any of them shows that the file is one of OBJ.
Vec3 point_of(const ObjLines& lines, std::size_t position, std::size_t points_so_far) {
  Vec3 point;
  for (double& coordinate : point) {
    const std::string_view word = lines.next_word(position);
    const auto value = parse_number(word);
    if (!value) lines.fail("three coordinates of a point", word, points_so_far > 0);
    coordinate = *value;
  }
  return point;
}

/// Corners counted from 0. A negative one counts back from the last point read so far.
void read_corners(const ObjLines& lines, std::size_t position, std::size_t points_so_far,
                  std::vector<std::int64_t>& corners) {
  corners.clear();
  for (auto word = lines.next_word(position); !word.empty(); word = lines.next_word(position)) {
    const auto number = parse_integer(word.substr(0, word.find('/')));
    if (!number)
      lines.fail("corners of a facet (point, point/texture or point/texture/normal)", word,
                 points_so_far > 0);
    corners.push_back(*number < 0 ? static_cast<std::int64_t>(points_so_far) + *number
                                  : *number - 1);
  }
}

}  // namespace

PolygonSoup read_obj(std::string_view text, const std::string& name) {
  SoupBuilder soup(name, 1);
  // A facet may name points that only follow, so the points are counted first.
  soup.expect_points(count_points(text, name));
  std::vector<std::int64_t> corners;
  for (ObjLines lines(text, name); lines.next();) {
    std::size_t position = 0;
    const std::string_view keyword = lines.next_word(position);
    if (keyword == "v") {
      soup.add_point(point_of(lines, position, soup.point_count()), lines.line());
    } else if (keyword == "f" || keyword == "fo") {
      read_corners(lines, position, soup.point_count(), corners);
      soup.add_polygon(corners, lines.line());
    }
  }
  return std::move(soup).finish();
}

}  // namespace plekton::geometry
