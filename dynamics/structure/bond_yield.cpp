// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/bond_yield.hpp"

#include "dynamics/state/rotation_step.hpp"
#include "dynamics/structure/beam_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace plekton::dynamics {
namespace {

/// Moments are at their limits to this part of what they would be without yielding.
constexpr double kPrecision = 1e-13;

/// Plastic changes in one step.
struct Flow {
  double stretch = 0.0;                                   // m
  std::array<Vec3, 2> turns{Vec3::Zero(), Vec3::Zero()};  // rad, of the ends at a and b
  double twist = 0.0;                                     // rad, of b against a
};

/// How far a force has to flow, from what it would be without flow, to come back to its limit.
double amount(double force, double limit, double stiffness) noexcept {
  return force > limit ? (force - limit) / stiffness : 0.0;
}

double along(double trial, double limit, double stiffness) noexcept {
  return std::copysign(amount(std::abs(trial), limit, stiffness), trial);
}

Vec3 along(const Vec3& trial, double limit, double stiffness) noexcept {
  const double size = trial.norm();
  return size > limit ? Vec3((amount(size, limit, stiffness) / size) * trial) : Vec3(Vec3::Zero());
}

/// The limits of a bond when the step begins.
struct Bounds {
  double tension;                 // N
  std::array<double, 2> moments;  // N m, at a and b
  double torque;                  // N m
};

/// Axis of the beam as a node carries it.
Vec3 axis_of(const QuatOf<double>& node, const QuatOf<double>& rest) noexcept {
  const PackVec3<double> axis = x_axis(product(node, rest));
  return {axis.x, axis.y, axis.z};
}

Vec3 across(const Vec3& axis, const Vec3& v) noexcept {
  return v - v.dot(axis) * axis;
}

/// What the turns of the ends depend on, across the axes of the ends.
struct EndMoments {
  std::array<Vec3, 2> axes;   // unit
  std::array<Vec3, 2> trial;  // N m, what the moments would be without the turns
  double bending;             // N m, EI / L0
  double hardening;           // N m
};

/// Better turns of both ends than those given, each that of its end while the other is kept: one in
/// turn with the other, since either changes the moment at the other half as much as at its own.
/// The error gets smaller by 4 or more each time; that it does by 1000 is enough, because what the
/// turns are taken from gets better as well.
std::array<Vec3, 2> turns_of(const EndMoments& moments, const std::array<double, 2>& limits,
                             std::array<Vec3, 2> turns) {
  constexpr int kMost = 6;
  const double stiffness = 4.0 * moments.bending + moments.hardening;
  const auto turn = [&](std::size_t end) {
    const Vec3 others = 2.0 * moments.bending * across(moments.axes[end], turns[1 - end]);
    return along(Vec3(moments.trial[end] - others), limits[end], stiffness);
  };
  for (int i = 0; i < kMost; ++i) {
    turns[0] = turn(0);
    const Vec3 next = turn(1);
    const bool is_still = next == turns[1];  // as where the end at b does not yield
    turns[1] = next;
    if (is_still) break;
  }
  return turns;
}

/// The flow that leads back to the limits, from the forces after a flow that did not quite. Moments
/// and turns are across the axes.
Flow better_flow(const BeamEndsOf<double>& ends, const BondForces& forces, const Flow& flow,
                 const Bounds& bounds, const BondLimits& limits,
                 const BeamSpringOf<double>& spring) noexcept {
  const double c2 = 2.0 * spring.bending;
  const Vec3 axis_a = axis_of(ends.turn_a, spring.rest_a);
  const Vec3 axis_b = axis_of(ends.turn_b, spring.rest_b);
  const auto& [a, b] = flow.turns;
  const EndMoments moments{{axis_a, axis_b},
                           {across(axis_a, forces.moment_a + c2 * (2.0 * a + b)),
                            across(axis_b, forces.moment_b + c2 * (2.0 * b + a))},
                           spring.bending,
                           limits.moment.hardening};
  return {flow.stretch, turns_of(moments, bounds.moments, flow.turns),
          along(forces.torque + spring.twist * flow.twist, bounds.torque,
                spring.twist + limits.torque.hardening)};
}

QuatOf<double> after_turn(const QuatOf<double>& node, const QuatOf<double>& rest,
                          const Vec3& turn) noexcept {
  const QuatOf<double> frame = turned_numbers<double>(product(node, rest), turn, 1.0);
  return product(QuatOf<double>{-node.x, -node.y, -node.z, node.w}, frame);
}

/// Turns the state at rest of a beam on from one flow to a better one.
/// @returns N m, by about how much that changes the moments
double turn_rest(const BeamEndsOf<double>& ends, const Flow& from, const Flow& to,
                 BeamSpringOf<double>& spring) noexcept {
  const Vec3 axis = axis_of(ends.turn_b, spring.rest_b);
  const Vec3 turn_a = to.turns[0] - from.turns[0];
  const Vec3 turn_b = to.turns[1] - from.turns[1];
  const double twist = to.twist - from.twist;
  spring.rest_a = after_turn(ends.turn_a, spring.rest_a, turn_a);
  spring.rest_b = after_turn(ends.turn_b, spring.rest_b, turn_b - twist * axis);
  return 4.0 * spring.bending * (turn_a.norm() + turn_b.norm()) + spring.twist * std::abs(twist);
}

/// Whether bending and torsion keep their limits.
bool keeps(const Bounds& bounds, const BondForces& forces) noexcept {
  return forces.moment_a.norm() <= bounds.moments[0] &&
         forces.moment_b.norm() <= bounds.moments[1] && std::abs(forces.torque) <= bounds.torque;
}

/// Lets the ends turn and twist.
/// @param forces  where they are; then after the flow
void bend_and_twist(const BeamEndsOf<double>& ends, const BondLimits& limits, const Bounds& bounds,
                    BeamSpringOf<double>& spring, BondForces& forces, Flow& flow) noexcept {
  constexpr int kMost = 25;  // far more than needed below 45 degrees in one bond
  const double scale = forces.moment_a.norm() + forces.moment_b.norm() + std::abs(forces.torque);
  for (int i = 0; i < kMost; ++i) {
    Flow next = better_flow(ends, forces, flow, bounds, limits, spring);
    const double change = turn_rest(ends, flow, next, spring);
    flow = next;
    forces = bond_forces(spring, ends);
    if (change <= kPrecision * scale) return;
  }
}

Quat quat_of(const QuatOf<double>& q) noexcept {
  return {q.w, q.x, q.y, q.z};
}

/// Moments as the nodes see them, so that they turn with the beam.
BondForces with_nodes(BondForces forces, const BeamEndsOf<double>& ends) noexcept {
  forces.moment_a = quat_of(ends.turn_a).conjugate() * forces.moment_a;
  forces.moment_b = quat_of(ends.turn_b).conjugate() * forces.moment_b;
  return forces;
}

/// Adds up what a flow does and takes.
void remember(const BondForces& forces, const BeamEndsOf<double>& ends, const Flow& flow,
              BeamYield& memory) noexcept {
  const BondForces& before = memory.forces;
  const Vec3 moment_a = quat_of(ends.turn_a) * before.moment_a + forces.moment_a;
  const Vec3 moment_b = quat_of(ends.turn_b) * before.moment_b + forces.moment_b;
  memory.loss =
      0.5 * ((before.tension + forces.tension) * flow.stretch + moment_a.dot(flow.turns[0]) +
             moment_b.dot(flow.turns[1]) + (before.torque + forces.torque) * flow.twist);
  memory.dissipated += memory.loss;
  memory.stretch += std::abs(flow.stretch);
  memory.turn_a += flow.turns[0].norm();
  memory.turn_b += flow.turns[1].norm();
  memory.twist += std::abs(flow.twist);
}

}  // namespace

