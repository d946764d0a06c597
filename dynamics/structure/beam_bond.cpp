// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/beam_bond.hpp"

#include "geometry/problems.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <ostream>
#include <sstream>
#include <string>

namespace plekton::dynamics {
namespace {

/// First column of the rotation matrix of a unit quaternion.
Vec3 x_axis(const Quat& q) noexcept {
  return {1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z()), 2.0 * (q.x() * q.y() + q.w() * q.z()),
          2.0 * (q.x() * q.z() - q.w() * q.y())};
}

/// The shortest rotation from the x axis to a chord; half a turn about z where they are opposite.
///
/// For a unit direction (x, y, z) it is (1 + x, 0, -z, y), normalised. Next to x = -1 the sum
/// cancels, so there it is taken from 1 + x = r² / (1 - x) with r² = y² + z², and all is divided by
/// r.
Quat frame_along(const Vec3& chord) {
  const Vec3 direction = chord.stableNormalized();
  const double x = direction[0], y = direction[1], z = direction[2];
  if (x >= 0.0) return Quat(1.0 + x, 0.0, -z, y).normalized();
  const double r = std::hypot(y, z);
  if (r == 0.0) return {0.0, 0.0, 0.0, 1.0};
  return Quat(r / (1.0 - x), 0.0, -z / r, y / r).normalized();
}

/// One quantity of a bond that has to be finite and above (or at) zero.
struct Quantity {
  const char* name;
  double value;
  const char* unit;
  bool may_be_zero;
};

void list_quantities(const BeamBond& bond, const std::string& where, std::ostream& problems) {
  const BeamSection& section = bond.section;
  const std::array<Quantity, 6> quantities{{
      {"length at rest", bond.length, " m", false},
      {"Young's modulus", section.young_modulus, " Pa", false},
      {"shear modulus", section.shear_modulus, " Pa", false},
      {"area", section.area, " m2", false},
      {"second moment", section.second_moment, " m4", true},
      {"torsion constant", section.torsion_constant, " m4", true},
  }};
  for (const Quantity& q : quantities) {
    const bool is_good = std::isfinite(q.value) && (q.may_be_zero ? q.value >= 0.0 : q.value > 0.0);
    if (is_good) continue;
    problems << where << ": " << q.name << " is " << q.value << q.unit << "; it must be "
             << (q.may_be_zero ? "zero or positive" : "positive") << " and finite\n";
  }
}

}  // namespace

BeamSection circular_section(double radius, double young_modulus, double poisson_ratio) noexcept {
  const double area = std::numbers::pi * radius * radius;
  const double second_moment = 0.25 * area * radius * radius;
  return {young_modulus, 0.5 * young_modulus / (1.0 + poisson_ratio), area, second_moment,
          2.0 * second_moment};
}

void list_problems(const BeamBond& bond, std::size_t node_count, std::string_view name,
                   std::ostream& problems) {
  const auto a = static_cast<std::int32_t>(bond.nodes[0]);
  const auto b = static_cast<std::int32_t>(bond.nodes[1]);
  std::ostringstream prefix;
  prefix << name << " (nodes " << a << ", " << b << ")";
  const std::string where = prefix.str();
  for (const std::int32_t node : {a, b}) {
    if (node >= 0 && static_cast<std::size_t>(node) < node_count) continue;
    problems << where << ": there is no node " << node << ", only " << node_count << " nodes\n";
  }
  if (a == b) problems << where << ": both ends are the same node; delete the bond\n";
  list_quantities(bond, where, problems);
  for (const Quat& rest : {bond.rest_a, bond.rest_b}) {
    constexpr double kTolerance = 1e-9;  // far above rounding, far below any real mistake
    if (std::abs(rest.squaredNorm() - 1.0) < kTolerance) continue;
    problems << where << ": its rotation at rest is not a unit quaternion; normalise it\n";
  }
}

BeamBond make_beam(NodeId a, NodeId b, const NodeState& at_rest, const BeamSection& section) {
  std::ostringstream problems;
  BeamBond bond{{a, b}, 1.0, section, Quat::Identity(), Quat::Identity()};
  list_problems(bond, at_rest.size(), "beam", problems);
  geometry::throw_if_any(problems);

  const Vec3 chord = at_rest.position[index_of(b)] - at_rest.position[index_of(a)];
  const Quat frame = frame_along(chord);
  bond.length = chord.norm();
  bond.rest_a = at_rest.orientation[index_of(a)].conjugate() * frame;
  bond.rest_b = at_rest.orientation[index_of(b)].conjugate() * frame;
  list_problems(bond, at_rest.size(), "beam", problems);
  geometry::throw_if_any(problems);
  return bond;
}

