// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/motion.hpp"
#include "contact/structure/normal_spring.hpp"
#include "contact/structure/simplex.hpp"
#include "geometry/product_features.hpp"

#include <array>
#include <cstdint>

namespace plekton::contact::structure {

/// A pair of features of a surface, and what it does in the present step.
struct PairTerm {
  geometry::FeatureNodes a;
  geometry::FeatureNodes b;
  std::array<bool, 3> is_seam_a;
  std::array<bool, 3> is_seam_b;
  std::int32_t weight;
  std::uint32_t first_holder;
  std::uint32_t holder_count;
  std::uint32_t spring;  ///< of its two structures
  bool is_of_cells;      ///< of two facets or cylinders, not of their sides
  bool in_range = false;
  bool meets = false;    ///< the cores touch or cross; exact
  double overlap = 0.0;  ///< m, of the nearest points
  PairForces forces;     ///< weight times those of the nearest points, plus those of the extent
};

PairTerm pair_term(const geometry::Surface& surface, const geometry::FeaturePair& pair);

/// Finds the forces of a term at the present positions.
/// @returns m, by how much its cores are at least further apart than the range; negative in range
double evaluate(PairTerm& term, const NormalSpring& spring, geometry::Positions x);

}  // namespace plekton::contact::structure