bool yield(const BeamEndsOf<double>& ends, const BondLimits& limits, BeamSpringOf<double>& spring,
           BeamYield& memory) noexcept {
  BondForces forces = bond_forces(spring, ends);
  const Bounds bounds{limits.tension.after(memory.stretch),
                      {limits.moment.after(memory.turn_a), limits.moment.after(memory.turn_b)},
                      limits.torque.after(memory.twist)};
  Flow flow;
  flow.stretch = along(forces.tension, bounds.tension, spring.axial + limits.tension.hardening);
  if (flow.stretch != 0.0) {
    spring.length += flow.stretch;
    forces.tension = spring.axial * (ends.chord.norm() - spring.length);
  }
  const bool bends = !keeps(bounds, forces);
  if (bends) bend_and_twist(ends, limits, bounds, spring, forces, flow);
  const bool flows = bends || flow.stretch != 0.0;
  memory.loss = 0.0;
  if (flows) remember(forces, ends, flow, memory);
  memory.forces = with_nodes(forces, ends);
  return flows;
}

bool is_broken(const BondLimits& limits, const BeamYield& memory) noexcept {
  const BondForces& forces = memory.forces;
  double stress = forces.tension / limits.area;
  double strain = memory.stretch / limits.length;
  if (limits.section_modulus > 0.0) {
    stress += std::max(forces.moment_a.norm(), forces.moment_b.norm()) / limits.section_modulus;
    strain += 2.0 * limits.radius * std::max(memory.turn_a, memory.turn_b) / limits.length;
  }
  double shear = 0.0;
  double shear_strain = 0.0;
  if (limits.torsion_modulus > 0.0) {
    shear = std::abs(forces.torque) / limits.torsion_modulus;
    shear_strain = limits.radius * memory.twist / (limits.length * std::numbers::sqrt3);
  }
  return stress > limits.strength || shear > limits.shear_strength ||
         std::max(strain, shear_strain) > limits.rupture_strain;
}

bool yield(double length, double at_first, const WireCurve& curve, BeamSpringOf<double>& spring,
           WireYield& memory) noexcept {
  const double strain = (length - at_first) / at_first;
  if (strain > curve.breaking_strain()) {
    memory.force = 0.0;
    return true;
  }
  const double elastic = spring.axial * (length - memory.rest_length);
  const double first = memory.force;
  if (elastic <= 0.0) {
    memory.force = 0.0;
    spring.length = length;
    return false;
  }
  memory.force = std::min(elastic, curve.force_at(strain));
  if (memory.force < elastic) {
    const double rest_length = length - memory.force / spring.axial;
    memory.dissipated += 0.5 * (first + memory.force) * (rest_length - memory.rest_length);
    memory.rest_length = rest_length;
  }
  spring.length = memory.rest_length;
  return false;
}

}  // namespace plekton::dynamics
