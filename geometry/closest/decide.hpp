// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/closest/certificate.hpp"
#include "geometry/closest/closest_points.hpp"

namespace plekton::geometry::closest {

/// The features that carry the nearest points, exact and with the rule for ties.
struct Decision {
  WitnessFeatures witness_features;
  Relation relation;
};

/// Goes through all pairs of features in the order of the rule for ties.
Decision enumerate(Corners a, Corners b) noexcept;

/// Takes a guess if it is certain and unique, else enumerates.
inline Decision decide(Corners a, Corners b, WitnessFeatures guess) noexcept {
  if (certify(a, b, guess) == Verdict::unique) return {guess, Relation::apart};
  return enumerate(a, b);
}

/// Of a point a. The nearest point of b is unique, so a tie is one of features that hold the same
/// point, and the guess is the lowest of them unless corners coincide or lie on a line.
Decision decide_for_point(Corners a, Corners b, unsigned guess) noexcept;

/// Weights and separation for features that were decided.
ClosestPoints evaluate(Corners a, Corners b, const Decision& decision) noexcept;

}  // namespace plekton::geometry::closest
