// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measure_sample.hpp"

namespace plekton::dynamics {

Sample::Sample(const Simulation& simulation)
    : positions_(simulation.force_positions()), contacts_(simulation.contact_rows()) {
  using geometry::index_of;
  std::vector<bool> is_of_body(positions_.size(), false);
  for (const RigidBody& body : simulation.scene().rigid_bodies)
    for (const NodeId node : body.nodes) is_of_body[index_of(node)] = true;
  view_.position = positions_;
  view_.spheres = simulation.elements().spheres;
  for (const geometry::Sphere& sphere : view_.spheres)
    view_.is_grain.push_back(!is_of_body[index_of(sphere.nodes[0])]);
  view_.contacts = contacts_;
}

}  // namespace plekton::dynamics
