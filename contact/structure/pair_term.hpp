// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/motion.hpp"
#include "contact/structure/normal_spring.hpp"
#include "contact/structure/simplex.hpp"
#include "geometry/closest/core_pair.hpp"
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
  bool meets = false;    ///< the cores touch or cross; exact
  double overlap = 0.0;  ///< m, of the nearest points
  PairForces forces;     ///< weight times those of the nearest points, plus those of the extent
};

PairTerm pair_term(const geometry::Surface& surface, const geometry::FeaturePair& pair);

/// Where the cores of a term are nearest.
struct TermProximity {
  geometry::CoreProximity cores;  ///< meaningful in range only, as the next
  bool may_be_flat;               ///< see nearest.hpp
  double clearance;  ///< m, by how much the cores are at least further apart than the range;
                     ///< negative in range
};

/// @param was_near  whether the term was in range a moment ago, and last says where
TermProximity proximity(const PairTerm& term, double range, geometry::Positions x, bool was_near,
                        const geometry::closest::Carriers& last);

/// Nearest points of a term whose features are faces of those of another, where these points lie in
/// the smaller features: they are the same.
/// @param is_turned  feature a of the term belongs to b of the other
/// @returns whether they do; if so, found is set
bool takes_over(const PairTerm& term, const PairTerm& other, bool is_turned,
                const TermProximity& of_other, TermProximity& found);

/// What a spring of the same range as its own does in a term in range: its weight times what the
/// spring does at the nearest points, plus what it does over the extent.
PairForces pair_forces(const PairTerm& term, const TermProximity& found, const NormalSpring& spring,
                       geometry::Positions x);

/// Finds the forces of a term in range.
void evaluate(PairTerm& term, const TermProximity& found, const NormalSpring& spring,
              geometry::Positions x);

}  // namespace plekton::contact::structure
