// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/tracking/contact_record.hpp"
#include "dynamics/measures/bond_stress.hpp"
#include "dynamics/measures/facet_traction.hpp"
#include "dynamics/output/contact_fields.hpp"
#include "dynamics/output/vtk_writer.hpp"
#include "dynamics/structure/membrane_force.hpp"
#include "geometry/primitives/cylinder.hpp"
#include "geometry/primitives/facet.hpp"
#include "geometry/primitives/sphere.hpp"

#include <cstdint>
#include <span>

/// What a scene looks like at one moment (time in s), as data sets for ParaView: positions in
/// double, results in single precision. Results that are not one for each body, where that is said,
/// are refused with std::invalid_argument; ids of nodes are not checked.
namespace plekton::dynamics {

/// State of all nodes of a scene, indexed by NodeId; spans of the same length.
struct NodesView {
  std::span<const geometry::Vec3> position;          ///< m
  std::span<const geometry::Vec3> velocity;          ///< m/s
  std::span<const geometry::Vec3> angular_velocity;  ///< rad/s
  /// N, sum of loads, bonds and contacts; at a held node the reaction of its support is the
  /// opposite.
  std::span<const geometry::Vec3> force;
  /// Number of the grains or the membrane that a node is of; empty if nobody asks for it.
  std::span<const std::int32_t> group = {};
  std::span<const std::int32_t> material = {};  ///< its number, likewise
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
  std::span<const BondStress> stresses = {};              ///< one for each cylinder, or none
  std::span<const FacetTraction> tractions = {};          ///< one for each facet, or none
};

/// One point and vertex for each sphere, in their order, with those of the arrays
/// frame_fields::kOfGrains for which something is given.
PolyData grains_frame(const GrainsView& grains, double time);

/// Cylinders as lines and facets as triangles, over the nodes they share, in the order of the node
/// ids. Point arrays: frame_fields::kOfNodes; cell arrays: those of frame_fields::kOfCells for
/// which something is given; group and material of a cell are those of its first node. Time grows
/// with n log n for n cylinders.
PolyData surface_frame(const SurfaceView& surface, double time);

/// A line for each contact, from core point a to core point b; of no length where the cores touch.
/// Cell arrays: contact_fields().
/// @param labels  one for each contact, or none; then there are no arrays of them
PolyData contacts_frame(std::span<const contact::ContactRecord> contacts, double time,
                        std::span<const ContactLabels> labels = {});

}  // namespace plekton::dynamics
