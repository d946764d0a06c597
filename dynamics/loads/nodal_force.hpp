// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/loads/load_step.hpp"
#include "dynamics/loads/loaded_nodes.hpp"
#include "dynamics/model/loads.hpp"
#include "geometry/base/state_archive.hpp"

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
  }
  /// What set() may have changed. @throws geometry::StateMismatch
  void exchange(const geometry::StateArchive& archive) {
    archive("force", load_.force);
    archive("torque", load_.torque);
    archive.require(load_.force.allFinite(), "force");
    archive.require(load_.torque.allFinite(), "torque");
  }

 private:
  NodalForce load_;
  LoadedNodes nodes_;
};

}  // namespace plekton::dynamics
