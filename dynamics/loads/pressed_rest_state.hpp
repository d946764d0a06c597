// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/model/scene.hpp"

namespace plekton::dynamics {

/// Elements of a scene from these places on, as they were added last.
struct PressedPart {
  std::size_t first_facet = 0;  ///< among the facets of Scene::elements
  std::size_t first_sheet = 0;  ///< among Scene::sheet_facets
  std::size_t first_bond = 0;   ///< among Scene::bonds
};

/// How a structure stands under a pressure.
struct PressedRest {
  double imbalance = 0.0;        ///< largest force that is left on a free node, over the pressure
                                 ///< times the node's share of the area
  double largest_stretch = 1.0;  ///< length over that at rest, the farthest from 1
  double compressed = 0.0;       ///< 0 to 1, share of the area of sheets with a principal force
                                 ///< below 0, or of the length of bars and beams
};

/// Lets a structure be in equilibrium where it is drawn under a pressure on its facets, by setting
/// the sizes at which its sheets and bonds, at rest as drawn before, are at rest.
///
/// Nodal forces are linear in what the elements carry, at the drawn geometry: -A N g_i on corner i of
/// a sheet, A the area, N the membrane forces per length (Cauchy), g_i the gradient of the corner's
/// shape function, and -T n at the end of a bar. Of all N and T that balance the pressure those of
/// the linear elastic problem K u = f are taken: they have the least complementary energy. Then each
/// element gets the size at which its own law, for large strain, carries just that where it is. So
/// the equilibrium does not depend on how large strains are.
///
/// Sheets: stretched_facet.hpp. Bars and beams: L_0 = E A L / (T + E A), beams bent as they are
/// drawn. Wires: L_0 = L / (1 + e), e where their curve carries T.
///
/// K alone has motions without strain: those of a free body, and of parts without curvature. So
/// (K + c D) du = f - K u is solved again and again, D the mean of the diagonal of each node and c =
/// 1e-12 (proximal point method: Rockafellar, SIAM J. Control Optim. 14 (1976) 877): what the
/// pressure does not move stays where it is, and what only the shift holds keeps all of its force,
/// which tells that it cannot stand.
///
/// Translations held by the scene's properties are supports. Time of a sparse direct solution: for n
/// nodes n^1.5 to n^2 (0.45 s for 10 000).
/// @param pressure  Pa, not 0, along the normals of the facets
/// @param part      bonds and sheets that carry; the facets that are pressed
/// @throws std::invalid_argument where it cannot stand so: no facets, neighbours that face opposite
///         ways, an open surface of which nothing is held, a node that is out of balance, an element
///         with a stretch below 0.5 or above 1.5, or beyond its strength, a wire that would push. The
///         scene is as it was then.
PressedRest rest_under_pressure(double pressure, const PressedPart& part, Scene& scene);

}  // namespace plekton::dynamics
