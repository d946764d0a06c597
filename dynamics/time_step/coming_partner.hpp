// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/material.hpp"

#include <cstddef>
#include <cstdint>

namespace plekton::dynamics {

/// With what a contact that may come would be the stiffest.
struct ComingPartner {
  enum class Kind : std::uint8_t { nothing, balls, structure, plane };
  Kind kind = Kind::nothing;
  contact::MaterialId material{};  ///< of the partner
  double radius = 0.0;             ///< m, of balls, and of the tubes or half the thickness of a
                                   ///< structure
  std::size_t id = 0;              ///< of a structure (geometry::StructureId) or plane
};

}  // namespace plekton::dynamics
