// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/measures/fault_finder.hpp"

#include "dynamics/structure/beam_bonds.hpp"
#include "geometry/base/elementary.hpp"
#include "geometry/critical/product_features.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

namespace plekton::dynamics {

/// The contact or element that acts most on a node, as far as has been looked.
class StrongestAction {
 public:
  /// @param of_spin  whether torques (N m) are compared, or else forces (N)
  explicit StrongestAction(bool of_spin) : of_spin_(of_spin) {}

  /// @param describe  tells what it is; called if it is the strongest so far
  template <class Describe>
  void consider(double force, double torque, const Describe& describe) {
    const double size = of_spin_ ? torque : force;
    if (!(size > largest_)) return;
    largest_ = size;
    std::ostringstream text;
    describe(text);
    text << " acts on it with " << size << (of_spin_ ? " N m" : " N");
    text_ = text.str();
  }

  /// Empty if nothing acts.
  const std::string& text() const noexcept { return text_; }

 private:
  bool of_spin_;
  double largest_ = 0.0;
  std::string text_;
};

std::string FaultFinder::fault(const Divergence& divergence, const Drifts& drifts,
                               const std::string& suspect) {
  std::ostringstream text;
  if (const double limit = limit_exceeded_before(divergence, drifts); limit > 0.0) {
    text << "it was that fast before the step: that was given or is prescribed; use a lower speed, "
            "or a time step below "
         << limit << " s (or \"auto\")";
    return text.str();
  }
  const double drift = drifts.drift;
  NodeState before = state_before(*state_, drift);
  const std::string who = strongest_action(divergence, before);
  if (!who.empty())
    text << who;
  else if (divergence.sign == Divergence::Sign::energy && !suspect.empty())
    text << "nothing acts on it now; before, " << suspect;
  else
    text << "no contact and no element acts on it, but loads may";
  if (who.empty() && divergence.sign != Divergence::Sign::energy) {
    text << "; as fast as it is, it is followed in steps below " << longest_followed(divergence)
         << " s";
    return text.str();
  }
  text << "; the time step of " << drift << " s is ";
  const double usual = critical_step_at(before, drifts.last, true);
  const double critical = critical_step_at(before, drifts.last, false);
  if (drift > kLargestStep * usual && !drifts.is_chosen) {
    text << drift / usual << " of the critical one: use a smaller time step (or \"auto\")";
    return text.str();
  }
  if (std::isfinite(usual) && drift <= kLargestStep * usual)
    text << drift / usual << " of the critical one and ";
  text << "not the cause: ";
  if (drift > kLargestStep * critical)
    text << "with the contacts of now that is " << critical
         << " s, so that something there is far stiffer than contacts of these bodies are; ";
  text << "look there for bodies that start in each other or are pressed deep into each other, and "
          "for elements and stiffnesses unlike those around";
  return text.str();
}

/// Where a node moves or spins too fast, and would have without the forces of the last step: the
/// longest step (s) in which that could be followed; else 0, and of what follows a rigid body that
/// is free to move.
double FaultFinder::limit_exceeded_before(const Divergence& divergence,
                                          const Drifts& drifts) const noexcept {
  if (divergence.sign == Divergence::Sign::energy) return 0.0;
  const std::size_t i = index_of(divergence.node);
  const std::size_t mover = index_of(of_.rigid.mover_of(divergence.node));
  if (mover != i && of_.scene.properties.held[mover] != Held::everything) return 0.0;
  const NodeProperties& properties = of_.scene.properties;
  const bool spins = divergence.sign == Divergence::Sign::spin;
  const Vec3& now = spins ? state_->angular_velocity[i] : state_->velocity[i];
  const Vec3 free = spins ? free_turns(properties.held[i]) : free_axes(properties.held[i]);
  const double inertia = spins ? properties.inertia[i] : properties.mass[i];
  Vec3 before = now;
  if (free.maxCoeff() > 0.0) {
    const Vec3& force = spins ? forces_->torque[i] : forces_->force[i];
    before -= 0.5 * (drifts.last + drifts.drift) / inertia * free.cwiseProduct(force);
  }
  const double longest = longest_followed(divergence);
  return before.norm() * drifts.drift > longest * now.norm() ? longest : 0.0;
}

double FaultFinder::longest_followed(const Divergence& divergence) const noexcept {
  const std::size_t i = index_of(divergence.node);
  if (divergence.sign == Divergence::Sign::spin)
    return std::numbers::pi / state_->angular_velocity[i].norm();
  return furthest_[i] / state_->velocity[i].norm();
}

/// s, of the structures and contacts at a state; with the velocities of now.
/// @param last      s, see Drifts
/// @param expected  with the contacts that may come, or else with those of now
double FaultFinder::critical_step_at(NodeState& state, double last, bool expected) {
  std::swap(*state_, state);
  const std::vector<Vec3> x = positions_before(*state_, last);
  const CriticalStep step = expected ? limits_->coming() : limits_->present(x);
  std::swap(*state_, state);
  return step.dt;
}

std::string FaultFinder::strongest_action(const Divergence& divergence, const NodeState& state) {
  const NodeId node = divergence.node;
  StrongestAction action(divergence.sign == Divergence::Sign::spin);
  consider_contacts(node, state.position, action);
  for (std::size_t i = 0; i < of_.bonds.size(); ++i) {
    const auto nodes = of_.bonds.nodes(i);
    if (of_.bonds.is_broken(i) || !(moves(nodes[0], node) || moves(nodes[1], node))) continue;
    const BondForces forces = of_.bonds.forces_of(i, state);
    const Vec3& moment = moves(nodes[0], node) ? forces.moment_a : forces.moment_b;
    action.consider(elementary::hypot(forces.tension, forces.shear.norm()),
                    elementary::hypot(moment.norm(), forces.torque), [&](std::ostream& text) {
                      text << "bond " << i << " (nodes " << index_of(nodes[0]) << ", "
                           << index_of(nodes[1]) << ")";
                    });
  }
  for (std::size_t i = 0; i < of_.sheet_facets.size(); ++i) {
    if (of_.sheet_facets.is_broken(i)) continue;
    const auto nodes = of_.sheet_facets.nodes(i);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      if (!moves(nodes[corner], node)) continue;
      action.consider(of_.sheet_facets.corner_force(i, corner).norm(),
                      of_.sheet_facets.corner_torque(i, corner).norm(), [&](std::ostream& text) {
                        text << "sheet facet " << i << " (nodes " << index_of(nodes[0]) << ", "
                             << index_of(nodes[1]) << ", " << index_of(nodes[2]) << ")";
                      });
    }
  }
  for (std::size_t i = 0; i < of_.ties.size(); ++i) {
    bool is_on_it = false;
    of_.ties.for_each_node(i, [&](NodeId end) { is_on_it = is_on_it || moves(end, node); });
    if (is_on_it && !of_.ties.is_broken(i))
      action.consider(std::abs(of_.ties.pull(i)), 0.0,
                      [&](std::ostream& text) { text << "tie " << i; });
  }
  return action.text();
}

