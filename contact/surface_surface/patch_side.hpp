// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "contact/tracking/contact_state.hpp"
#include "geometry/base/state_archive.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace plekton::contact::structure {

/// The nodes of one side of a patch, each with the elastic force on it, with what attracts it, and
/// with its share of the patch's elastic force. No share is negative; they add up to 1.
class PatchSide {
 public:
  void clear() noexcept { nodes_.clear(); }
  /// Any number of times each, before sort().
  void add(NodeId node) { nodes_.push_back(node); }
  void sort() {
    std::sort(nodes_.begin(), nodes_.end());
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
    shares_.assign(nodes_.size(), 0.0);
  }
  /// Of a node that was added.
  std::uint32_t place_of(NodeId node) const {
    const auto found = std::lower_bound(nodes_.begin(), nodes_.end(), node);
    return static_cast<std::uint32_t>(found - nodes_.begin());
  }

  void reset_forces() {
    forces_.assign(nodes_.size(), Vec3::Zero());
    attractions_.assign(nodes_.size(), Vec3::Zero());
  }
  void add_force(std::uint32_t place, const Vec3& force) noexcept { forces_[place] += force; }
  void add_attraction(std::uint32_t place, const Vec3& force) noexcept {
    attractions_[place] += force;
  }
  /// Of what add_force() has added up.
  Vec3 total_force() const {
    Vec3 total = Vec3::Zero();
    for (const Vec3& force : forces_) total += force;
    return total;
  }

  /// N, sum of the sizes of the same.
  double size_of_forces() const {
    double size = 0.0;
    for (const Vec3& force : forces_) size += force.norm();
    return size;
  }

  Vec3 total_attraction() const {
    Vec3 total = Vec3::Zero();
    for (const Vec3& force : attractions_) total += force;
    return total;
  }

  /// Finds the shares, and the point on which the force acts: among the nodes, also where forces
  /// cancel for the most part, as those of bodies that cross.
  /// @param per_force  1/N, the total force over its square: a share is that of the force along it,
  ///                   and 0 of one against it
  void find_shares(Positions x, const Vec3& per_force) {
    point_ = Vec3::Zero();
    const Vec3 origin = nodes_.empty() ? Vec3(Vec3::Zero()) : x[index_of(nodes_[0])];
    double sum = 0.0;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      shares_[i] = std::max(0.0, per_force.dot(forces_[i]));
      point_ += shares_[i] * (x[index_of(nodes_[i])] - origin);
      sum += shares_[i];
    }
    for (double& share : shares_) share /= sum;
    point_ = origin + point_ / sum;
  }

  /// What add_force() and add_attraction() have added up, on the nodes.
  void add_normal_forces(NodeForces& forces) const {
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      forces.force[index_of(nodes_[i])] += forces_[i] + attractions_[i];
  }

  /// N m, of the same.
  Vec3 moment_about(const Vec3& about, Positions x) const {
    Vec3 moment = Vec3::Zero();
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      moment += (x[index_of(nodes_[i])] - about).cross(forces_[i] + attractions_[i]);
    return moment;
  }

  /// m, weighted mean of the nodes.
  const Vec3& point() const noexcept { return point_; }

  /// Velocity (m/s) of the material point at a lever (m) from point().
  Vec3 velocity_at(const Vec3& lever, const Motion& motion) const {
    Vec3 velocity = Vec3::Zero();
    for_each_share([&](NodeId node, double share) {
      const std::size_t i = index_of(node);
      velocity += share * (motion.velocity[i] + motion.angular_velocity[i].cross(lever));
    });
    return velocity;
  }
  Vec3 angular_velocity(const Motion& motion) const {
    Vec3 spin = Vec3::Zero();
    for_each_share([&](NodeId node, double share) {
      spin += share * motion.angular_velocity[index_of(node)];
    });
    return spin;
  }

  /// Transpose of velocity_at.
  void add_force_at(const Vec3& lever, const Vec3& force, NodeForces& forces) const {
    const Vec3 torque = lever.cross(force);
    for_each_share([&](NodeId node, double share) {
      forces.force[index_of(node)] += share * force;
      forces.torque[index_of(node)] += share * torque;
    });
  }

  /// Transpose of angular_velocity.
  void add_moment(const Vec3& moment, NodeForces& forces) const {
    for_each_share(
        [&](NodeId node, double share) { forces.torque[index_of(node)] += share * moment; });
  }

  template <class Visit>
  void for_each_share(Visit&& visit) const {
    for (std::size_t i = 0; i < nodes_.size(); ++i) visit(nodes_[i], shares_[i]);
  }

  void exchange(geometry::RowFields& row, const std::string& name,
                const geometry::Surface& surface) {
    row(name + "_nodes", nodes_);
    row.require(has_nodes(surface, nodes_), name + "_nodes");
    row(name + "_forces", forces_);
    row(name + "_attractions", attractions_);
    row(name + "_shares", shares_);
    row(name + "_point", point_);
    if (forces_.size() != nodes_.size() || attractions_.size() != nodes_.size() ||
        shares_.size() != nodes_.size())
      throw geometry::StateMismatch("a contact between structures in the state is damaged");
  }

 private:
  std::vector<NodeId> nodes_;      ///< ascending
  std::vector<Vec3> forces_;       ///< N
  std::vector<Vec3> attractions_;  ///< N
  std::vector<double> shares_;
  Vec3 point_ = Vec3::Zero();
};

}  // namespace plekton::contact::structure
