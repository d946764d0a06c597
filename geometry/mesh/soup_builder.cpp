// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/soup_builder.hpp"

#include <cmath>
#include <sstream>
#include <utility>

namespace plekton::geometry {
namespace {

constexpr std::size_t kListedProblems = 10;

std::string place(std::size_t line) {
  return line == 0 ? std::string() : "line " + std::to_string(line) + ": ";
}

bool is_usable(const Vec3& p) {
  // Also false for nan, which compares false with everything.
  return std::abs(p[0]) < kLargestCoordinate && std::abs(p[1]) < kLargestCoordinate &&
         std::abs(p[2]) < kLargestCoordinate;
}

}  // namespace

SoupBuilder::SoupBuilder(std::string name, std::int64_t first_index)
    : name_(std::move(name)), first_index_(first_index) {}

void SoupBuilder::note_problem(std::string problem) {
  ++problem_count_;
  if (problems_.size() < kListedProblems) problems_.push_back(std::move(problem));
}

void SoupBuilder::add_problem(const std::string& problem, std::size_t line) {
  note_problem(place(line) + problem);
}

void SoupBuilder::add_point(const Vec3& point, std::size_t line) {
  if (!is_usable(point)) {
    std::ostringstream text;
    text << place(line) << "point " << static_cast<std::int64_t>(soup_.points.size()) + first_index_
         << " is at (" << point[0] << ", " << point[1] << ", " << point[2]
         << "), but every coordinate must be a finite number below 1e75 in size";
    note_problem(text.str());
  }
  soup_.points.push_back(point);
}

void SoupBuilder::add_polygon(std::span<const std::int64_t> corners, std::size_t line) {
  auto& polygon = soup_.polygons.emplace_back();
  polygon.reserve(corners.size());
  for (const std::int64_t corner : corners) {
    if (corner >= 0 && static_cast<std::uint64_t>(corner) < point_count_) {
      polygon.push_back(static_cast<std::size_t>(corner));
      continue;
    }
    std::ostringstream text;
    text << place(line) << "facet " << static_cast<std::int64_t>(polygon_count()) - 1 + first_index_
         << " names point " << corner + first_index_ << ", but the file has " << point_count_
         << " points";
    if (point_count_ > 0)
      text << ", numbered " << first_index_ << " to "
           << static_cast<std::int64_t>(point_count_) - 1 + first_index_;
    note_problem(text.str());
  }
}

PolygonSoup SoupBuilder::finish() && {
  if (problem_count_ == 0) return std::move(soup_);
  constexpr const char* kAdvice = "; correct the file or export the mesh again";
  if (problem_count_ == 1) throw MeshError(name_ + ": " + problems_.front() + kAdvice);

  std::string message = name_ + ": " + std::to_string(problem_count_) + " problems";
  for (const std::string& problem : problems_) message += "\n  " + problem;
  if (problem_count_ > problems_.size())
    message += "\n  and " + std::to_string(problem_count_ - problems_.size()) + " more";
  throw MeshError(message + kAdvice);
}

void check_soup(const PolygonSoup& soup, const std::string& name) {
  SoupBuilder builder(name, 0);
  builder.expect_points(soup.points.size());
  for (const Vec3& point : soup.points) builder.add_point(point, 0);
  std::vector<std::int64_t> corners;
  for (const auto& polygon : soup.polygons) {
    // A position above the largest int64 becomes negative, so it is refused as well.
    corners.assign(polygon.begin(), polygon.end());
    builder.add_polygon(corners, 0);
  }
  std::move(builder).finish();
}

}  // namespace plekton::geometry
