// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/material.hpp"
#include "contact/base/motion.hpp"
#include "contact/base/plane.hpp"
#include "geometry/primitives/elements.hpp"

#include <cstdint>
#include <limits>
#include <vector>

namespace plekton::contact {

/// A sphere that touches other things: a sphere, or a node of a structure where it meets a plane.
struct SphereBody {
  NodeId node;
  double radius;  ///< m
  MaterialId material;
  std::int32_t rigid_body = -1;  ///< that it is a part of, with the mass of all; -1: none
  double mass = std::numeric_limits<double>::infinity();  ///< kg, see Body
  geometry::StructureId structure{-1};  ///< that it is a node of; -1: a sphere by itself
};

/// Of a structure.
inline Shape shape_of(const geometry::Surface& surface, geometry::StructureId structure) noexcept {
  return surface.is_sheet(structure) ? Shape::flat : Shape::cylinder;
}

}  // namespace plekton::contact
