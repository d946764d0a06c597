// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/structure/sheet_facet.hpp"

#include <array>
#include <optional>

namespace plekton::dynamics {

/// Principal values (N/m) of the membrane forces in a plane, the larger first.
std::array<double, 2> principal_values(const Eigen::Matrix2d& force) noexcept;

/// A facet, and how far it is stretched where its nodes are.
struct StretchedFacet {
  SheetFacet facet;
  std::array<double, 2> stretches;  ///< length over that at rest, along the larger force and across
};

/// The facet that carries a membrane force where another one is at rest: of another size.
///
/// N has the principal values n_1 and n_2, and the stretch U, symmetric, l_1 and l_2 along the same
/// axes. With a = 2 n_1 / (E t), b = 2 n_2 / (E t) and r = l_1 / l_2 the law of SheetFacets, for
/// forces by length as it is (n_1 = r S_1, n_2 = S_2 / r, S those by length at rest), says
///
///     l_1² = 1 + a / r - nu b r,  l_2² = 1 + b r - nu a / r,
///     b r⁴ + r³ - nu (a - b) r² - r - a = 0,
///
/// with one positive root where both pull (Descartes' rule of signs), 1 where they are equal. The
/// corners at rest are U^-1 times those of now, in a frame that turns with the first side. Since U is
/// symmetric the nodes are turned in the plane as the facet is: its bending and turning are at rest.
/// @param force  N/m, Cauchy, in the frame of the facet at rest
/// @returns nothing where the law has no such force: it gets soft where it is pushed together by much
std::optional<StretchedFacet> stretched_facet(const SheetFacet& at_rest,
                                              const Eigen::Matrix2d& force) noexcept;

}  // namespace plekton::dynamics
