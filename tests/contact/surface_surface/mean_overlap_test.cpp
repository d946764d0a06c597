// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/mean_overlap.hpp"

#include "contact/law/hertz_mindlin.hpp"
#include "tests/support/bodies_of_cells.hpp"
#include "tests/support/named_laws.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

/// What structures on structures are told about their contacts: how deep, how many, how stiff.
namespace plekton::test::mean_overlap_test {
namespace {

using contact::AnyLaw;
using contact::HertzMindlin;
using contact::structure::mean_overlap;

constexpr double kRange = 0.1;  // m
constexpr double kRadius = 0.5 * kRange;
constexpr double kOverlap = 1e-3;

const contact::Material kRubber{2e6, 0.5, 0.6, 0.4};

AnyLaw::Parameters parameters_of(const AnyLaw::Properties& law) {
  const contact::Body bar{kRubber, kRadius, 1.0, contact::Shape::cylinder};
  return AnyLaw::without_attraction(AnyLaw::combine(law, bar, bar));
}

// E and F of n equal contacts; five roundings.
TEST(MeanOverlap, IsThatOfEqualContactsUnderEveryLaw) {
  for (const NamedLaw& law : kLaws) {
    const AnyLaw::Parameters of_one = parameters_of(law.properties);
    for (const double contacts : {0.37, 1.0, 24.0}) {
      const double energy = contacts * AnyLaw::elastic_normal_energy(of_one, -kOverlap);
      const double force = contacts * AnyLaw::elastic_normal_force(of_one, -kOverlap);
      EXPECT_NEAR(mean_overlap(of_one, energy, force), kOverlap,
                  8.0 * std::numeric_limits<double>::epsilon() * kOverlap)
          << law.name;
    }
  }
}

TEST(MeanOverlap, OfLinearSpringsIsTwiceTheEnergyOverTheForceToTheBit) {
  const AnyLaw::Parameters linear = parameters_of(AnyLaw::of<contact::LinearFrictional>());
  for (const double energy : {0.1, 0.3, 7.7, 1e-9})
    EXPECT_EQ(mean_overlap(linear, energy, 3.1), 2.0 * energy / 3.1);
}

TEST(MeanOverlap, OfNoEnergyIsNone) {
  const AnyLaw::Parameters hertz = parameters_of(AnyLaw::of<HertzMindlin>());
  EXPECT_EQ(mean_overlap(hertz, 0.0, 2.0), 0.0);
  EXPECT_LT(mean_overlap(hertz, -1.0, 2.0), 0.0);
}

/// Two panels that meet in a ridge along x and fall away on both sides.
Body roof() {
  Body body;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.0, 0.5}) body.x.emplace_back(x, y, -std::abs(y));
  body.facets = {{0, 3, 1}, {1, 3, 4}, {1, 4, 2}, {2, 4, 5}};
  return body;
}

struct Touching {
  const char* name;
  Body a;
  Body b;  ///< from z = 0 on downwards it is what touches
  double contacts;
};

std::vector<Touching> touching_bodies() {
  const double turn = 0.5 * std::numbers::pi;
  const Vec3 aside(0.11, 0.07, 0.0);
  return {{"bars that cross", chain(1, 1.0), moved(chain(1, 0.8), {0.0, 0.0, turn}, aside), 1.0},
          {"ridge across ridge", roof(), moved(roof(), {2.0 * turn, 0.0, turn}, aside), 1.0},
          {"flat sheets", sheet(3, 3, 2.0, 2.0, Cut::alternating, 5),
           moved(sheet(2, 2, 0.8, 0.8, Cut::one_way, 3), {0.0, 0.0, 0.3}, aside),
           0.64 / (kRange * kRange)}};
}

// Bodies of half thickness r that cross or lie on each other press with R = r (curvature.hpp).
// Johnson, Contact Mechanics (1985): one contact has the normal stiffness 2 E* sqrt(R u) (section
// 4.2) and the tangential one 8 G* sqrt(R u) (section 7.2), as long as it does not slip.
TEST(MeanOverlap, GivesStructuresTheStiffnessOfHertzAndMindlin) {
  const double young = 1.0 / kRadius, poisson = 0.3;  // as StructurePairUnder has them
  const double plane_modulus = 0.5 * young / (1.0 - poisson * poisson);
  const double shear_modulus = 0.25 * young / ((1.0 + poisson) * (2.0 - poisson));
  const double radius = std::sqrt(kRadius * kOverlap);  // m, of the circle in which they touch
  const double slip = 1e-4 * kOverlap;                  // of facets' sides 1e-6
  for (const Touching& of : touching_bodies()) {
    SCOPED_TRACE(of.name);
    StructurePairUnder<HertzMindlin> pair(of.a, of.b, kRange, {}, 0.0, 0.6);
    const auto at = [&](double x) {
      return moved(of.b, Vec3::Zero(), {x, 0.0, kRange - kOverlap});
    };

    pair.place(at(0.0));
    pair.slide(at(slip));

    const double tangential = of.contacts * 8.0 * shear_modulus * radius;
    EXPECT_NEAR(-pair.force_on_b().x() / slip, tangential, 1e-4 * tangential);
    double normal = 0.0;
    pair.contacts().for_each_stiffness([&](NodeId, const contact::PairStiffness& stiffness,
                                           double) { normal += stiffness.normal; });
    const double of_both_sides = 2.0 * of.contacts * 2.0 * plane_modulus * radius;
    EXPECT_NEAR(normal, of_both_sides, 1e-5 * of_both_sides);
    int records = 0;
    pair.contacts().for_each_record(pair.positions(), [&](const contact::ContactRecord& record) {
      ++records;
      EXPECT_NEAR(record.gap, -kOverlap, 1e-5 * kOverlap);
    });
    EXPECT_EQ(records, 1);
  }
}

}  // namespace
}  // namespace plekton::test::mean_overlap_test
