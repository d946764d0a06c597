// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/motion.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace plekton::contact::structure {

/// The nodes of one side of a patch, each with its share of the patch's force. A share may be
/// negative; the shares add up to 1.
class PatchSide {
 public:
  static constexpr std::uint32_t kNowhere = std::numeric_limits<std::uint32_t>::max();

  void clear() noexcept { shares_.clear(); }
  void add(NodeId node, double share) { shares_.emplace_back(node, share); }

  /// Adds up what each node was given; finds the point on which the force acts.
  /// @param places  by NodeId, all kNowhere; so they are again afterwards
  void finish(Positions x, std::span<std::uint32_t> places) {
    std::uint32_t kept = 0;
    for (std::size_t i = 0; i < shares_.size(); ++i) {
      std::uint32_t& place = places[index_of(shares_[i].first)];
      if (place == kNowhere) {
        place = kept;
        shares_[kept++] = shares_[i];
      } else {
        shares_[place].second += shares_[i].second;
      }
    }
    shares_.resize(kept);
    for (const auto& entry : shares_) places[index_of(entry.first)] = kNowhere;
    std::sort(shares_.begin(), shares_.end(),
              [](const auto& p, const auto& q) { return p.first < q.first; });
    point_ = Vec3::Zero();
    const Vec3 origin = shares_.empty() ? Vec3(Vec3::Zero()) : x[index_of(shares_[0].first)];
    double sum = 0.0;
    for (const auto& [node, share] : shares_) {
      point_ += share * (x[index_of(node)] - origin);
      sum += share;
    }
    for (auto& entry : shares_) entry.second /= sum;
    point_ = origin + point_ / sum;
  }

  /// m, weighted mean of the nodes.
  const Vec3& point() const noexcept { return point_; }

  /// Velocity (m/s) of the material point at a lever (m) from point().
  Vec3 velocity_at(const Vec3& lever, const Motion& motion) const {
    Vec3 velocity = Vec3::Zero();
    for (const auto& [node, share] : shares_) {
      const std::size_t i = index_of(node);
      velocity += share * (motion.velocity[i] + motion.angular_velocity[i].cross(lever));
    }
    return velocity;
  }
  Vec3 angular_velocity(const Motion& motion) const {
    Vec3 spin = Vec3::Zero();
    for (const auto& [node, share] : shares_)
      spin += share * motion.angular_velocity[index_of(node)];
    return spin;
  }

  /// Transpose of velocity_at.
  void add_force_at(const Vec3& lever, const Vec3& force, NodeForces& forces) const {
    const Vec3 torque = lever.cross(force);
    for (const auto& [node, share] : shares_) {
      forces.force[index_of(node)] += share * force;
      forces.torque[index_of(node)] += share * torque;
    }
  }

  template <class Visit>
  void for_each_share(Visit&& visit) const {
    for (const auto& [node, share] : shares_) visit(node, share);
  }

 private:
  std::vector<std::pair<NodeId, double>> shares_;
  Vec3 point_ = Vec3::Zero();
};

}  // namespace plekton::contact::structure