/// Of a patch of a sphere on a surface that has the node elsewhere than where it is deepest, what
/// it does to the node is not known: it is at most that of all of these together.
void FaultFinder::consider_contacts(NodeId node, geometry::Positions x, StrongestAction& action) {
  const auto describe_row = [this](const contact::ContactRecord& row) {
    return [this, &row](std::ostream& text) { describe(row, text); };
  };
  of_.contacts.for_each_structure_record_on(
      node, x, [&](const contact::ContactRecord& row, const Vec3& force, const Vec3& torque) {
        action.consider(force.norm(), torque.norm(), describe_row(row));
      });
  NodeForces all(state_->size());
  of_.contacts.add_sphere_surface_forces(all, *pool_);
  const double most_force = all.force[index_of(node)].norm();
  const double most_torque = all.torque[index_of(node)].norm();
  const auto consider = [&](const contact::ContactRecord& row) {
    constexpr auto kStructure = contact::BodyKind::structure;
    if (row.a.kind == kStructure && row.b.kind == kStructure) return;
    const double force = row.force().norm();
    const double torque =
        (row.point - x[index_of(node)]).cross(row.force()).norm() + row.moment.norm();
    if (has_node(row.a, node) || has_node(row.b, node))
      action.consider(force, torque, describe_row(row));
    else if (is_of_structure(row.b, node))
      action.consider(std::min(force, most_force), std::min(torque, most_torque),
                      describe_row(row));
  };
  of_.contacts.for_each_record(x, consider);
}

bool FaultFinder::is_of_structure(const contact::ContactBody& body, NodeId node) const {
  return body.kind == contact::BodyKind::structure &&
         geometry::StructureId{body.index} == of_.surface.structure_of(node);
}

bool FaultFinder::has_node(const contact::ContactBody& body, NodeId node) const {
  if (body.kind == contact::BodyKind::sphere)
    return moves(of_.scene.elements.spheres[static_cast<std::size_t>(body.index)].nodes[0], node);
  if (body.kind == contact::BodyKind::plane || body.feature.id < 0) return false;
  const geometry::FeatureNodes nodes = geometry::nodes_of(of_.surface, body.feature);
  return std::any_of(nodes.begin(), nodes.end(), [&](NodeId one) { return moves(one, node); });
}

/// Whether what acts on one node acts on another: it is the same, or both are of one rigid body.
bool FaultFinder::moves(NodeId one, NodeId other) const noexcept {
  return of_.rigid.mover_of(one) == of_.rigid.mover_of(other);
}

/// As in "the contact of sphere 3 (node 40) with the edge (nodes 7, 8) of structure 0 at (0 0 1) m,
/// 0.002 m deep".
void FaultFinder::describe(const contact::ContactRecord& row, std::ostream& text) const {
  const auto name = [&](const contact::ContactBody& body) {
    if (body.kind == contact::BodyKind::plane) {
      text << "plane " << body.index;
    } else if (body.kind == contact::BodyKind::sphere) {
      const auto& sphere = of_.scene.elements.spheres[static_cast<std::size_t>(body.index)];
      text << "sphere " << body.index << " (node " << index_of(sphere.nodes[0]) << ')';
    } else {
      constexpr const char* kKinds[] = {"node ", "the edge (nodes ", "the facet (nodes "};
      const geometry::FeatureNodes nodes = geometry::nodes_of(of_.surface, body.feature);
      text << kKinds[static_cast<std::size_t>(body.feature.kind)];
      for (const NodeId& node : nodes)
        text << (&node == nodes.begin() ? "" : ", ") << index_of(node);
      text << (nodes.count > 1 ? ")" : "") << " of structure " << body.index;
    }
  };
  text << "the contact of ";
  name(row.a);
  text << " with ";
  name(row.b);
  text << " at (" << row.point.transpose() << ") m, " << std::abs(row.gap)
       << (row.gap < 0.0 ? " m deep," : " m apart,");
}

}  // namespace plekton::dynamics
