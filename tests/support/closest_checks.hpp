// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/closest/certificate.hpp"
#include "tests/support/exact_pair.hpp"
#include "tests/support/simplex_families.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

/// What every kernel of nearest points must fulfil, for any numbers of corners.
namespace plekton::test {

/// Weights are computed in double; they may miss the separation by a few ulps of the size.
constexpr double kWeightTolerance = 1e-14;
constexpr double kDistanceTolerance = 1e-12;

struct Tally {
  int wrong_regions = 0;
  int wrong_relations = 0;
  int not_numbers = 0;
  double relative_error = 0.0;
  double mismatch = 0.0;

  void add(const Judgement& judgement) {
    wrong_regions += judgement.wrong_region;
    wrong_relations += judgement.wrong_relation;
    not_numbers += judgement.not_a_number;
    relative_error = std::max(relative_error, judgement.relative_error);
    mismatch = std::max(mismatch, judgement.mismatch);
  }
  bool is_clean() const {
    return wrong_regions + wrong_relations + not_numbers == 0 &&
           relative_error <= kDistanceTolerance && mismatch <= kWeightTolerance;
  }
};

template <std::size_t kCountA, std::size_t kCountB, class Kernel>
void expect_exact_on_all_families(Kernel kernel, std::uint64_t seed, int per_family) {
  SimplexFamilies<kCountA, kCountB> families(seed);
  for (std::size_t f = 0; f < kPairFamilies.size(); ++f) {
    Tally tally;
    for (int trial = 0; trial < per_family; ++trial) {
      const auto [a, b] = families.draw(kPairFamilies[f]);
      tally.add(judge(a, b, kernel(a, b)));
    }
    EXPECT_TRUE(tally.is_clean()) << kPairFamilyNames[f] << ": " << tally.wrong_regions
                                  << " wrong regions, " << tally.wrong_relations
                                  << " wrong relations, " << tally.not_numbers
                                  << " NaN, relative error " << tally.relative_error
                                  << ", weights off by " << tally.mismatch;
  }
}

/// Among all pairs of features that carry nearest points the first one in the order for ties.
template <std::size_t kCountA, std::size_t kCountB, class Kernel>
void expect_the_lowest_of_ties(Kernel kernel, std::uint64_t seed, int per_family) {
  SimplexFamilies<kCountA, kCountB> families(seed);
  int ties = 0;
  for (std::size_t f = 0; f < kPairFamilies.size(); ++f) {
    int wrong = 0;
    for (int trial = 0; trial < per_family; ++trial) {
      const auto [a, b] = families.draw(kPairFamilies[f]);
      const bool is_swapped = geometry::closest::is_lower_side(b, a);
      const auto all = is_swapped ? all_witness_features(b, a) : all_witness_features(a, b);
      const ClosestPoints found = kernel(a, b);
      std::array<unsigned, 2> witness_features{found.corners_a, found.corners_b};
      if (is_swapped) std::swap(witness_features[0], witness_features[1]);
      wrong += all.empty() || all.front() != witness_features;
      ties += all.size() > 1;
    }
    EXPECT_EQ(wrong, 0) << kPairFamilyNames[f];
  }
  EXPECT_GT(ties, per_family / 10);
}

inline bool are_opposite(const ClosestPoints& p, const ClosestPoints& q) {
  return p.corners_a == q.corners_b && p.corners_b == q.corners_a &&
         p.separation == -q.separation && p.weights_a == q.weights_b &&
         p.weights_b == q.weights_a && p.distance == q.distance && p.relation == q.relation;
}

/// The answer for (b, a) is that for (a, b), bit for bit.
template <std::size_t kCountA, std::size_t kCountB, class Kernel, class Reversed>
void expect_the_same_from_both_sides(Kernel kernel, Reversed reversed, std::uint64_t seed,
                                     int per_family) {
  SimplexFamilies<kCountA, kCountB> families(seed);
  for (std::size_t f = 0; f < kPairFamilies.size(); ++f) {
    int different = 0;
    for (int trial = 0; trial < per_family; ++trial) {
      const auto [a, b] = families.draw(kPairFamilies[f]);
      different += !are_opposite(kernel(a, b), reversed(b, a));
    }
    EXPECT_EQ(different, 0) << kPairFamilyNames[f];
  }
}

/// Coordinates scaled so far down that their squares vanish, or up to 1e74.
template <std::size_t kCountA, std::size_t kCountB, class Kernel>
void expect_numbers_at_any_scale(Kernel kernel, std::uint64_t seed, int per_family) {
  SimplexFamilies<kCountA, kCountB> families(seed);
  for (const double factor : {1e67, 1e-60, 1e-110, 1e-160, 1e-300, 1e-320}) {
    for (std::size_t f = 0; f < kPairFamilies.size(); ++f) {
      Tally tally;
      for (int trial = 0; trial < per_family; ++trial) {
        auto [a, b] = families.draw(kPairFamilies[f]);
        for (Vec3& corner : a) corner *= factor;
        for (Vec3& corner : b) corner *= factor;
        tally.add(judge(a, b, kernel(a, b)));
      }
      EXPECT_EQ(tally.wrong_regions + tally.wrong_relations + tally.not_numbers, 0)
          << kPairFamilyNames[f] << " times " << factor << ": " << tally.wrong_regions << " "
          << tally.wrong_relations << " " << tally.not_numbers;
    }
  }
}

}  // namespace plekton::test
