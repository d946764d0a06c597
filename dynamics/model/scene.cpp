// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/model/scene.hpp"

#include "dynamics/model/require_index.hpp"

namespace plekton::dynamics {

NodeId Scene::add_node(const Vec3& position, Held held) {
  const auto node = geometry::id_at<NodeId>(state.size());
  state.position.push_back(position);
  state.velocity.push_back(Vec3::Zero());
  state.angular_velocity.push_back(Vec3::Zero());
  state.orientation.push_back(Quat::Identity());
  properties.mass.push_back(0.0);
  properties.inertia.push_back(0.0);
  properties.held.push_back(held);
  return node;
}

geometry::SphereId Scene::add_sphere(const Vec3& centre, double radius, double density,
                                     contact::MaterialId material) {
  const geometry::Sphere sphere{{add_node(centre)}, radius};
  const double mass = density * geometry::volume(sphere);
  properties.mass.back() = mass;
  properties.inertia.back() = 0.4 * mass * radius * radius;
  elements.spheres.push_back(sphere);
  sphere_materials.push_back(material);
  return geometry::id_at<geometry::SphereId>(elements.spheres.size() - 1);
}

void Scene::add_cylinder(NodeId a, NodeId b, double radius, contact::MaterialId material) {
  elements.cylinders.push_back({{a, b}, radius});
  cylinder_materials.push_back(material);
}

void Scene::add_facet(NodeId a, NodeId b, NodeId c, double radius, contact::MaterialId material) {
  elements.facets.push_back({{a, b, c}, radius});
  facet_materials.push_back(material);
}

std::size_t Scene::add_beam(NodeId a, NodeId b, const BeamSection& section, double density,
                            NodalInertia inertia) {
  bonds.push_back(make_beam(a, b, state, section));
  add_beam_mass(properties, bonds.back(), density, inertia);
  return bonds.size() - 1;
}

std::size_t Scene::add_sheet_facet(const std::array<NodeId, 3>& nodes, const SheetSection& section,
                                   double density, NodalInertia inertia) {
  sheet_facets.push_back(make_sheet_facet(nodes, state, section));
  add_facet_mass(properties, {nodes, 0.5 * section.thickness}, state.position, density, inertia);
  return sheet_facets.size() - 1;
}

std::size_t Scene::add_rigid_body(std::span<const NodeId> nodes, const MassProperties& mass,
                                  Held held) {
  for (const NodeId node : nodes) require_node("add_rigid_body", node, state.size());
  const PrincipalAxes axes = principal_axes(mass.inertia);
  const NodeId reference = add_node(mass.centre, held | Held::by_body);
  state.orientation[index_of(reference)] = axes.orientation;
  properties.mass[index_of(reference)] = mass.mass;
  properties.inertia[index_of(reference)] = axes.moments.minCoeff();
  for (const NodeId node : nodes) {
    properties.mass[index_of(node)] = 0.0;
    properties.inertia[index_of(node)] = 0.0;
    properties.held[index_of(node)] = Held::everything;
  }
  rigid_bodies.push_back({reference, {nodes.begin(), nodes.end()}, axes.moments});
  return rigid_bodies.size() - 1;
}

}  // namespace plekton::dynamics
