// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/model/scene_hash.hpp"

#include "geometry/base/bit_hash.hpp"

#include <vector>

namespace plekton::dynamics {
namespace {

using geometry::BitHash;

/// Of an id or a flag.
template <class Number>
void add_number(Number number, BitHash& hash) {
  hash.add(static_cast<std::uint64_t>(static_cast<std::int64_t>(number)));
}

void add_properties(const NodeProperties& properties, BitHash& hash) {
  add_number(properties.size(), hash);
  for (std::size_t i = 0; i < properties.size(); ++i) {
    hash.add(properties.mass[i]);
    hash.add(properties.inertia[i]);
    add_number(properties.held[i], hash);
  }
}

template <class Element>
void add_elements(const std::vector<Element>& elements,
                  const std::vector<contact::MaterialId>& materials, BitHash& hash) {
  add_number(elements.size(), hash);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    for (const NodeId node : elements[i].nodes) add_number(node, hash);
    hash.add(elements[i].radius);
    add_number(materials[i], hash);
  }
}

void add_bonds(const std::vector<BeamBond>& bonds, BitHash& hash) {
  add_number(bonds.size(), hash);
  for (const BeamBond& bond : bonds) {
    for (const NodeId node : bond.nodes) add_number(node, hash);
    hash.add(bond.length);
    const BeamSection& section = bond.section;
    for (const double number : {section.young_modulus, section.shear_modulus, section.area,
                                section.second_moment, section.torsion_constant})
      hash.add(number);
  }
}

void add_sheets(const std::vector<SheetFacet>& facets, BitHash& hash) {
  add_number(facets.size(), hash);
  for (const SheetFacet& facet : facets) {
    for (const NodeId node : facet.nodes) add_number(node, hash);
    const SheetSection& section = facet.section;
    for (const double number : {section.tensile_stiffness, section.poisson_ratio,
                                section.bending_stiffness, section.thickness, section.strength})
      hash.add(number);
    for (const Vec2& corner : facet.corners) {
      for (const double number : {corner.x(), corner.y()}) hash.add(number);
    }
  }
}

/// Scenes without any have the hash they had before there were rigid bodies.
void add_rigid_bodies(const std::vector<RigidBody>& bodies, BitHash& hash) {
  for (const RigidBody& body : bodies) {
    add_number(body.node, hash);
    add_number(body.nodes.size(), hash);
    for (const NodeId node : body.nodes) add_number(node, hash);
    hash.add(body.moments);
  }
}

/// Scenes without any have the hash they had before there were ties.
void add_ties(const Scene& scene, BitHash& hash) {
  for (const Cable& cable : scene.cables) {
    add_number(cable.is_closed, hash);
    add_number(cable.nodes.size(), hash);
    for (const NodeId node : cable.nodes) add_number(node, hash);
  }
  for (const Tie& tie : scene.ties) {
    add_number(tie.node, hash);
    add_number(tie.to.index(), hash);
    if (const auto* const point = std::get_if<MaterialPoint>(&tie.to))
      for (const NodeId node : point->nodes) add_number(node, hash);
    hash.add(tie.stiffness);
  }
}

}  // namespace

std::uint64_t scene_hash(const Scene& scene) {
  BitHash hash;
  add_properties(scene.properties, hash);
  add_elements(scene.elements.spheres, scene.sphere_materials, hash);
  add_elements(scene.elements.cylinders, scene.cylinder_materials, hash);
  add_elements(scene.elements.facets, scene.facet_materials, hash);
  add_bonds(scene.bonds, hash);
  add_sheets(scene.sheet_facets, hash);
  add_rigid_bodies(scene.rigid_bodies, hash);
  add_ties(scene, hash);
  add_number(scene.planes.size(), hash);
  for (const contact::Plane& plane : scene.planes) {
    hash.add(plane.normal);
    add_number(plane.material, hash);
    if (plane.turns()) hash.add(plane.turning());
    if (plane.form == contact::Plane::Form::flat) continue;
    add_number(plane.form, hash);
    hash.add(plane.axis);
  }
  return hash.value();
}

}  // namespace plekton::dynamics
