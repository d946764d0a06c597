// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/loads/load_step.hpp"
#include "dynamics/loads/loaded_nodes.hpp"
#include "dynamics/loads/node_members.hpp"
#include "dynamics/model/loads.hpp"
#include "dynamics/structure/sheet_facet.hpp"
#include "dynamics/structure/sheet_facets.hpp"

#include <array>
#include <span>
#include <vector>

namespace plekton::dynamics {

/// A membrane's resistance to how fast its facet is stretched: with d_k the vector along side k,
/// from corner k to the next, and u_k the difference of the velocities of its ends, the side pulls
/// its ends together with s_k d_k, s = M (d_k . u_k). M = A tau B^-T C B^-1 with the area A at rest,
/// the elasticity C of a membrane in plane stress and the rows (D_x², D_y², D_x D_y) of B for the
/// sides D at rest, so that B^-1 (d_k . u_k) is the rate of Green's strain: the stress is tau C times
/// that rate (Kelvin and Voigt). tau = 2 ratio / omega, omega the highest frequency with which the
/// facet alone stretches between its nodes.
/// Green's strain from the lengths of the sides: Zienkiewicz, Taylor & Fox, The Finite Element
/// Method for Solid and Structural Mechanics, 7th ed., 13.
struct FacetDashpot {
  Mat3 resistance = Mat3::Zero();  ///< N s/m³, M
  double relaxation_time = 0.0;    ///< s, tau
};

/// @returns nothing that resists where all nodes are held
FacetDashpot dashpot_of(const SheetFacet& facet, double ratio, const NodeProperties& properties);

/// Facets of sheets with such dashpots. They leave both momenta alone, also where the sheet turns,
/// and never give energy back. The velocities are those of the last drift.
class DampedSheets {
 public:
  DampedSheets(const SheetDamping& damping, std::span<const SheetFacet> facets,
               const NodeProperties& properties);

  LoadedNodes& act(const LoadStep& step, const NodeState& state, geometry::ThreadPool& pool);
  LoadedNodes& nodes() noexcept { return nodes_; }

  /// Takes the dashpots off facets that are torn.
  void follow(const SheetFacets& facets);

  /// s, the largest tau: what resists is nowhere above that times the stiffness of the sheet.
  double relaxation_time() const noexcept { return relaxation_time_; }

 private:
  std::vector<std::size_t> facets_;  // by group of members_
  NodeMembers<3> members_;
  LoadedNodes nodes_;
  std::vector<Mat3> resistances_;            // N s/m³, by group of members_
  std::vector<std::array<Vec3, 3>> forces_;  // N, on the corners, likewise
  double relaxation_time_ = 0.0;
};

}  // namespace plekton::dynamics
