// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/thread_pool.hpp"
#include "geometry/base/types.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <span>
#include <vector>

namespace plekton::contact {

using geometry::index_of;
using geometry::Mat3;
using geometry::NodeId;
using geometry::Positions;
using geometry::Vec3;

/// Where the nodes are and how they move; the only thing contacts know of the state. Views of equal
/// length.
struct Motion {
  Positions position;                      ///< m
  std::span<const Vec3> velocity;          ///< m/s
  std::span<const Vec3> angular_velocity;  ///< rad/s
  /// m, how far any node has moved at most since the last step, if that is known.
  double max_displacement = std::numeric_limits<double>::infinity();
};

/// Forces (N) and torques (N m) that act on the nodes.
struct NodeForces {
  std::vector<Vec3> force;
  std::vector<Vec3> torque;

  explicit NodeForces(std::size_t node_count = 0)
      : force(node_count, Vec3::Zero()), torque(node_count, Vec3::Zero()) {}

  void set_zero() { set_zero(0, force.size()); }
  /// Of nodes [begin, end).
  void set_zero(std::size_t begin, std::size_t end) {
    std::fill_n(force.data() + begin, end - begin, Vec3::Zero());
    std::fill_n(torque.data() + begin, end - begin, Vec3::Zero());
  }
};

}  // namespace plekton::contact
