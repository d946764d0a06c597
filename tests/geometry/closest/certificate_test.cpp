// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/closest/certificate.hpp"

#include "tests/support/exact_pair.hpp"
#include "tests/support/simplex_families.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>
#include <vector>

namespace plekton::geometry::closest::certificate_test {
namespace {

using test::ExactPair;
using test::kPairFamilies;
using test::kPairFamilyNames;
using test::PairFamily;
using test::SimplexFamilies;

/// How often each verdict was right.
struct Verdicts {
  int refuted = 0, tied = 0, unique = 0, touching = 0;
};

/// Every pair of features of a pair of cores, against rational foot points.
template <std::size_t kCountA, std::size_t kCountB>
void expect_exact_verdicts(const std::array<Vec3, kCountA>& a, const std::array<Vec3, kCountB>& b,
                           bool has_no_ties, Verdicts& right) {
  const ExactPair pair(a, b);
  const std::size_t carriers = test::all_witness_features(a, b).size();
  for (unsigned of_a = 1; of_a < 1U << kCountA; ++of_a) {
    for (unsigned of_b = 1; of_b < 1U << kCountB; ++of_b) {
      const Verdict verdict = certify(a, b, {of_a, of_b});
      const int corners = std::popcount(of_a) + std::popcount(of_b);
      // A side and a face are the nearest of none but cores that cross; that is crosses()'s matter.
      const auto points = corners > 4 ? std::nullopt : pair.feet(of_a, of_b);
      if (!points || !pair.are_nearest(*points)) {
        ASSERT_EQ(verdict, Verdict::refuted) << of_a << ' ' << of_b;
        ++right.refuted;
      } else if (test::dot(points->separation, points->separation).is_zero()) {
        ASSERT_EQ(verdict, Verdict::touching) << of_a << ' ' << of_b;
        ++right.touching;
      } else if (verdict == Verdict::unique || has_no_ties) {
        ASSERT_EQ(verdict, Verdict::unique) << of_a << ' ' << of_b;
        ASSERT_EQ(carriers, 1u) << of_a << ' ' << of_b;
        ++right.unique;
      } else {
        ASSERT_EQ(verdict, Verdict::tied) << of_a << ' ' << of_b;
        ++right.tied;
      }
    }
  }
}

template <std::size_t kCountA, std::size_t kCountB>
void expect_exact_verdicts_on_all_families(std::uint64_t seed) {
  SimplexFamilies<kCountA, kCountB> families(seed);
  Verdicts right;
  for (std::size_t f = 0; f < kPairFamilies.size(); ++f) {
    for (int trial = 0; trial < 100; ++trial) {
      const auto [a, b] = families.draw(kPairFamilies[f]);
      SCOPED_TRACE(kPairFamilyNames[f]);
      expect_exact_verdicts(a, b, kPairFamilies[f] == PairFamily::generic, right);
      if (::testing::Test::HasFatalFailure()) return;
    }
  }
  EXPECT_GT(right.refuted, 50);
  EXPECT_GT(right.tied, 10);
  EXPECT_GT(right.unique, 50);
  EXPECT_GT(right.touching, 5);
}

TEST(Certify, IsProvenByRationalsForAPointAndASegmentOrATriangle) {
  expect_exact_verdicts_on_all_families<1, 2>(1);
  expect_exact_verdicts_on_all_families<1, 3>(2);
  expect_exact_verdicts_on_all_families<3, 1>(3);
}

TEST(Certify, IsProvenByRationalsForSegmentsAndTriangles) {
  expect_exact_verdicts_on_all_families<2, 2>(4);
  expect_exact_verdicts_on_all_families<2, 3>(5);
  expect_exact_verdicts_on_all_families<3, 3>(6);
}

TEST(Crosses, IsProvenByRationalsForEverySideOfATriangle) {
  SimplexFamilies<3, 3> families(7);
  int crossing = 0;
  for (std::size_t f = 0; f < kPairFamilies.size(); ++f) {
    for (int trial = 0; trial < 300; ++trial) {
      const auto [a, b] = families.draw(kPairFamilies[f]);
      const ExactPair pair(a, b);
      for (const unsigned side : {3U, 5U, 6U}) {
        const bool expected = pair.feet(side, 7U).has_value();
        ASSERT_EQ(crosses(a, side, b), expected) << kPairFamilyNames[f] << ' ' << side;
        crossing += expected;
      }
    }
  }
  EXPECT_GT(crossing, 500);
}

TEST(Crosses, IsFalseWhereASegmentMeetsTheRimOrEndsOnTheFaceOrLiesInIt) {
  const std::array<Vec3, 3> triangle{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
  const auto goes_through = [&](const Vec3& from, const Vec3& to) {
    const std::array<Vec3, 2> segment{from, to};
    return crosses(segment, 3U, triangle);
  };

  EXPECT_TRUE(goes_through({1, 1, -1}, {1, 1, 1}));
  EXPECT_TRUE(goes_through({1, 1, 1}, {1, 1, -1})) << "from the other side";
  EXPECT_FALSE(goes_through({2, 2, -1}, {2, 2, 1})) << "a side";
  EXPECT_FALSE(goes_through({4, 0, -1}, {4, 0, 1})) << "a corner";
  EXPECT_FALSE(goes_through({1, 1, 0}, {1, 1, 1})) << "with an end";
  EXPECT_FALSE(goes_through({1, 1, 0}, {2, 1, 0})) << "in the plane";
  EXPECT_FALSE(goes_through({3, 3, -1}, {3, 3, 1})) << "beside it";
}

TEST(IsLowerSide, OrdersByTheNumberOfCornersThenByCoordinates) {
  using Numbers = std::vector<double>;
  const auto numbers_of = [](const std::vector<Vec3>& core) {
    Numbers numbers;
    for (const Vec3& x : core) numbers.insert(numbers.end(), {x[0], x[1], x[2]});
    return numbers;
  };
  test::Random random(8);
  int equal = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const auto core = [&] {
      std::vector<Vec3> x;
      // Of so few numbers that corners are often equal.
      for (int k = random.integer(1, 3); k > 0; --k) x.push_back(random.on_lattice(0, 1));
      return x;
    };
    const std::vector<Vec3> a = core(), b = core();
    const auto key = [&](const auto& x) { return std::pair(x.size(), numbers_of(x)); };

    ASSERT_EQ(is_lower_side(b, a), key(b) < key(a));

    equal += key(a) == key(b);
  }
  EXPECT_GT(equal, 50);
}

}  // namespace
}  // namespace plekton::geometry::closest::certificate_test
