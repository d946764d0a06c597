// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "contact/surface_surface/normal_spring.hpp"
#include "contact/surface_surface/point_share.hpp"
#include "contact/surface_surface/sides.hpp"
#include "contact/surface_surface/simplex.hpp"
#include "geometry/closest/core_pair.hpp"
#include "geometry/critical/product_features.hpp"

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
  std::uint32_t spring;      ///< of its two structures
  bool is_of_cells;          ///< of two facets or cylinders, not of their sides
  bool meets = false;        ///< the cores touch or cross; exact
  double overlap = 0.0;      ///< m, of the nearest points
  double point_share = 1.0;  ///< of the weight, that the nearest points have (point_share.hpp)
  PairForces forces;         ///< weight times those of the nearest points, plus those of the extent
  double own_energy = 0.0;   ///< J, of these, without joints and cycles
  double push = 0.0;         ///< N, how hard these push the features apart, along their normal
};

/// A pair of cells that has the features of a term.
struct Holder {
  std::uint32_t pair;
  Sides sides;  ///< how the features of the term go with its cells
};

PairTerm pair_term(const geometry::Surface& surface, const geometry::FeaturePair& pair);

/// Where the cores of a term are nearest.
struct TermProximity {
  geometry::CoreProximity cores;  ///< meaningful in range only, as the next
  bool may_be_flat;               ///< see nearest.hpp
  double clearance;  ///< m, by how much the cores are at least further apart than the range;
                     ///< negative in range
  double tilt;       ///< tilt_between() of two facets; of anything else, and out of range, negative
};

/// @param was_near  whether the term was in range a moment ago, and last says where
TermProximity proximity(const PairTerm& term, double range, geometry::Positions x, bool was_near,
                        const geometry::closest::WitnessFeatures& last);

/// Nearest points of a term whose features are faces of those of another, where these points lie in
/// the smaller features: they are the same.
/// @param sides  how the features of the term go with those of the other
/// @returns whether they do; if so, found is set
bool takes_over(const PairTerm& term, const PairTerm& other, Sides sides,
                const TermProximity& of_other, TermProximity& found);

/// What a spring does in a term in range: the point share of its weight times what the spring does
/// at the nearest points, plus what it does over the extent.
struct TermForces {
  PairForces forces;
  PairForces extent;    ///< the part of them that two facets have by their extent
  double shared = 0.0;  ///< J, of the nearest points, what the share is of; 0 where that is all
};
TermForces term_forces(const PairTerm& term, const TermProximity& found, const PointShare& share,
                       const NormalSpring& spring, geometry::Positions x);

/// The corners of two facets that span the features of both rims where a term has its nearest
/// points, bit k for corner k; 0 if one of them is on no rim.
struct RimPlaces {
  unsigned a = 0;
  unsigned b = 0;
};
/// @param a, b  nodes that span the features with the nearest points of a term that the facets have
RimPlaces rim_places(const geometry::Surface& surface, const PairTerm& facets,
                     const geometry::FeatureNodes& a, const geometry::FeatureNodes& b);
/// What lies beside each other of a term's two facets (rim_share.hpp).
Real rim_share(const PairTerm& facets, const RimPlaces& places, geometry::Positions x);

/// Adds what an energy does that depends on the tilt of a term's two facets.
/// @param by_tilt  J
void add_tilting(const PairTerm& facets, double by_tilt, geometry::Positions x, PairForces& to);

}  // namespace plekton::contact::structure
