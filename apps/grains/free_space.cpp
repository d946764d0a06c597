// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/grains/free_space.hpp"

#include <algorithm>
#include <cmath>

namespace plekton::apps {
namespace {

constexpr double kMostFreeCells = 1 << 22;  // about 100 MB; larger cells only cost time

double distance_to_segment(const Vec3& point, const Vec3& x0, const Vec3& x1) noexcept {
  const Vec3 along = x1 - x0;
  const double length_squared = along.squaredNorm();
  if (length_squared == 0.0) return (point - x0).norm();
  const double t = std::clamp(along.dot(point - x0) / length_squared, 0.0, 1.0);
  return (point - x0 - t * along).norm();
}

}  // namespace

double distance_to_triangle(const Vec3& point, const std::array<Vec3, 3>& triangle) noexcept {
  const auto& [x0, x1, x2] = triangle;
  const double to_sides =
      std::min({distance_to_segment(point, x0, x1), distance_to_segment(point, x1, x2),
                distance_to_segment(point, x2, x0)});
  const Vec3 normal = (x1 - x0).cross(x2 - x0);
  const double norm = normal.norm();
  if (norm == 0.0) return to_sides;
  // The foot of the perpendicular lies inside if the point is on the inner side of all three sides.
  const auto inside = [&](const Vec3& a, const Vec3& b) {
    return normal.dot((b - a).cross(point - a)) >= 0.0;
  };
  if (!inside(x0, x1) || !inside(x1, x2) || !inside(x2, x0)) return to_sides;
  return std::min(to_sides, std::abs(normal.dot(point - x0)) / norm);
}

FreeSpace::FreeSpace(const Box& box, double largest, std::span<const contact::Plane> planes)
    : box_(box), largest_(largest), planes_(planes) {
  const Vec3 size = box.upper - box.lower;
  // Cells of the diameter of the largest ball, but not more of them than fit into memory.
  // A flat or thin box has one cell across, so the side is found by trying.
  double side = 2.0 * largest;
  const auto counts = [&] { return Vec3((size / side).array().floor().max(1.0)); };
  while (counts().prod() > kMostFreeCells) side *= 2.0;
  for (int axis = 0; axis < 3; ++axis) {
    cell_counts_[static_cast<std::size_t>(axis)] = static_cast<std::size_t>(counts()[axis]);
    cell_size_[axis] = size[axis] / counts()[axis];
  }
  cells_.resize(static_cast<std::size_t>(counts().prod()));
}

std::array<std::size_t, 3> FreeSpace::cell_of(const Vec3& point) const {
  std::array<std::size_t, 3> cell{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    const double position = std::floor((point[i] - box_.lower[i]) / cell_size_[i]);
    cell[axis] = static_cast<std::size_t>(
        std::clamp(position, 0.0, static_cast<double>(cell_counts_[axis] - 1)));
  }
  return cell;
}

std::size_t FreeSpace::index_of_cell(const std::array<std::size_t, 3>& cell) const {
  return (cell[2] * cell_counts_[1] + cell[1]) * cell_counts_[0] + cell[0];
}

void FreeSpace::add(const Obstacle& obstacle) {
  const Box reach = geometry::bounding_box(obstacle.core, obstacle.radius + largest_);
  if ((reach.lower.array() > box_.upper.array()).any() ||
      (reach.upper.array() < box_.lower.array()).any())
    return;
  const auto number = static_cast<std::uint32_t>(obstacles_.size());
  obstacles_.push_back(obstacle);
  const auto first = cell_of(reach.lower);
  const auto last = cell_of(reach.upper);
  for (std::size_t k = first[2]; k <= last[2]; ++k) {
    for (std::size_t j = first[1]; j <= last[1]; ++j) {
      for (std::size_t i = first[0]; i <= last[0]; ++i)
        cells_[index_of_cell({i, j, k})].push_back(number);
    }
  }
}

bool FreeSpace::has_room(const Vec3& centre, double radius) const {
  for (int axis = 0; axis < 3; ++axis) {
    const double size = (1.0 - kRounding) * radius;
    if (centre[axis] - size < box_.lower[axis] || centre[axis] + size > box_.upper[axis])
      return false;
  }
  for (const contact::Plane& plane : planes_) {
    if (plane.height(centre) < radius) return false;
  }
  for (const std::uint32_t number : cells_[index_of_cell(cell_of(centre))]) {
    const Obstacle& obstacle = obstacles_[number];
    if (distance_to_triangle(centre, obstacle.core) < radius + obstacle.radius) return false;
  }
  return true;
}

}  // namespace plekton::apps
