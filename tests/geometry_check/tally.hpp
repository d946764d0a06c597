// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// What the check has seen.
namespace plekton::geometry_check {

/// Nearest points of one pair of primitives on one family of inputs.
struct PairTally {
  const char* pair;
  const char* family;
  std::uint64_t queries = 0;
  std::uint64_t wrong_regions = 0;    ///< other features hold the nearest points
  std::uint64_t wrong_relations = 0;  ///< whether the cores meet is not true
  std::uint64_t not_numbers = 0;
  std::uint64_t wrong_distances = 0;  ///< relative error above kLargestError, or weights that do
                                      ///< not give the points
  std::uint64_t one_sided = 0;       ///< (b, a) is not (a, b) with the sides exchanged, bit for bit
  std::uint64_t jumps = 0;           ///< the distance changed by more than the corners moved
  double largest_error = 0.0;        ///< relative, of distance and separation
  std::uint64_t enumerated = 0;      ///< guesses that were not certain and unique
  std::uint64_t double_doubles = 0;  ///< signs that the double filter could not tell
  std::uint64_t intervals = 0;       ///< signs that pairs of doubles could not tell either
  std::uint64_t exact = 0;           ///< signs that intervals could not tell either

  std::uint64_t violations() const {
    return wrong_regions + wrong_relations + not_numbers + wrong_distances + one_sided + jumps;
  }
};

/// A statement about a surface and a point.
struct InvariantTally {
  const char* name;
  std::uint64_t cost = 1;  ///< queries that a trial takes as long as
  std::uint64_t trials = 0;
  std::uint64_t violations = 0;
};

inline constexpr double kLargestError = 1e-12;

struct Report {
  std::vector<PairTally> pairs;
  std::vector<InvariantTally> invariants;
  std::vector<std::string> examples;  ///< the first violations, to be replayed

  /// Of pairs, and trials of statements.
  std::uint64_t queries() const {
    std::uint64_t sum = 0;
    for (const PairTally& tally : pairs) sum += tally.queries;
    for (const InvariantTally& tally : invariants) sum += tally.trials;
    return sum;
  }
  std::uint64_t violations() const {
    std::uint64_t sum = 0;
    for (const PairTally& tally : pairs) sum += tally.violations();
    for (const InvariantTally& tally : invariants) sum += tally.violations;
    return sum;
  }
};

}  // namespace plekton::geometry_check
