// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/state/node_state.hpp"
#include "dynamics/state/rigid_nodes.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace plekton::geometry {
class StateArchive;
}

namespace plekton::dynamics {

/// Power iteration for the motion of nodes that forces resist most, of those that are a function of
/// places alone: the largest magnitude of an eigenvalue of M^(-1/2) H M^(-1/2), H their derivative,
/// by products with it from central differences. Of parts that have nothing to do with each other
/// one for each, at the cost of one.
///
/// It goes on with its last motion at the next look: few products are enough. It begins with more.
/// A rigid body takes part with its translation alone.
class StiffestMotion {
 public:
  /// @param rigid  rigid bodies among the nodes; must outlive this
  explicit StiffestMotion(const RigidNodes& rigid) : rigid_(&rigid) {}

  /// Products of a look that goes on with the motion of the last one.
  static constexpr int kProducts = 4;

  /// Where nodes are (m), and how far a difference goes (m).
  struct Places {
    geometry::Positions x;
    double difference;
  };

  /// Of nodes none of which takes part yet; all that come to are one part.
  void begin(std::size_t node_count) {
    takes_part_.assign(node_count, 0);
    part_.assign(node_count, 0);
    part_count_ = 1;
  }
  void add(std::size_t node) noexcept { takes_part_[node] = 1; }
  void set_part(std::size_t node, std::uint32_t part) noexcept { part_[node] = part; }
  std::uint32_t part(std::size_t node) const noexcept { return part_[node]; }
  void set_part_count(std::uint32_t count) noexcept { part_count_ = count; }
  bool has(std::size_t node) const noexcept { return takes_part_[node] != 0; }

  /// The next look begins with a motion of its own.
  void forget() noexcept {
    is_new_ = true;
    rates_.clear();
  }

  /// @param next  products to take where the motion is that of a look before
  /// @returns how many products to take
  int start(const NodeProperties& properties, int next = kProducts);
  /// The product of the motion with the derivative.
  /// @param forces_of  (places, forces): adds the forces (N)
  /// @returns whether anything moves
  template <class Forces>
  bool multiply(const NodeProperties& properties, const Places& places, const Forces& forces_of) {
    if (!find_steps(properties, places.difference)) return false;
    for (const double sign : {1.0, -1.0}) {
      displace(properties, places.x, sign);
      forces_.set_zero();
      forces_of(geometry::Positions(moved_), forces_);
      take_forces(-0.5 * sign);
    }
    return true;
  }
  /// m per root of kg, of length 1 in each part.
  const Vec3& operator[](std::size_t node) const noexcept { return motion_[node]; }
  /// Adds to the product (N).
  void add_to_product(std::size_t node, const Vec3& force) noexcept { product_[node] += force; }
  /// Goes on to the product, which also takes in what it moves.
  void follow(const NodeProperties& properties);
  /// 1/s², the largest eigenvalue of any part as it was found at the last look.
  double largest_rate() const noexcept {
    return rates_.empty() ? 0.0 : *std::max_element(rates_.begin(), rates_.end());
  }
  /// 1/s², the eigenvalue as it was found for the part of a node.
  double rate(std::size_t node) const noexcept { return rates_[part_[node]]; }

  void exchange(const geometry::StateArchive& archive);

 private:
  bool find_steps(const NodeProperties& properties, double difference);
  void displace(const NodeProperties& properties, geometry::Positions x, double sign);
  void take_forces(double factor);

  const RigidNodes* rigid_;
  NodeForces forces_{0};
  std::uint32_t part_count_ = 1;
  std::vector<char> takes_part_;     ///< by node
  std::vector<std::uint32_t> part_;  ///< by node
  std::vector<double> steps_;  ///< m sqrt(kg), by part: how much of the motion a difference is
  std::vector<double> rates_;  ///< 1/s², by part
  std::vector<double> sums_;   ///< by part, working space
  std::vector<Vec3> motion_;   ///< by node
  std::vector<Vec3> product_;  ///< N/m of a motion
  std::vector<Vec3> moved_;    ///< m
  bool is_new_ = true;         ///< the motion is that of no look before
};

/// 1/sqrt(kg); 0 of a node that is held.
double per_root_of_mass(const NodeProperties& properties, std::size_t node) noexcept;

}  // namespace plekton::dynamics
