// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/loads/viscous_damping.hpp"

#include "dynamics/structure/beam_bonds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plekton::dynamics {
namespace {

std::vector<std::array<NodeId, 2>> nodes_of(const BeamDamping& damping,
                                            std::span<const BeamBond> bonds) {
  std::vector<std::array<NodeId, 2>> nodes;
  for (const std::size_t bond : damping.bonds) nodes.push_back(bonds[bond].nodes);
  return nodes;
}

/// N, of a dashpot along a bond that carries a tension already, positive as that.
double pull_of(double dashpot, double tension, double elongation_rate) {
  if (tension == 0.0) return 0.0;
  return std::max(dashpot * elongation_rate, -tension);
}

double stretching_stiffness(const BeamBond& bond) {
  return bond.section.young_modulus * bond.section.area / bond.length;
}

}  // namespace

double dashpot_of(const BeamBond& bond, double ratio, const NodeProperties& properties) {
  double lightness = 0.0;  // 1/kg
  for (const NodeId node : bond.nodes) {
    if (!holds_translation(properties.held[index_of(node)]))
      lightness += 1.0 / properties.mass[index_of(node)];
  }
  if (lightness == 0.0) return 0.0;
  return 2.0 * ratio * std::sqrt(stretching_stiffness(bond) / lightness);
}

DampedBeams::DampedBeams(const BeamDamping& damping, std::span<const BeamBond> bonds,
                         const NodeProperties& properties)
    : bonds_(damping.bonds),
      members_(nodes_of(damping, bonds)),
      nodes_(members_.nodes()),
      tensions_(damping.bonds.size(), std::numeric_limits<double>::infinity()),
      group_of_(bonds.size(), static_cast<std::uint32_t>(damping.bonds.size())),
      forces_(damping.bonds.size(), Vec3::Zero()) {
  for (const std::size_t bond : damping.bonds) {
    group_of_[bond] = static_cast<std::uint32_t>(dashpots_.size());
    dashpots_.push_back(dashpot_of(bonds[bond], damping.ratio, properties));
    relaxation_time_ =
        std::max(relaxation_time_, dashpots_.back() / stretching_stiffness(bonds[bond]));
  }
}

void DampedBeams::look_at(const YieldingBonds& bonds) noexcept {
  bonds.for_each_wire([&](std::size_t bond, const WireYield& wire) {
    if (group_of_[bond] < tensions_.size()) tensions_[group_of_[bond]] = wire.force;
  });
}

void DampedBeams::follow(const BeamBonds& bonds) {
  for (std::size_t i = 0; i < bonds_.size(); ++i) {
    if (bonds.is_broken(bonds_[i])) dashpots_[i] = 0.0;
  }
}

LoadedNodes& DampedBeams::act(const LoadStep&, const NodeState& state, geometry::ThreadPool& pool) {
  pool.for_each_range(forces_.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [a, b] = members_.groups()[i];
      const Vec3 chord = state.position[index_of(b)] - state.position[index_of(a)];
      const Vec3 velocity = state.velocity[index_of(b)] - state.velocity[index_of(a)];
      const double length = chord.norm();
      if (!(length > 0.0)) {
        forces_[i].setZero();
        continue;
      }
      const double pull = pull_of(dashpots_[i], tensions_[i], velocity.dot(chord) / length);
      forces_[i] = (-pull / length) * chord;
    }
  });
  nodes_.set(pool, [&](std::size_t i) {
    Vec3 force = Vec3::Zero();
    for (const auto& member : members_.of(i)) {
      if (member.place == 1)
        force += forces_[member.group];
      else
        force -= forces_[member.group];
    }
    return LoadedNodes::Force{force};
  });
  return nodes_;
}

DraggedNodes::DraggedNodes(const MassDamping& damping, const NodeProperties& properties)
    : rate_(damping.rate), nodes_(damping.nodes) {
  for (const NodeId node : damping.nodes) {
    mass_.push_back(properties.mass[index_of(node)]);
    inertia_.push_back(properties.inertia[index_of(node)]);
  }
}

LoadedNodes& DraggedNodes::act(const LoadStep&, const NodeState& state,
                               geometry::ThreadPool& pool) {
  nodes_.set(pool, [&](std::size_t i) {
    const std::size_t node = index_of(nodes_.node(i));
    return LoadedNodes::Force{-rate_ * mass_[i] * state.velocity[node],
                              -rate_ * inertia_[i] * state.angular_velocity[node]};
  });
  return nodes_;
}

// The positive root, by 1 / dt0², which may be 0.
double damped_step(double undamped, double of_damped, double relaxation_time,
                   double rate) noexcept {
  const double stiff = 1.0 / (undamped * undamped);
  const double slow = relaxation_time / (of_damped * of_damped) + 0.25 * rate;
  return 1.0 / (slow + std::sqrt(slow * slow + stiff));
}

}  // namespace plekton::dynamics
