// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/model/scene.hpp"
#include "dynamics/stiffness/nodal_stiffness.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace plekton::geometry {
class StateArchive;
}

namespace plekton::dynamics {

/// The ties of a scene in motion (Tie).
///
/// A tie pulls its node with F towards the point to which it is tied, and the nodes of that point
/// with -F by their weights, along the line between both: so forces and moments on both sides are
/// opposite to rounding. Without friction the point on a cable is the nearest one to the node: the
/// energy 1/2 k e² is a function of positions alone and its gradient the forces, so that sliding
/// does no work. With friction the point stays until the force along the cable is above what
/// friction holds, then slides until it is not.
///
/// What slides or is paid out takes the mean of the force before and after times the way, which
/// with the leapfrog's energies closes the ledger; what breaks takes what it had stored.
///
/// Linear in the number of ties, one after the other; no allocation but where elements are gone.
class Ties {
 public:
  /// @param scene  checked
  explicit Ties(const Scene& scene);

  bool empty() const noexcept { return ties_.empty(); }
  std::size_t size() const noexcept { return ties_.size(); }
  const Tie& tie(std::size_t i) const noexcept { return ties_[i]; }

  /// Lets every tie slide, pay out and break where the nodes are (m), and finds its force.
  void advance(geometry::Positions x);
  /// Adds the forces of the last advance.
  void add_forces(NodeForces& forces) const;
  /// Calls visit(place (m), force on it (N)) for each fixed point that a tie of the last advance
  /// holds on to.
  template <class Visit>
  void for_each_on_fixed_point(const Visit& visit) const {
    for (std::size_t i = 0; i < ties_.size(); ++i) {
      const auto* const fixed = std::get_if<FixedPoint>(&ties_[i].to);
      if (fixed != nullptr && !kept_[i].is_broken) visit(fixed->place, Vec3(-forces_[i]));
    }
  }
  /// Adds those that there would be at other positions (m) if nothing slid, yielded or broke.
  void add_forces_at(geometry::Positions x, NodeForces& forces) const;

  /// Goes on with the elements that are left: what is tied to another one breaks in the next
  /// advance, and cables end where they are torn.
  void follow(const geometry::Elements& left);

  /// m, from where it is tied to its node.
  Vec3 way(std::size_t i, geometry::Positions x) const noexcept;
  /// m/s, how that changes.
  /// @param v  m/s, of the nodes
  Vec3 motion(std::size_t i, std::span<const Vec3> v) const noexcept;

  /// N, tension in the last advance; below 0: it pushes.
  double pull(std::size_t i) const noexcept { return kept_[i].pull; }
  bool is_broken(std::size_t i) const noexcept { return kept_[i].is_broken; }
  /// m, how far it has slid along its cable, whichever way; or what its brake has paid out.
  double slip(std::size_t i) const noexcept { return kept_[i].slip; }
  /// J
  double elastic_energy(std::size_t i) const noexcept { return kept_[i].elastic; }
  /// J, taken by friction, by its brake and as it broke, less what was forgotten.
  double dissipated(std::size_t i) const noexcept { return kept_[i].dissipated; }

  double elastic_energy() const noexcept;  ///< J, of all
  double dissipated() const noexcept;      ///< J, of all
  std::size_t broken() const noexcept;     ///< how many

  /// Counts from here: what happens before the start of a simulation is in its initial energy.
  void forget_dissipated() noexcept;

  /// Adds the stiffness of all ties, or of one.
  void add_to(NodalStiffness& stiffness) const;
  void add_to(NodalStiffness& stiffness, std::size_t i) const;
  /// Adds a spring between the node of a tie and its point.
  template <class Springs>
  void add_spring(std::size_t i, const ContactStiffness& spring, Springs& springs) const {
    if (std::holds_alternative<FixedPoint>(ties_[i].to))
      return springs.add_to_wall(ties_[i].node, spring);
    const auto& [nodes, weights] = points_[i];
    springs.add_on_surface(ties_[i].node, {nodes, weights, geometry::Feature(nodes[0])}, spring);
  }
  /// Calls visit(node) for each node that a tie acts on.
  template <class Visit>
  void for_each_node(std::size_t i, const Visit& visit) const {
    visit(ties_[i].node);
    for (int k = 0; k < 3; ++k)
      if (points_[i].weights[k] > 0.0) visit(points_[i].nodes[static_cast<std::size_t>(k)]);
  }

  /// What ties remember. @throws geometry::StateMismatch
  void exchange(const geometry::StateArchive& archive);

 private:
  /// What a tie remembers.
  struct Kept {
    bool is_broken = false;
    bool is_lost = false;      ///< breaks in the next advance: the element it was tied to is gone
    std::size_t segment = 0;   ///< of its cable
    double along = 0.0;        ///< part of that
    double slip = 0.0;         ///< m
    double pull = 0.0;         ///< N, of the last advance
    double along_cable = 0.0;  ///< N, of the last advance, on the cable, forwards
    double elastic = 0.0;      ///< J
    double dissipated = 0.0;   ///< J
  };

  void advance(std::size_t i, geometry::Positions x);
  void slide(std::size_t i, const CablePlace& on, geometry::Positions x);
  void set_point(std::size_t i, const CablePlace& on);
  double pay_out(const Tie& tie, Kept& kept, double stretch) const noexcept;
  Vec3 beside_point(std::size_t i, std::span<const Vec3> of_nodes) const noexcept;
  double stretch(std::size_t i, double distance) const noexcept;
  void add_force(std::size_t i, const Vec3& force, NodeForces& forces) const;

  std::vector<Cable> cables_;
  std::vector<std::vector<char>> is_there_;    // by cable and segment
  std::vector<std::vector<char>> is_carried_;  // likewise: there is an element that may go
  std::vector<Tie> ties_;
  std::vector<char> is_on_element_;    // by tie
  std::vector<Kept> kept_;             // by tie
  std::vector<MaterialPoint> points_;  // by tie, of the last advance
  std::vector<Vec3> forces_;           // N, by tie, on its node
};

}  // namespace plekton::dynamics
