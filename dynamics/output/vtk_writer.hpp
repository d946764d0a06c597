// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <variant>
#include <vector>

namespace plekton::dynamics {

/// Cells of one kind over shared points: cell i is the points connectivity[offsets[i - 1]] to
/// connectivity[offsets[i]], the last one excluded.
struct CellList {
  std::vector<std::int32_t> connectivity;
  std::vector<std::int32_t> offsets;

  std::size_t size() const noexcept { return offsets.size(); }
  void add(std::initializer_list<std::int32_t> cell);
};

/// Named values, `components` for each point or cell, one point or cell after the other. The
/// element type is that of the file: float halves the file and has 7 digits, enough for a result
/// that is looked at.
struct DataArray {
  std::string name;
  std::size_t components = 1;
  std::variant<std::vector<float>, std::vector<double>, std::vector<std::int32_t>,
               std::vector<std::int64_t>>
      values;
};

/// Points and cells with results, for one `.vtp` file. Values of a cell array: first of the
/// vertices, then of the lines, then of the polygons.
struct PolyData {
  double time = 0.0;                   ///< s
  std::vector<geometry::Vec3> points;  ///< m
  CellList vertices;
  CellList lines;
  CellList polygons;
  std::vector<DataArray> point_arrays;
  std::vector<DataArray> cell_arrays;

  std::size_t cell_count() const noexcept {
    return vertices.size() + lines.size() + polygons.size();
  }
};

/// Writes VTK's XML PolyData format: appended raw data in zlib blocks, positions as Float64.
/// Without points or cells it is a valid empty data set. The file appears complete or not at all.
/// @throws OutputError; std::invalid_argument naming an array of another length
/// Source: VTK File Formats, "XML File Formats" (docs.vtk.org).
void write_vtp(const std::filesystem::path& file, const PolyData& data);

/// Bytes of a file of write_vtp().
struct VtpSize {
  std::size_t packed = 0;    ///< what it has
  std::size_t unpacked = 0;  ///< what it would have if nothing in it could be packed, about
};
/// Packs the data to tell, and writes nothing.
VtpSize vtp_size(const PolyData& data);

}  // namespace plekton::dynamics
