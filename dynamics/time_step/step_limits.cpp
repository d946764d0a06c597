// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step/step_limits.hpp"

#include "contact/sphere_surface/patch.hpp"
#include "dynamics/model/scene_figures.hpp"
#include "dynamics/stiffness/contact_springs.hpp"
#include "dynamics/stiffness/spring_shares.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "dynamics/structure/beam_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plekton::dynamics {
namespace {

/// How far differences of forces go, of the smallest radius.
constexpr double kShareOfRadius = 1e-6;

/// Leaves out the springs along the normals of contacts with surfaces, but for dashpots: the forces
/// of the contacts' energy have them, and what turns with them.
struct SlipOnSurfaces {
  ContactSprings& springs;

  void add_pair(NodeId a, NodeId b, const ContactStiffness& contact) {
    springs.add_pair(a, b, contact);
  }
  void add_on_surface(NodeId ball, const geometry::CorePoint& core, ContactStiffness contact,
                      const SurfaceTurning&) {
    contact.normal_stiffness = contact.dashpot;
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
      pace_radius_(pace_radius(of.scene.elements)) {
  const ExpectedContacts expected(of.scene, of.surface, of.contacts);
  expected_ = expected.of_nodes();
  const auto is_damped = [](const ExpectedOfNode& node) { return node.damping > 0.0; };
  is_damped_ = std::ranges::any_of(expected_, is_damped);
  // Those of a structure with itself are not among them.
  if (!is_damped_ && of.surface.structure_count() > 0)
    is_damped_ = std::ranges::any_of(expected.of_structures(), is_damped);
}

void StepLimits::add_expected(NodalStiffness& stiffness, double rate) const {
  for (std::size_t i = 0; i < expected_.size(); ++i)
    stiffness.add(geometry::id_at<NodeId>(i), expected_[i].with_dashpots(rate));
}

void StepLimits::add_structures(NodalStiffness& stiffness) const {
  for (std::size_t i = 0; i < of_.scene.bonds.size(); ++i) {
    if (!of_.bonds.is_broken(i))
      add_beam(stiffness, of_.scene.bonds[i], of_.scene.state, of_.bonds.spring(i).length);
  }
  of_.sheet_facets.add_to(stiffness, of_.scene.state);
  of_.ties.add_to(stiffness);
  of_.loads.add_springs_to(stiffness);
  of_.loads.add_pressures_to(stiffness, of_.scene.state.position);
}

void StepLimits::add_near_contacts(ContactSprings& springs, double margin, double rate) const {
  contacts(rate).add_near_to(springs, margin, of_.scene.state.position);
}

void StepLimits::add_near_wires(ContactSprings& springs, double margin) const {
  const NodeState& state = of_.scene.state;
  of_.yielding_bonds.for_each_wire([&](std::size_t bond, const WireYield& wire) {
    if (of_.bonds.is_broken(bond)) return;
    const auto [a, b] = of_.bonds.nodes(bond);
    const Vec3 chord = state.position[index_of(b)] - state.position[index_of(a)];
    const double length = chord.norm();
    if (!(length > 0.0) || length + margin < wire.rest_length) return;
    const double stiffness = of_.bonds.spring(bond).axial;
    springs.add_pair(a, b,
                     {.normal = chord / length,
                      .normal_stiffness = stiffness,
                      .tangential_stiffness = 0.0,
                      .arm_a = 0.0,
                      .arm_b = 0.0,
                      .overlap = wire.force / stiffness});
  });
}

void StepLimits::find_between_structures(StructureStiffness& structures, geometry::Positions x,
                                         double moved) const {
  if (of_.surface.structure_count() == 0) return;
  structures.find(of_.contacts, of_.scene.properties, {x, kShareOfRadius * pace_radius_}, moved);
}

void StepLimits::add_spread(NodalStiffness& stiffness, ContactSprings& springs,
                            SpreadStiffness& spread, geometry::Positions x) const {
  if (!spread.begin(springs, of_.scene.state.size())) return;
  spread.add_to(stiffness, springs, of_.scene.properties, {x, kShareOfRadius * pace_radius_},
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
    add_expected(space, 0.0);
    add_structures(space);
    const NodalStiffness::Total total = space.total();
    sum.translation += total.translation;
    sum.rotation += total.rotation;
  });
  return sum;
}

/// s, the critical step of the structures alone; infinite where none is damped, as nobody asks.
double StepLimits::of_structures(NodalStiffness& space) const {
  if (!of_.loads.damps_structures()) return std::numeric_limits<double>::infinity();
  return shortest_of_pieces(space, [] {}).dt;
}

/// With gases and viscous damping. @param of_structures  s, see there
CriticalStep StepLimits::with_loads(CriticalStep step, double of_structures) const {
  step.dt = of_.loads.critical_step(step.dt, of_structures, of_.scene);
  return step;
}

/// The critical step where dashpots count by the step itself, to a thousandth and never above it:
/// from one of which nothing is known the first stable one is found, and from then on longer ones.
/// @param find  (rate, 1/s) -> the critical step with dashpots as they count at that rate
template <class Step, class Find>
Step StepLimits::with_dashpots(const Find& find) const {
  constexpr int kMostSteps = 40;  // of which each takes away half of the error or more
  constexpr double kTolerance = 1e-3;
  Step step = find(0.0);
  for (int i = 0; is_damped_ && std::isfinite(step.dt) && i < kMostSteps; ++i) {
    const double tried = step.dt;
    step = find(dashpot_rate(tried));
    step.dt = stable_with_dashpots(tried, step.dt);
    if (std::abs(step.dt - tried) <= kTolerance * tried) break;
  }
  return step;
}

CriticalStep StepLimits::critical(NodalStiffness& space, geometry::Positions x) const {
  StructureStiffness between(of_.rigid);
  find_between_structures(between, x, std::numeric_limits<double>::infinity());
  const double alone = of_structures(space);
  return with_dashpots<CriticalStep>([&](double rate) {
    const CriticalStep coming = structural(space, rate);
    const CriticalStep now = present(space, between, x, rate);
    return with_loads(now.dt < coming.dt ? now : coming, alone);
  });
}

CriticalStep StepLimits::critical(geometry::Positions x) const {
  NodalStiffness space(of_.scene.state.size(), &of_.scene.properties, &of_.rigid);
  return critical(space, x);
}

CriticalStep StepLimits::present(geometry::Positions x) const {
  NodalStiffness space(of_.scene.state.size(), &of_.scene.properties, &of_.rigid);
  StructureStiffness between(of_.rigid);
  find_between_structures(between, x, std::numeric_limits<double>::infinity());
  const double alone = of_structures(space);
  return with_dashpots<CriticalStep>(
      [&](double rate) { return with_loads(present(space, between, x, rate), alone); });
}

CriticalStep StepLimits::coming() const {
  NodalStiffness space(of_.scene.state.size(), &of_.scene.properties, &of_.rigid);
  const double alone = of_structures(space);
  return with_dashpots<CriticalStep>(
      [&](double rate) { return with_loads(structural(space, rate), alone); });
}

/// Of the contacts of now, without gases and viscous damping.
/// @param space    where there are no surfaces it is all the space that is needed
/// @param between  what was found of structures with each other
CriticalStep StepLimits::present(NodalStiffness& space, const StructureStiffness& between,
                                 geometry::Positions x, double rate) const {
  if (of_.surface.structure_count() == 0) {
    return shortest_of_pieces(space, [&] { contacts(rate).add_to(space, 0.0, x); });
  }
  NodalStiffness whole(of_.scene.state.size(), &of_.scene.properties, &of_.rigid);
  ContactSprings springs(&of_.rigid);
  SpreadStiffness spread(of_.surface, of_.rigid);
  add_structures(whole);
  contacts(rate).add_to(springs, 0.0, x);
  between.add_to(springs);
  add_spread(whole, springs, spread, x);
  SpringShares().add(springs, of_.scene.properties, whole);
  return whole.critical_step(of_.scene.properties);
}

/// With the contacts that may come, without gases and viscous damping.
CriticalStep StepLimits::structural(NodalStiffness& space, double rate) const {
  return shortest_of_pieces(space, [&] { add_expected(space, rate); });
}

/// @param add_contacts  adds contacts to the space
template <class Add>
CriticalStep StepLimits::shortest_of_pieces(NodalStiffness& space, const Add& add_contacts) const {
  CriticalStep shortest;
  for_each_piece(space, [&] {
    add_contacts();
    add_structures(space);
    const CriticalStep step = space.critical_step(of_.scene.properties);
    if (step.dt < shortest.dt) shortest = step;
  });
  return shortest;
}

ExactStep StepLimits::exact(geometry::Positions x, double time) const {
  contact::PatchFinder finder(of_.surface);
  const auto normal = [&](geometry::Positions places, NodeForces& forces) {
    of_.contacts.add_elastic_forces(places, forces, finder, [](NodeId) { return true; });
  };
  NodalStiffness space(of_.scene.state.size(), &of_.scene.properties, &of_.rigid);
  const double alone = of_structures(space);
  StructureStiffness between(of_.rigid);
  find_between_structures(between, x, std::numeric_limits<double>::infinity());
  return with_dashpots<ExactStep>([&](double rate) {
    ContactSprings springs(&of_.rigid);
    SlipOnSurfaces slip{springs};
    contacts(rate).add_to(slip, 0.0, x);
    between.add_to(springs);
    return exact_critical_step(of_.scene, {of_.bonds, of_.sheet_facets, of_.ties, alone}, of_.loads,
                               springs, time, normal);
  });
}

StepCause StepLimits::cause(geometry::Positions x) const {
  NodalStiffness space(of_.scene.state.size(), &of_.scene.properties, &of_.rigid);
  bool is_coming = false;
  double rate = 0.0;
  double without_dashpots = 0.0;
  CriticalStep shortest;  // without gases and viscous damping
  StructureStiffness between(of_.rigid);
  find_between_structures(between, x, std::numeric_limits<double>::infinity());
  const double alone = of_structures(space);
  const CriticalStep step = with_dashpots<CriticalStep>([&](double tried) {
    rate = tried;
    const CriticalStep coming = structural(space, rate);
    const CriticalStep now = present(space, between, x, rate);
    is_coming = !(now.dt < coming.dt);
    shortest = is_coming ? coming : now;
    if (rate == 0.0) without_dashpots = shortest.dt;
    return with_loads(shortest, alone);
  });
  StepCause cause{shortest, {}, 0.0, shortest.dt};
  if (std::isfinite(shortest.dt)) {
    StiffestPart parts(shortest, of_.scene.properties, of_.rigid);
    consider_structures(parts);
    if (is_coming) {
      StepPart part{StepPart::Kind::coming_contacts};
      part.partner = ExpectedContacts(of_.scene, of_.surface, of_.contacts)
                         .partner_of(most_touched_of(parts.node()));
      parts.consider(part, [&](NodalStiffness& stiffness) { add_expected(stiffness, rate); });
    } else {
      contacts(rate).add_to(parts, 0.0, x);
    }
    cause = parts.cause();
  }
  cause.without_dashpots = without_dashpots;
  cause.step.dt = step.dt;
  return cause;
}

/// Of the nodes that follow a reference node, the one whose contacts to come are stiffest; any other
/// node itself.
NodeId StepLimits::most_touched_of(NodeId node) const {
  const std::int32_t body = of_.rigid.body_at(node);
  if (body < 0) return node;
  NodeId most = node;
  for (const NodeId follower : of_.scene.rigid_bodies[static_cast<std::size_t>(body)].nodes) {
    if (expected_[index_of(follower)].stiffness.translation >
        expected_[index_of(most)].stiffness.translation)
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
  for (std::size_t i = 0; i < of_.ties.size(); ++i) {
    bool is_held = false;
    of_.ties.for_each_node(
        i, [&](NodeId node) { is_held = is_held || of_.rigid.mover_of(node) == parts.node(); });
    if (!is_held) continue;
    parts.consider({StepPart::Kind::tie, i},
                   [&](NodalStiffness& stiffness) { of_.ties.add_to(stiffness, i); });
  }
  parts.consider({StepPart::Kind::ground_springs},
                 [&](NodalStiffness& stiffness) { of_.loads.add_springs_to(stiffness); });
  parts.consider({StepPart::Kind::pressure}, [&](NodalStiffness& stiffness) {
    of_.loads.add_pressures_to(stiffness, of_.scene.state.position);
  });
}

}  // namespace plekton::dynamics
