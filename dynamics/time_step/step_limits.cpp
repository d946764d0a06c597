// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step/step_limits.hpp"

#include "contact/sphere_surface/patch.hpp"
#include "dynamics/model/scene_figures.hpp"
#include "dynamics/state/contact_springs.hpp"
#include "dynamics/state/spring_shares.hpp"
#include "dynamics/structure/beam_stiffness.hpp"
#include "dynamics/time_step/expected_contacts.hpp"

#include <algorithm>
#include <cmath>

namespace plekton::dynamics {
namespace {

/// Leaves out the springs along the normals of contacts with surfaces: the forces of the contacts'
/// energy have them, and what turns with them.
struct SlipOnSurfaces {
  ContactSprings& springs;

  void add_pair(NodeId a, NodeId b, const ContactStiffness& contact) {
    springs.add_pair(a, b, contact);
  }
  void add_on_surface(NodeId ball, const geometry::CorePoint& core, ContactStiffness contact,
                      const SurfaceTurning&) {
    contact.normal_stiffness = 0.0;
    springs.add_on_surface(ball, core, contact);
  }
  void add_to_wall(NodeId ball, const ContactStiffness& contact) {
    springs.add_to_wall(ball, contact);
  }
  void add(NodeId node, const IsotropicStiffness& single) { springs.add(node, single); }
};

}  // namespace

StepLimits::StepLimits(const Resistance& of)
    : of_(of),
      radii_(node_radii(of.scene, of.surface)),
      expected_(ExpectedContacts(of.scene, of.surface, of.contacts).of_nodes()),
      pace_radius_(pace_radius(of.scene.elements)) {}

void StepLimits::add_expected(NodalStiffness& stiffness) const {
  for (std::size_t i = 0; i < expected_.size(); ++i)
    stiffness.add(geometry::id_at<NodeId>(i), expected_[i]);
}

void StepLimits::add_structures(NodalStiffness& stiffness) const {
  for (std::size_t i = 0; i < of_.scene.bonds.size(); ++i) {
    if (!of_.bonds.is_broken(i))
      add_beam(stiffness, of_.scene.bonds[i], of_.scene.state, of_.bonds.spring(i).length);
  }
  of_.sheet_facets.add_to(stiffness, of_.scene.state);
  of_.loads.add_springs_to(stiffness);
  of_.loads.add_pressures_to(stiffness, of_.scene.state.position);
}

void StepLimits::add_near_contacts(ContactSprings& springs, double margin) const {
  contacts().add_near_to(springs, margin, of_.scene.state.position);
}

void StepLimits::add_spread(NodalStiffness& stiffness, ContactSprings& springs,
                            SpreadStiffness& spread, geometry::Positions x) const {
  constexpr double kDifference = 1e-6;  // of the smallest radius
  if (!spread.begin(springs, of_.scene.state.size())) return;
  spread.add_to(stiffness, springs, of_.scene.properties, {x, kDifference * pace_radius_},
                [&](geometry::Positions places, NodeForces& forces, contact::PatchFinder& finder) {
                  of_.contacts.add_elastic_forces(
                      places, forces, finder, [&](NodeId ball) { return spread.is_spread(ball); });
                });
}

/// Calls look() for all nodes, as many at once as there is space for.
template <class Look>
void StepLimits::for_each_piece(NodalStiffness& space, const Look& look) const {
  for (std::size_t first = 0; first < of_.scene.state.size(); first += space.node_count()) {
    space.begin_at(first);
    look();
  }
}

NodalStiffness::Total StepLimits::total_stiffness(NodalStiffness& space) const {
  NodalStiffness::Total sum;
  for_each_piece(space, [&] {
    add_expected(space);
    add_structures(space);
    const NodalStiffness::Total total = space.total();
    sum.translation += total.translation;
    sum.rotation += total.rotation;
  });
  return sum;
}

/// With gases and viscous damping.
CriticalStep StepLimits::with_loads(CriticalStep step) const {
  step.dt = of_.loads.critical_step(step.dt, of_.scene);
  return step;
}

CriticalStep StepLimits::critical(NodalStiffness& space, geometry::Positions x) const {
  const CriticalStep coming = structural(space, true, x);
  const CriticalStep now = present(space, x);
  return with_loads(now.dt < coming.dt ? now : coming);
}

CriticalStep StepLimits::critical(geometry::Positions x) const {
  NodalStiffness space(of_.scene.state.size(), &of_.scene.properties, &of_.rigid);
  return critical(space, x);
}

CriticalStep StepLimits::present(geometry::Positions x) const {
  NodalStiffness space(of_.scene.state.size(), &of_.scene.properties, &of_.rigid);
  return with_loads(present(space, x));
}

CriticalStep StepLimits::coming(geometry::Positions x) const {
  NodalStiffness space(of_.scene.state.size(), &of_.scene.properties, &of_.rigid);
  return with_loads(structural(space, true, x));
}

/// Of the contacts of now, without gases and viscous damping.
/// @param space  where there are no surfaces it is all the space that is needed
CriticalStep StepLimits::present(NodalStiffness& space, geometry::Positions x) const {
  if (of_.surface.structure_count() == 0) return structural(space, false, x);
  NodalStiffness whole(of_.scene.state.size(), &of_.scene.properties, &of_.rigid);
  ContactSprings springs(&of_.rigid);
  SpreadStiffness spread(of_.surface, of_.rigid);
  add_structures(whole);
  contacts().add_to(springs, 0.0, x);
  add_spread(whole, springs, spread, x);
  SpringShares().add(springs, of_.scene.properties, whole);
  return whole.critical_step(of_.scene.properties);
}

/// Without gases and viscous damping.
/// @param expected  with the contacts that may come, or else with those of now
CriticalStep StepLimits::structural(NodalStiffness& space, bool expected,
                                    geometry::Positions x) const {
  CriticalStep shortest;
  for_each_piece(space, [&] {
    if (expected) add_expected(space);
    add_structures(space);
    if (!expected) contacts().add_to(space, 0.0, x);
    const CriticalStep step = space.critical_step(of_.scene.properties);
    if (step.dt < shortest.dt) shortest = step;
  });
  return shortest;
}

ExactStep StepLimits::exact(geometry::Positions x, double time) const {
  ContactSprings springs(&of_.rigid);
  SlipOnSurfaces slip{springs};
  contacts().add_to(slip, 0.0, x);
  contact::PatchFinder finder(of_.surface);
  const auto normal = [&](geometry::Positions places, NodeForces& forces) {
    of_.contacts.add_elastic_forces(places, forces, finder, [](NodeId) { return true; });
  };
  return exact_critical_step(of_.scene, {of_.bonds, of_.sheet_facets}, of_.loads, springs, time,
                             normal);
}

StepCause StepLimits::cause(geometry::Positions x) const {
  NodalStiffness space(of_.scene.state.size(), &of_.scene.properties, &of_.rigid);
  const CriticalStep coming = structural(space, true, x);
  const CriticalStep now = present(space, x);
  const CriticalStep& shortest = now.dt < coming.dt ? now : coming;
  StepCause cause{shortest, {}, 0.0, shortest.dt};
  if (std::isfinite(shortest.dt)) {
    StiffestPart parts(shortest, of_.scene.properties, of_.rigid);
    consider_structures(parts);
    if (&shortest == &now) {
      contacts().add_to(parts, 0.0, x);
    } else {
      StepPart part{StepPart::Kind::coming_contacts};
      part.partner = ExpectedContacts(of_.scene, of_.surface, of_.contacts)
                         .partner_of(most_touched_of(parts.node()));
      parts.consider(part, [&](NodalStiffness& stiffness) { add_expected(stiffness); });
    }
    cause = parts.cause();
  }
  cause.step.dt = of_.loads.critical_step(shortest.dt, of_.scene);
  return cause;
}

/// Of the nodes that follow a reference node, the one whose contacts to come are stiffest; any other
/// node itself.
NodeId StepLimits::most_touched_of(NodeId node) const {
  const std::int32_t body = of_.rigid.body_at(node);
  if (body < 0) return node;
  NodeId most = node;
  for (const NodeId follower : of_.scene.rigid_bodies[static_cast<std::size_t>(body)].nodes) {
    if (expected_[index_of(follower)].translation > expected_[index_of(most)].translation)
      most = follower;
  }
  return most;
}

/// Everything but contacts that holds the node.
void StepLimits::consider_structures(StiffestPart& parts) const {
  const auto holds_it = [&](const auto& nodes) {
    return std::any_of(nodes.begin(), nodes.end(),
                       [&](NodeId node) { return of_.rigid.mover_of(node) == parts.node(); });
  };
  for (std::size_t i = 0; i < of_.scene.bonds.size(); ++i) {
    if (of_.bonds.is_broken(i) || !holds_it(of_.scene.bonds[i].nodes)) continue;
    parts.consider({StepPart::Kind::bond, i}, [&](NodalStiffness& stiffness) {
      add_beam(stiffness, of_.scene.bonds[i], of_.scene.state, of_.bonds.spring(i).length);
    });
  }
  for (std::size_t i = 0; i < of_.sheet_facets.size(); ++i) {
    if (of_.sheet_facets.is_broken(i) || !holds_it(of_.sheet_facets.nodes(i))) continue;
    parts.consider({StepPart::Kind::sheet_facet, i}, [&](NodalStiffness& stiffness) {
      of_.sheet_facets.add_to(stiffness, of_.scene.state, i);
    });
  }
  parts.consider({StepPart::Kind::ground_springs},
                 [&](NodalStiffness& stiffness) { of_.loads.add_springs_to(stiffness); });
  parts.consider({StepPart::Kind::pressure}, [&](NodalStiffness& stiffness) {
    of_.loads.add_pressures_to(stiffness, of_.scene.state.position);
  });
}

}  // namespace plekton::dynamics
