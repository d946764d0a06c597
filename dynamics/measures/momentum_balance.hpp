// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contacts.hpp"
#include "dynamics/measures/force_and_moment.hpp"
#include "dynamics/state/node_state.hpp"
#include "dynamics/ties/ties.hpp"
#include "geometry/base/orderless_sum.hpp"
#include "geometry/base/parallel_sum.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace plekton::geometry {
class StateArchive;
}

namespace plekton::dynamics {

/// What bodies did to each other in a step: contacts, bonds, sheets and ties, before loads are added.
struct InnerForces {
  geometry::Positions position;  ///< m, of the nodes
  const NodeForces& forces;      ///< on all nodes, also those that are held
  const contact::Contacts& contacts;
  std::span<const contact::Plane> planes;  ///< where they were in that step
  const Ties& ties;
  double carried = 0.0;  ///< N, how much bodies carry, also where it cancels at each node
  double kick = 0.0;     ///< s, for how long the forces act
  contact::SharedMotion* shared = nullptr;  ///< of ranks that each know some of the nodes
};

/// Momentum that the forces between bodies make from nothing, over what they carry.
struct MomentumDrift {
  double linear = 0.0;
  double angular = 0.0;
};

/// Whether a scene keeps the balance of linear and angular momentum.
///
/// The momentum p of a scene changes by the impulse J of what acts from outside (weight, loads,
/// planes, what holds nodes) and by nothing else. As all nodes are stepped by the sum of their
/// forces, p - p0 - J is the impulse of the forces between bodies, on free and on held nodes, plus
/// that of contacts on the planes, told by the planes, and of ties on fixed points: by Newton's
/// third law 0 but for rounding. It is added up over the steps that are looked at, with the angular
/// one about the middle of the scene; so is what they carry, the sum of magnitudes.
///
/// Linear in the nodes and planes. The same bits for any number of threads and ranks.
class MomentumBalance {
 public:
  /// So seldom that it costs nothing that could be measured.
  static constexpr std::int64_t kStepsBetweenLooks = 16;
  static bool is_due(std::int64_t steps) noexcept { return steps % kStepsBetweenLooks == 0; }

  MomentumBalance() = default;
  /// @param start  m, where the nodes are
  explicit MomentumBalance(geometry::Positions start) noexcept;

  /// Adds a step.
  void look(const InnerForces& inner, geometry::ThreadPool& pool);

  /// The largest so far; 0 as long as nothing has acted.
  MomentumDrift drift() const noexcept;

  void exchange(const geometry::StateArchive& archive);

 private:
  /// Of some nodes, to be put together in any order.
  struct NodeSums {
    enum Part { force = 0, moment = 3, of_forces = 6, of_moments = 7 };  ///< the last of magnitudes

    std::array<geometry::OrderlessSum, 8> parts;  ///< N and N m
    double reach = 0.0;  ///< m, from the middle to the furthest node that a force acts on

    NodeSums& operator+=(const NodeSums& other) noexcept;
    geometry::Vec3 vector(Part first) const noexcept;
  };

  /// Of all looks.
  struct Sums {
    geometry::Vec3 about = geometry::Vec3::Zero();    ///< m, point of the moments
    geometry::Vec3 linear = geometry::Vec3::Zero();   ///< N s
    geometry::Vec3 angular = geometry::Vec3::Zero();  ///< N m s
    double most_linear = 0.0;                         ///< N s, the largest magnitude so far
    double most_angular = 0.0;                        ///< N m s, likewise
    double carried_linear = 0.0;                      ///< N s, of magnitudes
    double carried_angular = 0.0;                     ///< N m s, likewise
  };

  template <class NodeAt>
  NodeSums sum_of(const InnerForces& inner, const NodeAt& node_at, std::size_t count) const;
  NodeSums node_sums(const InnerForces& inner, geometry::ThreadPool& pool);

  Sums sums_;
  geometry::ParallelSum<NodeSums> sum_;
};

}  // namespace plekton::dynamics
