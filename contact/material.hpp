// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

namespace plekton::contact {

/// Index of a contact material.
enum class MaterialId : std::int32_t {};

/// What a body is made of, as far as contacts are concerned. Density and the inner stiffness of
/// structures are kept elsewhere.
struct Material {
  double young_modulus = 0.0;    ///< Pa, > 0
  double stiffness_ratio = 0.0;  ///< tangential over normal stiffness, >= 0 (YADE calls it poisson)
  double friction = 0.0;         ///< tan of the friction angle, >= 0
  double poisson_ratio = 0.3;    ///< of elastic solids in contact (Hertz), in (-1, 0.5]
};

/// One side of a pair, as a contact law sees it.
struct Body {
  Material material;
  double radius;  ///< m
  /// kg; infinite for what is held, for planes, and for a surface that a ball meets.
  double mass = std::numeric_limits<double>::infinity();
};

/// Mass (kg) with which two bodies move against each other; infinite if both masses are.
inline double reduced_mass(const Body& a, const Body& b) noexcept {
  return 1.0 / (1.0 / a.mass + 1.0 / b.mass);
}
/// Radius (m) of the curvature of one body against the other.
inline double reduced_radius(const Body& a, const Body& b) noexcept {
  return a.radius * b.radius / (a.radius + b.radius);
}

}  // namespace plekton::contact
