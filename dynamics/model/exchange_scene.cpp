// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/model/exchange_scene.hpp"

#include <vector>

namespace plekton::dynamics {

namespace {

/// Elements with their materials. @returns whether they are others than before
template <class Element>
bool exchange_table(const geometry::StateArchive& archive, const char* name, const Scene& scene,
                    std::vector<Element>& elements, std::vector<contact::MaterialId>& materials) {
  struct Kept {
    Element element;
    contact::MaterialId material;
  };
  std::vector<Kept> kept;
  for (std::size_t i = 0; i < elements.size(); ++i) kept.push_back({elements[i], materials[i]});
  archive.rows(name, kept, [&](geometry::RowFields& row, Kept& one) {
    row("nodes", one.element.nodes);
    row.require(are_nodes(one.element.nodes, scene.state.size()), "nodes");
    row("radius", one.element.radius);
    row("material", one.material);
    const auto material = static_cast<std::int64_t>(one.material);
    row.require(material >= 0 && material < static_cast<std::int64_t>(scene.materials.size()),
                "material");
  });
  const bool is_same = std::equal(
      kept.begin(), kept.end(), elements.begin(), elements.end(),
      [](const Kept& one, const Element& element) { return one.element.nodes == element.nodes; });
  elements.clear();
  materials.clear();
  for (const Kept& one : kept) {
    elements.push_back(one.element);
    materials.push_back(one.material);
  }
  return !is_same;
}

/// A member of each plane, as an array of its own.
template <class Number>
void exchange_of_planes(const geometry::StateArchive& archive, const char* name,
                        Number contact::Plane::*member, std::vector<contact::Plane>& planes) {
  std::vector<Number> numbers;
  for (const contact::Plane& plane : planes) numbers.push_back(plane.*member);
  archive.fixed(name, numbers, "planes");
  for (std::size_t i = 0; i < planes.size(); ++i) planes[i].*member = numbers[i];
}

}  // namespace

void exchange_nodes(const geometry::StateArchive& archive, NodeState& state, NodeForces& forces) {
  archive.fixed("position", state.position, "nodes");
  archive.fixed("velocity", state.velocity, "nodes");
  archive.fixed("angular_velocity", state.angular_velocity, "nodes");
  archive.fixed("orientation", state.orientation, "nodes");
  archive.fixed("force", forces.force, "nodes");
  archive.fixed("torque", forces.torque, "nodes");
}

void exchange_planes(const geometry::StateArchive& archive, std::vector<contact::Plane>& planes) {
  exchange_of_planes(archive, "point", &contact::Plane::point, planes);
  exchange_of_planes(archive, "velocity", &contact::Plane::velocity, planes);
  exchange_of_planes(archive, "radius", &contact::Plane::radius, planes);
  exchange_of_planes(archive, "widening", &contact::Plane::widening, planes);
}

bool exchange_elements(const geometry::StateArchive& archive, Scene& scene) {
  const bool are_other_cylinders = exchange_table(
      archive, "cylinders", scene, scene.elements.cylinders, scene.cylinder_materials);
  const bool are_other_facets =
      exchange_table(archive, "facets", scene, scene.elements.facets, scene.facet_materials);
  return are_other_cylinders || are_other_facets;
}

}  // namespace plekton::dynamics
