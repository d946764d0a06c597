// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/loads/load_step.hpp"
#include "dynamics/loads/loaded_nodes.hpp"
#include "dynamics/model/loads.hpp"

namespace plekton::dynamics {

/// Forces and torques that follow a table.
class ForcedNodes {
 public:
  explicit ForcedNodes(const NodalForce& load) : load_(load), nodes_(load.nodes) {}

  LoadedNodes& act(const LoadStep& step, const NodeState&, geometry::ThreadPool& pool) {
    const double factor = load_.factor.at(step.time);
    const LoadedNodes::Force force{factor * load_.force, factor * load_.torque};
    nodes_.set(pool, [&](std::size_t) { return force; });
    return nodes_;
  }
  LoadedNodes& nodes() noexcept { return nodes_; }

  /// From the next step on. @param force, torque  N and N m, times the factor
  void set(const Vec3& force, const Vec3& torque) noexcept {
    load_.force = force;
    load_.torque = torque;
    is_set_ = true;
  }
  /// Whether set() has been called.
  bool is_set() const noexcept { return is_set_; }
  /// N, times the factor
  const Vec3& force() const noexcept { return load_.force; }
  /// N m, times the factor
  const Vec3& torque() const noexcept { return load_.torque; }

 private:
  NodalForce load_;
  LoadedNodes nodes_;
  bool is_set_ = false;
};

}  // namespace plekton::dynamics
