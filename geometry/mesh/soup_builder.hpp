// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace plekton::geometry {

/// Collects the points and polygons that a reader finds and checks every one, so that all bad ones
/// of a file are reported together. The number of points must be known before the first polygon is
/// added.
class SoupBuilder {
 public:
  /// @param name         What messages call the file.
  /// @param first_index  The number of the first point in the file's own counting, 0 or 1.
  SoupBuilder(std::string name, std::int64_t first_index);

  /// Points that the file holds; corners are checked against it.
  void expect_points(std::size_t count) { point_count_ = count; }
  /// @param line  Where it stands; 0 in a binary file.
  void add_point(const Vec3& point, std::size_t line);
  /// @param corners  Counted from 0. One out of range is noted as a problem.
  void add_polygon(std::span<const std::int64_t> corners, std::size_t line);

  /// Something else that is wrong with the file, reported with the rest.
  void add_problem(const std::string& problem, std::size_t line);
  /// Elements of the file that are no part of a surface.
  void skip_elements(std::size_t count) { soup_.skipped_elements += count; }

  std::size_t point_count() const noexcept { return soup_.points.size(); }
  std::size_t polygon_count() const noexcept { return soup_.polygons.size(); }

  /// @throws MeshError that lists the problems, the first ten in full.
  PolygonSoup finish() &&;

 private:
  void note_problem(std::string problem);

  std::string name_;
  std::int64_t first_index_;
  std::size_t point_count_ = 0;
  PolygonSoup soup_;
  std::vector<std::string> problems_;
  std::size_t problem_count_ = 0;
};

/// Checks a soup that did not come from a reader.
/// @throws MeshError as SoupBuilder::finish.
void check_soup(const PolygonSoup& soup, const std::string& name);

}  // namespace plekton::geometry
