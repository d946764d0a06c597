// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/structure/sheet_facet.hpp"

#include <array>

namespace plekton::dynamics {

/// Of the linear interpolation over a triangle.
struct ShapeGradients {
  std::array<Vec2, 3> gradients;  ///< 1/m, of the share of each corner
  double area;                    ///< m²
};

/// What the force needs to know of a facet.
struct SheetSpring {
  std::array<Vec2, 3> corners;  ///< m, at rest
  ShapeGradients shape;
  double tensile_stiffness;  ///< N/m, E t / (1 - nu²)
  double poisson_ratio;
  double turning;            ///< N m, against turning of a node in the plane of the facet
  Mat6 bending;              ///< N/m, of the discrete Kirchhoff triangle
  std::array<Quat, 3> rest;  ///< see SheetFacet
};

SheetSpring spring_of(const SheetFacet& facet) noexcept;

/// What a facet does to its nodes.
struct SheetReaction {
  std::array<Vec3, 3> force{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};   ///< N
  std::array<Vec3, 3> torque{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  ///< N m
  Vec3 stress = Vec3::Zero();  ///< N/m, (11, 22, 12), second Piola-Kirchhoff, in the facet's frame
  double energy = 0.0;         ///< J
};

}  // namespace plekton::dynamics
