// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/contact_springs.hpp"

namespace plekton::dynamics {

void ContactSprings::add_end(const End& end) {
  if (end.weight == 0.0) return;
  ends_.push_back(end);
  ++contacts_.back().end_count;
}

void ContactSprings::add_pair(NodeId a, NodeId b, const ContactStiffness& contact) {
  begin(contact);
  add_end({a, -1.0, contact.arm_a});
  add_end({b, 1.0, -contact.arm_b});
}

void ContactSprings::add_on_surface(NodeId ball, const geometry::CorePoint& core,
                                    const ContactStiffness& contact, const SurfaceTurning&) {
  begin(contact);
  add_end({ball, -1.0, contact.arm_a});
  for (std::size_t i = 0; i < core.nodes.size(); ++i)
    add_end({core.nodes[i], core.weights[static_cast<Eigen::Index>(i)], -contact.arm_b});
}

void ContactSprings::add_to_wall(NodeId ball, const ContactStiffness& contact) {
  begin(contact);
  add_end({ball, -1.0, contact.arm_a});
}

void ContactSprings::add(NodeId node, const IsotropicStiffness& springs) {
  single_.push_back({node, springs});
}

void ContactSprings::resist(const std::vector<Vec3>& shift, const std::vector<Vec3>& turn,
                            NodeForces& forces) const {
  for (const Spring& spring : contacts_) {
    const Vec3& n = spring.contact.normal;
    Vec3 way = Vec3::Zero();  // m, of the contact point on b less that on a
    for (std::size_t i = spring.first_end; i < spring.first_end + spring.end_count; ++i) {
      const End& end = ends_[i];
      way += end.weight *
             (shift[index_of(end.node)] + turn[index_of(end.node)].cross(Vec3(end.arm * n)));
    }
    const Vec3 along = n.dot(way) * n;
    const Vec3 force = spring.contact.normal_stiffness * along +
                       spring.contact.tangential_stiffness * (way - along);
    for (std::size_t i = spring.first_end; i < spring.first_end + spring.end_count; ++i) {
      const End& end = ends_[i];
      forces.force[index_of(end.node)] -= end.weight * force;
      forces.torque[index_of(end.node)] -= end.weight * Vec3(end.arm * n).cross(force);
    }
  }
  for (const Single& single : single_) {
    const std::size_t node = index_of(single.node);
    forces.force[node] -= single.springs.translation * shift[node];
    forces.torque[node] -= single.springs.rotation * turn[node];
  }
}

}  // namespace plekton::dynamics
