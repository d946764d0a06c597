// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/structure/sheet_facet.hpp"

namespace plekton::dynamics {

/// Bending stiffness (N/m) of a triangle of a thin plate against the openings at its corners.
///
/// The opening q_ij (m) is how far the tangent plane of node i passes beside node j: w_j - w_i -
/// grad w_i . e_ij for a deflection w, zero in a plane. Openings come in the order (01, 02), (12,
/// 10), (20, 21), and the energy is 1/2 q . K q.
///
/// K is that of the discrete Kirchhoff triangle (Batoz, Bathe & Ho, Int. J. Numer. Meth. Engng 15
/// (1980) 1771-1812): the slope is quadratic over the triangle; at the corners it is that of the
/// nodes; in the middle of a side its component along the side is that of the cubic through both
/// ends, its component across the mean of both ends. Any constant curvature is met exactly,
/// whatever the triangle, so the deflection converges with the square of the size of the facets on
/// any sequence of good meshes, for any Poisson's ratio. (A hinge over each edge has one curvature
/// where a plate has three: its limit depends on the mesh.)
Mat6 plate_bending(const std::array<Vec2, 3>& corners, const SheetSection& section) noexcept;

}  // namespace plekton::dynamics
