// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace plekton::contact {

/// Index of a contact material.
enum class MaterialId : std::int32_t {};

/// What a body brings to a contact. Density and the inner stiffness of structures are kept
/// elsewhere.
struct Material {
  double young_modulus = 0.0;    ///< Pa, > 0
  double stiffness_ratio = 0.0;  ///< tangential over normal stiffness, >= 0 (YADE calls it poisson)
  double friction = 0.0;         ///< tan of the friction angle, >= 0
};

}  // namespace plekton::contact
