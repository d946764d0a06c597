// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/loads/load_step.hpp"
#include "dynamics/loads/loaded_nodes.hpp"
#include "dynamics/loads/node_members.hpp"
#include "dynamics/model/loads.hpp"
#include "geometry/primitives/facet.hpp"
#include "geometry/primitives/surface_change.hpp"

#include <span>

namespace plekton::geometry {
class StateArchive;
}

namespace plekton::dynamics {

/// m³, under facets and over the first corner of the first: what they enclose if they are closed
/// and face outward. 0 without facets.
double volume_under(std::span<const std::array<NodeId, 3>> facets, geometry::Positions x);

/// m², a third of the area of a facet along its normal: times a pressure it is the force on each
/// corner.
Vec3 area_share(const std::array<NodeId, 3>& facet, geometry::Positions x) noexcept;

/// Facets under pressure. With A = (x1 - x0) x (x2 - x0) / 2 the force on each corner is p A / 3.
///
/// The volume over any point o is V = sum (x0 - o).((x1 - o) x (x2 - o)) / 6, and dV/dx of a corner
/// is the sum of (x1 - o) x (x2 - o) / 6 over its facets. For a fan that is closed around the
/// corner this is the sum of A / 3, so on a closed surface the force is p dV/dx: its work is the
/// integral of p dV, and its resultant and moment vanish, since V does not change when the surface
/// is moved or turned. At a rim it is the share of linear shape functions in the follower load p A.
class PressedSurface {
 public:
  /// @param facets  of the surface; load names some of them
  PressedSurface(const SurfacePressure& load, std::span<const geometry::Facet> facets,
                 const NodeState& at_start);

  LoadedNodes& act(const LoadStep& step, const NodeState& state, geometry::ThreadPool& pool);
  LoadedNodes& nodes() noexcept { return nodes_; }

  /// Goes on with the facets that are left. A gas escapes through the first hole: from then on
  /// there is no pressure.
  void follow(const geometry::SurfaceChange& change);

  /// What the last act found.
  void exchange(const geometry::StateArchive& archive);

  /// From the next step on. @param pressure  Pa, times the factor; over the outside of a gas at the
  ///                                         volume of the start
  void set(double pressure) noexcept {
    load_.pressure = pressure;
    is_set_ = true;
  }
  /// Whether set() has been called.
  bool is_set() const noexcept { return is_set_; }
  /// Pa, times the factor
  double full_pressure() const noexcept { return load_.pressure; }

  /// m³, at the last act; only where the pressure follows it.
  double volume() const noexcept { return volume_; }
  /// Pa, at the last act.
  double pressure() const noexcept { return pressure_; }

  /// Stiffness (N/m) that is not below what the turning facets add around a node: with p e x dx / 6
  /// on a corner for each of the others, e the side across, a facet adds at most p (sum of its
  /// sides) / 6 to each of its corners.
  /// @param add  add(NodeId, stiffness)
  template <class Add>
  void for_each_stiffness(geometry::Positions x, Add&& add) const {
    const double largest = std::abs(largest_pressure());
    for (const auto& [a, b, c] : members_.groups()) {
      const Vec3 &xa = x[index_of(a)], &xb = x[index_of(b)], &xc = x[index_of(c)];
      const double sides = (xb - xa).norm() + (xc - xb).norm() + (xa - xc).norm();
      for (const NodeId node : {a, b, c}) add(node, largest * sides / 6.0);
    }
  }

  /// 1/s², at least the square of the frequency at which the pressure of a gas or by volume alone
  /// makes the surface breathe: its stiffness is dp/dV (dV/dx)(dV/dx)^T, of rank one.
  double gas_frequency_squared(geometry::Positions x, const NodeProperties& properties) const;

  /// Whether its pressure follows the volume by a table, or did before the surface was torn.
  bool is_by_volume() const noexcept { return is_by_volume_; }

 private:
  double pressure_at(double time, double volume) const;
  double largest_pressure() const noexcept;
  bool follows_volume() const noexcept { return load_.gas || by_volume_; }

  SurfacePressure load_;
  bool is_by_volume_;
  std::optional<TimeTable> by_volume_;  // Pa, with m³ in place of the time
  NodeMembers<3> members_;
  LoadedNodes nodes_;
  std::vector<Vec3> shares_;  // m², by facet: a third of its area vector
  double start_volume_ = 0.0;
  double volume_ = 0.0;
  double pressure_ = 0.0;
  bool is_set_ = false;
  geometry::ParallelSum<double> sum_;
};

}  // namespace plekton::dynamics
