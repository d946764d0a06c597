// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/output/vtk_writer.hpp"
#include "dynamics/structure/membrane_force.hpp"
#include "geometry/cylinder.hpp"
#include "geometry/facet.hpp"
#include "geometry/sphere.hpp"

#include <cstdint>
#include <span>

/// What a scene looks like at one moment, as data sets for ParaView: positions in double, results
/// in single precision.
namespace plekton::dynamics {

/// State of all nodes of a scene, indexed by NodeId; spans of the same length.
struct NodesView {
  std::span<const geometry::Vec3> position;          ///< m
  std::span<const geometry::Vec3> velocity;          ///< m/s
  std::span<const geometry::Vec3> angular_velocity;  ///< rad/s
  /// N, sum of loads, bonds and contacts; at a held node the reaction of its support is the
  /// opposite.
  std::span<const geometry::Vec3> force;
};

/// The free spheres.
struct GrainsView {
  NodesView nodes;
  std::span<const geometry::Sphere> spheres;
  std::span<const std::int64_t> id;  ///< persistent, one for each sphere
};

/// The deformable structures.
struct SurfaceView {
  NodesView nodes;
  std::span<const geometry::Cylinder> cylinders;  ///< also those along the sides of facets
  std::span<const double> tension;  ///< N, one for each cylinder, negative in compression
  std::span<const geometry::Facet> facets;
  std::span<const PrincipalForces> membrane_forces = {};  ///< one for each facet, or none at all
};

/// One contact.
struct ContactRow {
  geometry::Vec3 core_point_a;      ///< m
  geometry::Vec3 core_point_b;      ///< m
  geometry::Vec3 normal_force;      ///< N, on side b
  geometry::Vec3 tangential_force;  ///< N, on side b
  double gap;                       ///< m, negative when overlapping
};

/// One point and vertex for each sphere, in their order. Point arrays: radius (m), velocity (m/s),
/// angular_velocity (rad/s), force (N), id.
PolyData grains_frame(const GrainsView& grains, double time);

/// Cylinders as lines and facets as triangles, over the nodes they share, in the order of the node
/// ids. Point arrays: velocity (m/s), angular_velocity (rad/s), force (N), node. Cell arrays:
/// radius (m); tension (N), of a facet the mean over its sides that are cylinders, 0 if none is;
/// if membrane forces are given, membrane_force_largest and membrane_force_smallest (N/m), 0 of
/// cylinders.
/// Time grows with n log n for n cylinders.
PolyData surface_frame(const SurfaceView& surface, double time);

/// A line for each contact, from core point a to core point b; of no length where the cores touch.
/// Cell arrays: normal_force and tangential_force (N, vectors on side b), their magnitudes, gap
/// (m).
PolyData contacts_frame(std::span<const ContactRow> contacts, double time);

}  // namespace plekton::dynamics
