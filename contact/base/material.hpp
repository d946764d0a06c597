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

/// What a body is where it touches others, before it is deformed. A contact keeps it all over a
/// structure: at a node, a bar's end or the rim of a sheet too, so that its energy is one function
/// of the positions.
enum class Shape : std::uint8_t {
  sphere,    ///< also a node of a structure where it meets a plane
  cylinder,  ///< a structure of cylinders alone
  flat       ///< a plane, or a structure with facets
};

/// One side of a pair, as a contact law sees it.
struct Body {
  Material material;
  double radius;  ///< m; of a facet half its thickness, of a plane that of what meets it
  /// kg; infinite for what is held, for planes, and for a surface that a sphere meets.
  double mass = std::numeric_limits<double>::infinity();
  Shape shape = Shape::sphere;
};

/// A body of a material of a scene.
struct BodyPart {
  MaterialId material;
  double radius;                                          ///< m
  double mass = std::numeric_limits<double>::infinity();  ///< kg, see Body
  Shape shape = Shape::sphere;
};

/// Mass (kg) with which two bodies move against each other; infinite if both masses are.
inline double reduced_mass(const Body& a, const Body& b) noexcept {
  return 1.0 / (1.0 / a.mass + 1.0 / b.mass);
}

}  // namespace plekton::contact
