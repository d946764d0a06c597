// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/geometry_check/check.hpp"

#include "tests/geometry_check/any_surface.hpp"
#include "tests/geometry_check/force_check.hpp"
#include "tests/geometry_check/knot_check.hpp"
#include "tests/geometry_check/slope.hpp"
#include "tests/geometry_check/spread_check.hpp"
#include "tests/geometry_check/structure_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

/// The check itself must be able to fail.
namespace plekton::geometry_check::check_test {
namespace {

using geometry::ClosestPoints;
using geometry::Core;
using geometry::Vec3;

ClosestPoints certified(const Core& a, const Core& b) {
  return geometry::closest_points(a, b);
}

std::uint64_t violations(std::uint64_t PairTally::*kind, const Report& report, const char* pair) {
  std::uint64_t sum = 0;
  for (const PairTally& row : report.pairs) sum += std::string(row.pair) == pair ? row.*kind : 0;
  return sum;
}

TEST(GeometryCheck, FindsNothingWrongWithTheKernel) {
  const Report report = check({20000, 1, 1, {}}, certified);

  EXPECT_EQ(report.violations(), 0U);
  EXPECT_TRUE(report.examples.empty());
  EXPECT_EQ(report.pairs.size(), 6U * 15U + 8U);
}

TEST(GeometryCheck, SeesTheSameOnAnyNumberOfThreads) {
  const Report one = check({20000, 2, 1, {}}, certified);
  const Report three = check({20000, 2, 3, {}}, certified);

  ASSERT_EQ(one.pairs.size(), three.pairs.size());
  for (std::size_t i = 0; i < one.pairs.size(); ++i) {
    EXPECT_EQ(one.pairs[i].queries, three.pairs[i].queries);
    EXPECT_EQ(one.pairs[i].largest_error, three.pairs[i].largest_error);
    EXPECT_EQ(one.pairs[i].double_doubles, three.pairs[i].double_doubles);
    EXPECT_EQ(one.pairs[i].exact, three.pairs[i].exact);
  }
}

TEST(GeometryCheck, AsksARowAloneWhatItAsksAmongAll) {
  const Report all = check({20000, 2, 1, {}}, certified);
  CheckOptions alone{20000, 2, 1, {}};
  const auto name_of = [](const PairTally& row) {
    return std::string(row.pair) + ' ' + row.family;
  };
  alone.only = name_of(all.pairs[7]);
  const Report found = check(alone, certified);

  EXPECT_EQ(found.pairs[7].queries, all.pairs[7].queries);
  EXPECT_EQ(found.pairs[7].largest_error, all.pairs[7].largest_error);
  EXPECT_EQ(found.pairs[7].double_doubles, all.pairs[7].double_doubles);
  for (std::size_t i = 0; i < all.pairs.size(); ++i)
    EXPECT_EQ(found.pairs[i].queries > 0,
              name_of(all.pairs[i]).find(alone.only) != std::string::npos)
        << i;
  for (const InvariantTally& row : found.invariants) EXPECT_EQ(row.trials, 0U) << row.name;
}

TEST(GeometryCheck, AsksAStatementAsOftenAsItIsTold) {
  CheckOptions options{1, 2, 1, {}};
  options.only = "structures";
  options.trials = 25;
  const Report report = check(options, certified);

  int rows = 0;
  for (const InvariantTally& row : report.invariants) {
    if (row.trials == 0) continue;
    ++rows;
    EXPECT_GE(row.trials, 25U) << row.name;
    EXPECT_EQ(std::string(row.name).find("structures"), 0U) << row.name;
  }
  EXPECT_EQ(rows, 4);
  EXPECT_EQ(report.violations(), 0U);
}

TEST(GeometryCheck, RefusesARowThatIsNotThereAndNamesThoseThatAre) {
  CheckOptions options{1, 2, 1, {}};
  options.only = "structure push";
  try {
    check(options, certified);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("structure push"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("structures"), std::string::npos);
  }
}

TEST(GeometryCheck, CountsTheSignsOfEachStage) {
  PairTally sum{"", ""};
  for (const PairTally& row : check({20000, 3, 1, {}}, certified).pairs) {
    sum.double_doubles += row.double_doubles;
    sum.intervals += row.intervals;
    sum.exact += row.exact;
  }

  EXPECT_GT(sum.double_doubles, 0U);
  EXPECT_GT(sum.intervals, 0U);
  EXPECT_GE(sum.intervals, sum.exact);
}

/// The region of a point and a triangle by the signs of barycentric coordinates in double, as it is
/// commonly done.
ClosestPoints by_barycentric_coordinates(const Core& a, const Core& b) {
  if (a.count != 1 || b.count != 3) return certified(a, b);
  const Vec3 u = b.x[1] - b.x[0], v = b.x[2] - b.x[0], w = a.x[0] - b.x[0];
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), wu = w.dot(u), wv = w.dot(v);
  const double area = uu * vv - uv * uv;
  const double s = (vv * wu - uv * wv) / area, t = (uu * wv - uv * wu) / area;
  if (!(s > 0.0 && t > 0.0 && s + t < 1.0)) return certified(a, b);
  ClosestPoints found = certified(a, b);
  found.corners_b = 7U;
  return found;
}

TEST(GeometryCheck, FindsRegionsThatAreDecidedInDouble) {
  const Report report = check({100000, 3, 1, {}}, by_barycentric_coordinates);

  EXPECT_GT(violations(&PairTally::wrong_regions, report, "sphere-facet"), 100U);
  EXPECT_EQ(violations(&PairTally::wrong_regions, report, "facet-facet"), 0U);
  EXPECT_FALSE(report.examples.empty());
}

TEST(GeometryCheck, FindsDistancesThatAreOffByATrillionth) {
  const Report report = check({20000, 4, 1, {}}, [](const Core& a, const Core& b) {
    ClosestPoints found = certified(a, b);
    found.distance *= 1.0 + 2e-12;
    return found;
  });

  EXPECT_GT(violations(&PairTally::wrong_distances, report, "cylinder-cylinder"), 1000U);
}

TEST(GeometryCheck, FindsAnswersThatDependOnTheOrderOfTheBodies) {
  const Report report = check({20000, 5, 1, {}}, [](const Core& a, const Core& b) {
    ClosestPoints found = certified(a, b);
    if (a.x[0].x() < b.x[0].x()) found.distance = std::nextafter(found.distance, 1e300);
    return found;
  });

  EXPECT_GT(violations(&PairTally::one_sided, report, "cylinder-facet"), 1000U);
}

TEST(GeometryCheck, FindsCrossingsThatAreReportedAsApartAndNumbersThatAreNone) {
  const Report report = check({20000, 6, 1, {}}, [](const Core& a, const Core& b) {
    ClosestPoints found = certified(a, b);
    if (found.relation == geometry::Relation::touching_or_crossing) {
      found.relation = geometry::Relation::apart;
      found.separation.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    return found;
  });

  EXPECT_GT(violations(&PairTally::wrong_relations, report, "facet-facet"), 100U);
  EXPECT_GT(violations(&PairTally::not_numbers, report, "facet-facet"), 100U);
}

/// One contact for each minimum of the distance, without the passes between them.
std::optional<Vec3> force_of_minima(const Touch& touch) {
  const auto cells = test::cells_near(touch.surface, touch.centre, touch.range, touch.x);
  geometry::CriticalFeatureFinder finder(touch.surface);
  Vec3 force = Vec3::Zero();
  for (const auto& feature : finder.find(touch.centre, touch.range, cells, touch.x)) {
    if (feature.is_minimum()) force -= (touch.range - feature.distance) * feature.direction;
  }
  return force;
}

TEST(GeometryCheck, FindsForcesThatJumpOverCreases) {
  test::Random random(8);
  ForceTally of_minima, of_patches;
  for (int surface = 0; surface < 400; ++surface) {
    const test::Complex complex =
        test::roughened(test::sheet(3), 1.0, random.signed_power(-9.0, -6.0), random);
    test::Random same = random;
    const ForceTally minima = check_force(complex, force_of_minima, random, 50);
    const ForceTally patches = check_force(complex, force_of_patches, same, 50);
    of_minima.violations += minima.violations;
    of_patches.violations += patches.violations;
    of_patches.trials += patches.trials;
  }

  EXPECT_GT(of_minima.violations, 10);
  EXPECT_EQ(of_patches.violations, 0);
  EXPECT_GT(of_patches.trials, 1000);
}

constexpr double kBit = 1e-5;
constexpr int kTrials = 100;

/// In how many of 100 trials a check finds something.
template <class Check>
int found(Check check) {
  int sum = 0;
  for (std::uint64_t seed = 0; seed < kTrials; ++seed) {
    test::Random random(seed);
    const std::optional<bool> holds = check(random);
    sum += holds && !*holds;
  }
  return sum;
}

/// What is right, changed afterwards.
template <class Change>
SpreadRule changed(Change change) {
  return
      [change](const geometry::Surface& surface, const Vec3& centre, const std::vector<Vec3>& x) {
        SpreadPush push = push_of_patches(surface, centre, x);
        change(push, centre);
        return push;
      };
}
template <class Change>
StructureRule changed_structures(Change change) {
  return [change](StructureScene& scene, const std::vector<Vec3>& x) {
    StructurePush push = push_of_structures(scene, x);
    change(push, x);
    return push;
  };
}

// A way of a single node does not see what is wrong with the others.
TEST(SpreadCheck, FindsForcesAndEnergiesThatAreOffByABit) {
  const SpreadRule forces = changed([](SpreadPush& push, const Vec3&) {
    for (Vec3& force : push.on_nodes) force *= 1.0 + kBit;
  });
  const SpreadRule energy =
      changed([](SpreadPush& push, const Vec3&) { push.energy *= 1.0 + kBit; });
  const auto found_with = [](const SpreadRule& rule) {
    return found([&](test::Random& random) {
      const SpreadTouch touch = any_spread_touch(random);
      return has_gradient(touch, rule, random);
    });
  };

  EXPECT_GT(found_with(forces), kTrials / 2);
  EXPECT_GT(found_with(energy), kTrials / 2);
  EXPECT_EQ(found_with(push_of_patches), 0);
}

TEST(SpreadCheck, FindsBarsThatAreABitLessThanOneContact) {
  const SpreadRule less = changed([](SpreadPush& push, const Vec3&) { push.energy *= 1.0 - kBit; });
  const auto found_with = [](const SpreadRule& rule) {
    return found([&](test::Random& random) {
      SpreadTouch touch = any_spread_touch(random);
      while (!touch.complex.facets.empty()) touch = any_spread_touch(random);
      return counts_one(touch, rule);
    });
  };

  EXPECT_GT(found_with(less), kTrials / 10);  // others are more than one contact
  EXPECT_EQ(found_with(push_of_patches), 0);
}

TEST(SpreadCheck, FindsBallsThatAreAttractedABit) {
  const SpreadRule attracting =
      changed([](SpreadPush& push, const Vec3&) { push.on_ball *= -kBit; });
  const auto found_with = [](const SpreadRule& rule) {
    return found(
        [&](test::Random& random) { return is_pushed_away(any_spread_touch(random), rule); });
  };

  EXPECT_GT(found_with(attracting), kTrials / 3);  // others are not before a plane
  EXPECT_EQ(found_with(push_of_patches), 0);
}

TEST(SpreadCheck, FindsForcesThatJumpABit) {
  int sum = 0;
  for (std::uint64_t seed = 0; seed < kTrials; ++seed) {
    test::Random random(seed);
    const SpreadTouch touch = any_spread_touch(random);
    const SpreadRule jumping = changed([&](SpreadPush& push, const Vec3& centre) {
      if ((centre - touch.centre).norm() > 3e-4 * push.deepest) push.on_ball *= 1.0 + kBit;
    });
    sum += !follows(touch, jumping, random);
  }

  EXPECT_GT(sum, kTrials / 3);  // others may jump by more where tops tie
}

// Ways of a single node leave the ball where it is.
TEST(SpreadCheck, FindsForcesThatDoNotChangeInProportion) {
  const SpreadRule rattling = changed([](SpreadPush& push, const Vec3& centre) {
    for (Vec3& force : push.on_nodes)
      force.x() += kBit * push.deepest * std::sin(1e12 * centre.x());
  });
  const auto found_with = [](const SpreadRule& rule) {
    return found(
        [&](test::Random& random) { return follows(any_spread_touch(random), rule, random); });
  };

  EXPECT_GT(found_with(rattling), kTrials / 3);
  EXPECT_EQ(found_with(push_of_patches), 0);
}

// Shares turn from pass to pass within 1e-5 of the range, and the node's own force does not see it.
TEST(SpreadCheck, FollowsForcesThatBendAcrossTheWayAlone) {
  for (const std::uint64_t seed :
       {7987925232339517810U, 7987925232339571100U, 7987925232339628542U}) {
    test::Random random(seed);
    EXPECT_TRUE(follows(any_spread_touch(random), push_of_patches, random)) << seed;
  }
}

TEST(SpreadCheck, FindsForcesThatChangeByAnotherPowerOfTheStepOrLeap) {
  const Slope smooth{0.0, 1e-2, 1e-8};
  const auto is_proportional_to = [&](auto force) {
    return is_proportional([&](double step) { return Forces{force(step) * Vec3::UnitX()}; }, smooth,
                           1e-15);
  };

  EXPECT_TRUE(is_proportional_to([](double step) { return step; }));
  EXPECT_TRUE(is_proportional_to([](double step) { return step + 3e3 * step * step; }));
  EXPECT_FALSE(is_proportional_to([](double step) { return std::pow(step, 0.9); }));
  EXPECT_FALSE(is_proportional_to([](double step) { return step > 0.0 ? 1e-3 : 0.0; }));
  EXPECT_FALSE(is_proportional_to([](double step) { return step > 5e-4 ? 1e-3 : 0.0; }));
}

TEST(SpreadCheck, FindsBumpsOfKnots) {
  const SpreadRule more = changed([](SpreadPush& push, const Vec3&) { push.energy *= 1.0 + kBit; });
  const SpreadRule less = changed([](SpreadPush& push, const Vec3&) { push.energy *= 1.0 - kBit; });
  const auto found_with = [](const SpreadRule& rule) {
    return found([&](test::Random& random) { return rolls_evenly(any_knot(random), rule); });
  };

  EXPECT_GT(found_with(more), kTrials / 5);  // of straight wires
  EXPECT_EQ(found_with(less), kTrials);
  EXPECT_EQ(found_with(push_of_patches), 0);
}

/// Bars of a node, and where a ball is over it.
struct ArmsAndBall {
  std::vector<double> angles;   ///< rad
  std::vector<double> lengths;  ///< m, 0.3 to 1.5
  double depth;                 ///< m, 1e-3 to 0.1
  double place;                 ///< of half a chord, -1 to 1
  double way;                   ///< rad

  double excess() const {
    const auto along = [](double angle) { return Vec3(std::cos(angle), std::sin(angle), 0.0); };
    Knot knot{{}, false, depth, along(way)};
    const int node = knot.complex.node(Vec3::Zero());
    for (std::size_t i = 0; i < angles.size(); ++i)
      knot.complex.cylinder(node, knot.complex.node(lengths[i] * along(angles[i])));
    const double half_chord = std::sqrt(depth * (2.0 * SpreadTouch::kRange - depth));
    return excess_of_knot(knot, place * half_chord * knot.way, push_of_patches);
  }
  ArmsAndBall beside(double by, test::Random& random) const {
    const auto any = [&] { return by * random.uniform(-1.0, 1.0); };
    ArmsAndBall next = *this;
    for (double& angle : next.angles)
      if (random.coin()) angle += any();
    for (double& length : next.lengths)
      if (random.coin()) length = std::clamp(length * std::exp(any()), 0.3, 1.5);
    next.depth = std::clamp(depth * std::exp(any()), 1e-3, 0.1);
    next.place = std::clamp(place + 0.3 * any(), -1.0, 1.0);
    next.way += any();
    return next;
  }
};

ArmsAndBall any_arms_and_ball(int count, test::Random& random) {
  ArmsAndBall arms{{},
                   {},
                   std::pow(10.0, random.uniform(-3.0, -1.0)),
                   random.uniform(-1.0, 1.0),
                   random.uniform(0.0, 6.3)};
  for (int i = 0; i < count; ++i) {
    arms.angles.push_back(random.uniform(0.0, 6.3));
    arms.lengths.push_back(random.uniform(0.3, 1.5));
  }
  return arms;
}

TEST(SpreadCheck, AllowsKnotsWhatTheWorstOfThemHave) {
  test::Random random(1);
  double worst = 0.0;
  for (int trial = 0; trial < 60; ++trial) {
    ArmsAndBall at = any_arms_and_ball(trial % 10 < 4 ? 2 + trial % 10 : 6, random);
    double excess = at.excess(), by = 0.5;
    for (int k = 0; k < 2500; ++k) {
      const ArmsAndBall next = at.beside(by, random);
      const double there = next.excess();
      if (there >= excess) {
        excess = there;
        at = next;
      } else {
        by = std::max(0.995 * by, 1e-5);
      }
    }
    worst = std::max(worst, excess);
  }

  EXPECT_LE(worst, kMostOfKnots);
  EXPECT_GT(worst, 0.85 * kMostOfKnots);
}

TEST(StructureCheck, FindsForcesAndEnergiesThatAreOffByABit) {
  const StructureRule forces =
      changed_structures([](StructurePush& push, const std::vector<Vec3>&) {
        for (Vec3& force : push.forces) force *= 1.0 + kBit;
      });
  const StructureRule energy = changed_structures(
      [](StructurePush& push, const std::vector<Vec3>&) { push.energy *= 1.0 + kBit; });
  const auto found_with = [](const StructureRule& rule) {
    return found([&](test::Random& random) {
      const Structures structures = any_structures(random);
      return have_gradient(structures, rule, random);
    });
  };

  EXPECT_GT(found_with(forces), kTrials / 2);
  EXPECT_GT(found_with(energy), kTrials / 2);
  EXPECT_EQ(found_with(push_of_structures), 0);
}

TEST(StructureCheck, FindsForcesOfCrossedBodiesThatAreOffByABit) {
  const StructureRule forces =
      changed_structures([](StructurePush& push, const std::vector<Vec3>&) {
        for (Vec3& force : push.forces) force *= 1.0 + kBit;
      });
  const auto found_with = [](const StructureRule& rule) {
    return found([&](test::Random& random) {
      const Structures structures = any_crossed_structures(random);
      return have_gradient(structures, rule, random);
    });
  };

  EXPECT_GT(found_with(forces), kTrials / 3);
  EXPECT_EQ(found_with(push_of_structures), 0);
}

// What is left out where cores meet is a leap: the extent of facets, say.
TEST(StructureCheck, FindsEnergiesThatLeapWhereCoresCross) {
  const StructureRule leap = [](StructureScene& scene, const std::vector<Vec3>& x) {
    StructurePush push = push_of_structures(scene, x);
    push.energy *= 1.0 + 0.1 * static_cast<double>(scene.crossings());
    return push;
  };
  const auto found_with = [](const StructureRule& rule) {
    return found([&](test::Random& random) {
      return keep_energy(any_crossed_shells(random), rule, random);
    });
  };

  EXPECT_GT(found_with(leap), kTrials / 4);
  EXPECT_EQ(found_with(push_of_structures), 0);
}

TEST(StructureCheck, FindsForcesThatDoNotBalanceByABit) {
  const StructureRule uneven =
      changed_structures([](StructurePush& push, const std::vector<Vec3>&) {
        const auto largest =
            std::max_element(push.forces.begin(), push.forces.end(),
                             [](const Vec3& a, const Vec3& b) { return a.norm() < b.norm(); });
        *largest *= 1.0 + kBit;
      });
  const auto found_with = [](const StructureRule& rule) {
    return found([&](test::Random& random) {
      const Structures structures = any_structures(random);
      return are_balanced(structures, rule, random);
    });
  };

  EXPECT_GT(found_with(uneven), kTrials * 9 / 10);
  EXPECT_EQ(found_with(push_of_structures), 0);
}

// Of bars side by side there is more than their pieces, and of rings some is let pass.
TEST(StructureCheck, FindsStructuresThatAreABitLessThanTheirPieces) {
  const StructureRule less = changed_structures(
      [](StructurePush& push, const std::vector<Vec3>&) { push.energy *= 1.0 - kBit; });
  const auto found_with = [](const StructureRule& rule) {
    return found([&](test::Random& random) {
      const Structures bars = any_structures_of(StructureFamily::bars_on_bars, random);
      return count_pieces(bars, rule);
    });
  };

  EXPECT_GT(found_with(less), 3);
  EXPECT_EQ(found_with(push_of_structures), 0);
}

TEST(StructureCheck, FindsForcesThatDoNotChangeInProportion) {
  const StructureRule rattling =
      changed_structures([](StructurePush& push, const std::vector<Vec3>& x) {
        push.forces[0].x() += 1e-3 * kBit * std::sin(1e12 * x[0].x());
      });
  const auto found_with = [](const StructureRule& rule) {
    return found([&](test::Random& random) {
      const Structures structures = any_structures(random);
      return follow(structures, rule, random);
    });
  };

  EXPECT_GT(found_with(rattling), kTrials / 3);
  EXPECT_EQ(found_with(push_of_structures), 0);
}

// Bisection finds a jump that is larger than what the step changes the energy by besides.
TEST(StructureCheck, FindsEnergiesThatJumpByAHundredth) {
  int sum = 0;
  for (std::uint64_t seed = 0; seed < kTrials; ++seed) {
    test::Random random(seed);
    Structures structures = any_structures(random);
    while (!structures.are_sheets) structures = any_structures(random);
    const Vec3 start = structures.nodes().back();
    const StructureRule jumping =
        changed_structures([&](StructurePush& push, const std::vector<Vec3>& x) {
          if ((x.back() - start).norm() > 3e-6) push.energy *= 1.01;
        });
    const std::optional<bool> holds = follow(structures, jumping, random);
    sum += holds && !*holds;
  }

  EXPECT_GT(sum, kTrials / 2);
}

}  // namespace
}  // namespace plekton::geometry_check::check_test
