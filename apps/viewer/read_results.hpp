// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace plekton::apps {

/// Named values of points or cells, `components` for each, one point or cell after the other.
struct ResultArray {
  std::string name;
  std::size_t components = 1;
  std::vector<double> values;
};

/// A data set of a frame as it was written (dynamics/output/vtk_writer.hpp).
struct Results {
  std::size_t points = 0;
  std::size_t lines = 0;
  std::size_t polygons = 0;
  std::vector<double> positions;  ///< m, three for each point
  std::vector<double> line_ends;  ///< points, two for each line
  std::vector<double> corners;    ///< points, three for each polygon
  std::vector<ResultArray> of_points;
  std::vector<ResultArray> of_cells;  ///< values of the lines, then of the polygons
};

/// @throws ViewError for a file that is missing, cut off, damaged or of another kind
Results read_results(const std::filesystem::path& file);

}  // namespace plekton::apps
