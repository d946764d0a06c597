// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/viewer/read_results.hpp"

#include "apps/viewer/view_error.hpp"
#include "geometry/base/regular_file.hpp"
#include "geometry/mesh/io/vtk_array.hpp"
#include "geometry/mesh/io/xml_elements.hpp"
#include "geometry/mesh/mesh.hpp"

#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <string_view>

namespace plekton::apps {
namespace {

using geometry::XmlElement;

class ResultsReader {
 public:
  ResultsReader(std::string_view bytes, const std::string& name)
      : name_(name), elements_(geometry::read_xml(bytes, name, "VTKFile")) {
    // Results of what is at rest are zeros, which pack far better than the meshes that the reader
    // of arrays expects; no block unpacks to more than zlib can make of it in any case.
    constexpr std::size_t kZerosPerMesh = 64;
    encoding_.file_size = kZerosPerMesh * bytes.size();
    if (!bytes.substr(0, bytes.find_last_not_of(" \t\r\n") + 1).ends_with("</VTKFile>")) foreign();
    encoding_.header_size = elements_[0].attribute("header_type") == "UInt64" ? 8 : 4;
    encoding_.compressor = elements_[0].attribute("compressor");
    const XmlElement& last = elements_.back();
    if (last.name != "AppendedData" || last.attribute("encoding") != "raw") foreign();
    const std::size_t underscore = last.text.find('_');
    if (underscore == std::string_view::npos) foreign();
    encoding_.appended_raw = true;
    encoding_.appended = last.text.substr(underscore + 1);
  }

  Results read() {
    const auto data = geometry::children_of(elements_, 0, "PolyData");
    const auto pieces = data.size() == 1 ? geometry::children_of(elements_, data[0], "Piece")
                                         : std::vector<std::size_t>{};
    if (pieces.size() != 1) foreign();
    piece_ = pieces[0];
    Results results;
    results.points = count("NumberOfPoints");
    results.lines = count("NumberOfLines");
    results.polygons = count("NumberOfPolys");
    const std::size_t cells = count("NumberOfVerts") + results.lines + results.polygons;
    results.positions = only("Points", "Points", 3 * results.points);
    results.line_ends = points_of("Lines", 2 * results.lines, results.points);
    results.corners = points_of("Polys", 3 * results.polygons, results.points);
    results.of_points = all("PointData", results.points);
    results.of_cells = all("CellData", cells);
    return results;
  }

 private:
  [[noreturn]] void foreign() const {
    throw ViewError(name_ +
                    ": is no frame of plekton, or only a part of one; repeat the run, or name the "
                    "folder of another");
  }

  std::size_t count(std::string_view key) const {
    const std::string_view text = elements_[piece_].attribute(key);
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (text.empty() || error != std::errc() || end != text.data() + text.size() ||
        number > std::numeric_limits<std::int32_t>::max())
      foreign();
    return number;
  }

  std::vector<double> numbers(std::size_t array, std::size_t expected) const {
    auto values = geometry::vtk_numbers(elements_[array], encoding_, name_);
    if (values.size() != expected) foreign();
    return values;
  }

  std::vector<double> only(std::string_view section, std::string_view array,
                           std::size_t expected) const {
    for (const std::size_t s : geometry::children_of(elements_, piece_, section))
      for (const std::size_t a : geometry::children_of(elements_, s, "DataArray"))
        if (elements_[a].attribute("Name") == array) return numbers(a, expected);
    foreign();
  }

  std::vector<double> points_of(std::string_view section, std::size_t expected,
                                std::size_t points) const {
    auto values = only(section, "connectivity", expected);
    for (const double point : values)
      if (!(point >= 0.0 && point < static_cast<double>(points))) foreign();
    return values;
  }

  std::vector<ResultArray> all(std::string_view section, std::size_t tuples) const {
    std::vector<ResultArray> arrays;
    for (const std::size_t s : geometry::children_of(elements_, piece_, section)) {
      for (const std::size_t a : geometry::children_of(elements_, s, "DataArray")) {
        const bool is_vector = elements_[a].attribute("NumberOfComponents") == "3";
        ResultArray array{std::string(elements_[a].attribute("Name")), is_vector ? 3U : 1U, {}};
        array.values = numbers(a, array.components * tuples);
        arrays.push_back(std::move(array));
      }
    }
    return arrays;
  }

  std::string name_;
  std::vector<XmlElement> elements_;
  geometry::VtkEncoding encoding_;
  std::size_t piece_ = 0;
};

}  // namespace

Results read_results(const std::filesystem::path& file) {
  try {
    const std::string bytes = geometry::read_regular_file(file, "a frame (.vtp)");
    return ResultsReader(bytes, file.string()).read();
  } catch (const geometry::UnreadableFile& error) {
    throw ViewError(error.what());
  } catch (const geometry::MeshError&) {
    throw ViewError(file.string() +
                    ": is no frame of plekton, or only a part of one; repeat the run, or name the "
                    "folder of another");
  }
}

}  // namespace plekton::apps
