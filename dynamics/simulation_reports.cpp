// SPDX-License-Identifier: GPL-3.0-or-later
// What can be read out of a simulation between steps.
#include "dynamics/measures/unbalanced_force.hpp"
#include "dynamics/model/require_index.hpp"
#include "dynamics/simulation.hpp"
#include "geometry/base/elementary.hpp"

#include <algorithm>
#include <iterator>
#include <span>
#include <vector>

namespace plekton::dynamics {

std::vector<Vec3> Simulation::force_positions() const {
  nodes_.know_all();
  return positions_before(scene_.state, last_drift_);
}

Vec3 Simulation::force_point(std::size_t plane) const {
  require_index("force_point", "plane", plane, scene_.planes.size());
  return scene_.planes[plane].point - last_drift_ * scene_.planes[plane].velocity;
}

double Simulation::force_radius(std::size_t plane) const {
  require_index("force_radius", "plane", plane, scene_.planes.size());
  return scene_.planes[plane].radius - last_drift_ * scene_.planes[plane].widening;
}

std::vector<contact::ContactRecord> Simulation::list_contacts() {
  contacts_->assign_ids();
  return contact_rows();
}

std::vector<contact::ContactRecord> Simulation::contact_rows() const {
  std::vector<contact::ContactRecord> rows;
  contacts_->for_each_record(force_positions(),
                             [&](const contact::ContactRecord& row) { rows.push_back(row); });
  return rows;
}

ForceAndMoment Simulation::plane_reaction(std::size_t plane) const {
  require_index("plane_reaction", "plane", plane, scene_.planes.size());
  const Vec3 about = force_point(plane);
  ForceAndMoment sum;
  contacts_->for_each_plane_record(force_positions(), [&](const contact::ContactRecord& row) {
    if (static_cast<std::size_t>(row.b.index) == plane)
      sum.add(row.point - about, row.force(), row.moment);
  });
  return sum;
}

double Simulation::pressing_on(std::size_t plane) const {
  require_index("pressing_on", "plane", plane, scene_.planes.size());
  PlaneReaction sum{plane_reaction(plane).force, 0.0};
  contacts_->for_each_plane_force([&](std::size_t other, const Vec3&, double push) {
    if (other == plane) sum.push += push;
  });
  return sum.pressing(scene_.planes[plane]);
}

ForceAndMoment Simulation::support_reaction(std::span<const NodeId> nodes,
                                            const Vec3& about) const {
  for (const NodeId node : nodes) require_node("support_reaction", node, scene_.state.size());
  std::vector<NodeId> supported;
  std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(supported),
               [this](NodeId node) { return rigid_nodes_.body_followed_by(node) < 0; });
  const std::vector<Vec3> positions = force_positions();
  return dynamics::support_reaction(
      supported, {positions, forces_, scene_.properties, motion_.gravity}, about);
}

ForceAndMoment Simulation::section_force(std::span<const NodeId> nodes, const Vec3& about) const {
  nodes_.know_all();
  std::vector<char> is_inside(scene_.state.size(), 0);
  for (const NodeId node : nodes) {
    require_node("section_force", node, is_inside.size());
    is_inside[index_of(node)] = 1;
  }
  const NodeState before = state_before(scene_.state, last_drift_);
  ForceAndMoment sum;
  for (std::size_t i = 0; i < bonds_.size(); ++i) {
    const auto [a, b] = bonds_.nodes(i);
    const bool has_b = is_inside[index_of(b)] != 0;
    if ((is_inside[index_of(a)] != 0) == has_b || bonds_.is_broken(i)) continue;
    const auto [force, torque] = bonds_.action_on(i, has_b, before);
    sum.add(before.position[index_of(has_b ? b : a)] - about, force, torque);
  }
  for (std::size_t i = 0; i < sheet_facets_.size(); ++i) {
    const auto corners = sheet_facets_.nodes(i);
    const auto inside = std::count_if(corners.begin(), corners.end(), [&](NodeId corner) {
      return is_inside[index_of(corner)] != 0;
    });
    for (std::size_t k = 0; k < 3 && inside < 3; ++k) {
      if (is_inside[index_of(corners[k])] == 0) continue;
      sum.add(before.position[index_of(corners[k])] - about, sheet_facets_.corner_force(i, k),
              sheet_facets_.corner_torque(i, k));
    }
  }
  return sum;
}

double Simulation::unbalanced_force_ratio() const {
  const std::vector<Vec3> positions = force_positions();
  MeanMagnitude carried;
  contacts_->for_each_record(
      positions, [&](const contact::ContactRecord& row) { carried.add(row.force().norm()); });
  for (std::size_t i = 0; i < bonds_.size(); ++i) {
    if (bonds_.is_broken(i) || !scene_.is_there(scene_.bonds[i].nodes[0])) continue;
    const BondForces forces = bond_forces(i);
    carried.add(elementary::hypot(forces.tension, forces.shear.norm()));
  }
  for (std::size_t i = 0; i < ties_.size(); ++i)
    if (!ties_.is_broken(i)) carried.add(std::abs(ties_.pull(i)));
  for (std::size_t i = 0; i < sheet_facets_.size(); ++i) {
    if (sheet_facets_.is_broken(i) || !scene_.is_there(scene_.sheet_facets[i].nodes[0])) continue;
    for (std::size_t corner = 0; corner < 3; ++corner)
      carried.add(sheet_facets_.corner_force(i, corner).norm());
  }
  return dynamics::unbalanced_force_ratio({positions, forces_, scene_.properties, motion_.gravity},
                                          carried.value());
}

std::vector<FacetTraction> Simulation::facet_tractions() {
  NodeForces forces(scene_.state.size());
  contacts_->add_surface_forces(forces, pool_);
  return dynamics::facet_tractions(scene_.elements.facets, forces.force, force_positions());
}

const Vec3& Simulation::gathered_force(std::size_t body) const {
  require_index("gathered_force", "rigid body", body, scene_.rigid_bodies.size());
  return rigid_bodies_.gathered_force(body);
}

const Vec3& Simulation::gathered_torque(std::size_t body) const {
  require_index("gathered_torque", "rigid body", body, scene_.rigid_bodies.size());
  return rigid_bodies_.gathered_torque(body);
}

BondForces Simulation::bond_forces(std::size_t bond) const {
  require_index("bond_forces", "bond", bond, bonds_.size());
  return yielding_bonds_.forces_of(bond, bonds_, scene_.state);
}

BondStress Simulation::bond_stress(std::size_t bond) const {
  require_index("bond_stress", "bond", bond, bonds_.size());
  return dynamics::bond_stress(bond_forces(bond), scene_.bonds[bond].section);
}

}  // namespace plekton::dynamics
