// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <span>

// Eigen's own vectors have an order of sums and fused operations of their own on each processor, in
// scalar products, products of matrices and of quaternions; without them it has one order. What is
// worth it goes side by side in packs (pack.hpp).
#if defined(EIGEN_VECTORIZE)
#error \
    "Plekton needs Eigen without vectorisation, for the same bits on every processor: compile with \
EIGEN_DONT_VECTORIZE and EIGEN_MAX_STATIC_ALIGN_BYTES=16, as plekton's CMake targets and pkg-config do."
#endif

/// Exact proximity between spheres, cylinders and thick facets: Minkowski sums of a point, a
/// segment or a triangle with a ball.
namespace plekton::geometry {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
/// A rotation, scalar part last in memory. Not over-aligned, so that it can live in any
/// std::vector.
using Quat = Eigen::Quaternion<double, Eigen::DontAlign>;

/// Index of a node: a point with position and rotation, shared by every element that names it.
enum class NodeId : std::int32_t {};
/// Index of an edge of a Surface: a side of a facet or a free cylinder.
enum class EdgeId : std::int32_t {};
/// Index of a facet.
enum class FaceId : std::int32_t {};
/// Index of a sphere.
enum class SphereId : std::int32_t {};
/// Index of a maximal cell of a Surface: its facets first, then its free cylinders.
enum class CellId : std::int32_t {};
/// Index of a connected structure of a Surface.
enum class StructureId : std::int32_t {};

/// Position of an id in an array.
template <class Id>
constexpr std::size_t index_of(Id id) noexcept {
  return static_cast<std::size_t>(id);
}

/// The id at a position in an array.
template <class Id>
constexpr Id id_at(std::size_t index) noexcept {
  return static_cast<Id>(index);
}

/// Node positions (m), indexed by NodeId.
using Positions = std::span<const Vec3>;

}  // namespace plekton::geometry