BeamBonds::BeamBonds(std::span<const BeamBond> bonds, std::size_t node_count) {
  std::ostringstream problems;
  for (std::size_t i = 0; i < bonds.size(); ++i) {
    list_problems(bonds[i], node_count, "bond " + std::to_string(i), problems);
  }
  geometry::throw_if_any(problems);

  springs_.reserve(bonds.size());
  for (const BeamBond& bond : bonds) {
    const BeamSection& s = bond.section;
    springs_.push_back({bond.nodes, bond.length, s.young_modulus * s.area / bond.length,
                        s.young_modulus * s.second_moment / bond.length,
                        s.shear_modulus * s.torsion_constant / bond.length, bond.rest_a,
                        bond.rest_b});
  }
  reactions_.resize(springs_.size());
  build_ends(node_count);
}

void BeamBonds::build_ends(std::size_t node_count) {
  std::vector<std::uint32_t> next(node_count + 1, 0);
  for (const Spring& spring : springs_) {
    for (const NodeId node : spring.nodes) ++next[index_of(node) + 1];
  }
  start_.push_back(0);
  for (std::size_t n = 0; n < node_count; ++n) {
    if (next[n + 1] == 0) continue;
    nodes_.push_back(geometry::id_at<NodeId>(n));
    start_.push_back(start_.back() + next[n + 1]);
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  ends_.resize(2 * springs_.size());
  for (std::size_t i = 0; i < springs_.size(); ++i) {
    for (std::size_t side = 0; side < 2; ++side) {
      ends_[next[index_of(springs_[i].nodes[side])]++] = static_cast<std::uint32_t>(2 * i + side);
    }
  }
}

BeamBonds::Reaction BeamBonds::reaction_of(const Spring& spring, const NodeState& state) noexcept {
  const std::size_t node_a = index_of(spring.nodes[0]);
  const std::size_t node_b = index_of(spring.nodes[1]);
  const Quat frame_a = state.orientation[node_a] * spring.rest_a;
  const Quat frame_b = state.orientation[node_b] * spring.rest_b;
  const Vec3 a = x_axis(frame_a);
  const Vec3 b = x_axis(frame_b);
  const Vec3 chord = state.position[node_b] - state.position[node_a];
  const double length = chord.norm();
  const Vec3 n = length > 0.0 ? Vec3((1.0 / length) * chord) : (a + b).normalized();

  // Differences first: small rotations then lose no digits to cancellation.
  const Vec3 bend_a = a - n;
  const Vec3 bend_b = b - n;
  const Vec3 bend = bend_a + bend_b;
  const double opening = 0.5 * (a - b).squaredNorm();
  const double elongation = length - spring.length;
  const double moment = 6.0 * spring.bending;
  const double shear = length > 0.0 ? moment / length : 0.0;

  // The quaternion from frame a to frame b is (w, x, y, z) in frame a. Turning b by g (in frame a)
  // changes x by 1/2 g.(w, z, -y), so the torque of U_t(x) on b is -1/2 U_t' (w, z, -y).
  const Quat between = frame_a.conjugate() * frame_b;
  const double x = between.x();
  const Vec3 gradient = frame_a * Vec3(between.w(), between.z(), -between.y());
  const Vec3 twist = (spring.twist * (2.0 + 4.0 / 3.0 * x * x) * x) * gradient;
  const Vec3 relative = (spring.bending * (2.0 + 5.0 / 12.0 * opening)) * a.cross(b) - twist;

  Reaction reaction;
  reaction.tension = spring.axial * elongation;
  reaction.force = shear * (bend - bend.dot(n) * n) - reaction.tension * n;
  reaction.torque_a = moment * bend_a.cross(n) - relative;
  reaction.torque_b = moment * bend_b.cross(n) + relative;
  const double bend_energy =
      2.0 * (bend_a.squaredNorm() + bend_a.dot(bend_b) + bend_b.squaredNorm()) -
      5.0 / 24.0 * opening * opening;
  reaction.energy = 0.5 * reaction.tension * elongation + spring.bending * bend_energy +
                    spring.twist * (2.0 + 2.0 / 3.0 * x * x) * x * x;
  return reaction;
}

void BeamBonds::advance(const NodeState& state, geometry::ThreadPool& pool) {
  pool.for_each_range(springs_.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) reactions_[i] = reaction_of(springs_[i], state);
  });
}

void BeamBonds::add_forces(NodeForces& forces, geometry::ThreadPool& pool) const {
  pool.for_each_range(nodes_.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      Vec3& force = forces.force[index_of(nodes_[i])];
      Vec3& torque = forces.torque[index_of(nodes_[i])];
      for (std::uint32_t k = start_[i]; k < start_[i + 1]; ++k) {
        const Reaction& reaction = reactions_[ends_[k] / 2];
        const bool at_b = ends_[k] % 2 == 1;
        force += (at_b ? 1.0 : -1.0) * reaction.force;
        torque += at_b ? reaction.torque_b : reaction.torque_a;
      }
    }
  });
}

double BeamBonds::elastic_energy() const noexcept {
  double energy = 0.0;
  for (const Reaction& reaction : reactions_) energy += reaction.energy;
  return energy;
}

}  // namespace plekton::dynamics
