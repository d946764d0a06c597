// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/bodies.hpp"
#include "dynamics/model/loads.hpp"
#include "dynamics/model/ties.hpp"
#include "dynamics/rigid/mass_properties.hpp"
#include "dynamics/state/node_state.hpp"
#include "dynamics/state/rigid_body.hpp"
#include "dynamics/structure/beam_bond.hpp"
#include "dynamics/structure/bond_law.hpp"
#include "dynamics/structure/lumped_mass.hpp"
#include "dynamics/structure/sheet_facet.hpp"
#include "geometry/primitives/elements.hpp"

#include <span>
#include <vector>

namespace plekton::dynamics {

/// Everything a simulation starts from: plain data that can be built by hand, by a reader or by a
/// generator. dynamics/scene_check.hpp says what is wrong with one.
struct Scene {
  NodeState state = {};
  NodeProperties properties = {};
  geometry::Elements elements = {};
  std::vector<BeamBond> bonds = {};
  std::vector<BondLaw> bond_laws = {};  ///< of the bonds that yield or break
  std::vector<SheetFacet> sheet_facets = {};
  std::vector<contact::Plane> planes = {};
  std::vector<contact::Material> materials = {};           ///< by MaterialId
  std::vector<contact::MaterialId> sphere_materials = {};  ///< by SphereId
  /// One for each cylinder; one material for a connected structure.
  std::vector<contact::MaterialId> cylinder_materials = {};
  std::vector<contact::MaterialId> facet_materials = {};  ///< one for each facet
  std::vector<RigidBody> rigid_bodies = {};
  std::vector<Cable> cables = {};
  std::vector<Tie> ties = {};
  Loads loads = {};
  /// By node: the facets and cylinders on it are not there, not yet or not any more; all nodes of a
  /// structure alike, and held. What its bonds and sheets are goes on. Empty: all are there.
  std::vector<bool> is_absent = {};

  bool is_there(NodeId node) const noexcept {
    return is_absent.empty() || !is_absent[static_cast<std::size_t>(node)];
  }

  /// Adds a node at rest. Mass and inertia are filled in by what is attached to it.
  NodeId add_node(const Vec3& position, Held held = Held::nothing);

  // What is added is looked at by check() (scene_check.hpp), but where exceptions are named.

  /// Adds a sphere with its node: mass 4/3 pi r³ density, inertia 2/5 m r².
  /// @param radius, density  m, kg/m³
  geometry::SphereId add_sphere(const Vec3& centre, double radius, double density,
                                contact::MaterialId material);

  /// Adds a cylinder between nodes: its geometry only. @param radius  m
  void add_cylinder(NodeId a, NodeId b, double radius, contact::MaterialId material);

  /// Adds a thick facet between nodes: its geometry only. @param radius  m, half its thickness
  void add_facet(NodeId a, NodeId b, NodeId c, double radius, contact::MaterialId material);

  /// Adds a beam between nodes, at rest as they are now, with half of its mass to either: m += 1/2
  /// rho A L, and inertia += 2/5 of that times r² (edge mode, as in Effeindzourou et al. 2016), or
  /// as the last argument says.
  /// @param density  kg/m³, >= 0
  /// @returns  its place in bonds
  /// @throws std::invalid_argument for what make_beam() refuses; nothing is added then
  std::size_t add_beam(NodeId a, NodeId b, const BeamSection& section, double density,
                       NodalInertia inertia = NodalInertia::ball);

  /// Adds a facet of a thin sheet between nodes, at rest as they are now, with a third of its mass
  /// to each: m += 1/3 rho t A, and inertia += 2/5 of that times (t / 2)² (area mode). It only
  /// resists: what touches it needs a facet of geometry on the same nodes.
  /// @param density  kg/m³, >= 0; 0 where the mass is given in another way, as by add_edge_mass
  /// @returns  its place in sheet_facets
  /// @throws std::invalid_argument for what make_sheet_facet() refuses; nothing is added then
  std::size_t add_sheet_facet(const std::array<NodeId, 3>& nodes, const SheetSection& section,
                              double density, NodalInertia inertia = NodalInertia::ball);

  /// Makes a rigid body of nodes with all that is attached to them: adds its reference node, at the
  /// centre of mass, at rest, and takes the masses of the nodes away. Its elements do not touch each
  /// other; their contacts with others have its mass. Its place and motion, what is held of it, and
  /// loads on it are those of the reference node.
  /// @param nodes  at least one, none of which follows another body
  /// @param mass   whatever the nodes had; may be zero where all is held
  /// @param held   along and about the axes of the world
  /// @returns  its place in rigid_bodies
  /// @throws std::out_of_range for a node that does not exist; nothing is added then
  std::size_t add_rigid_body(std::span<const NodeId> nodes, const MassProperties& mass,
                             Held held = Held::nothing);
};

}  // namespace plekton::dynamics
