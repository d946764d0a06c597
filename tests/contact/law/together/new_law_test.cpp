// SPDX-License-Identifier: GPL-3.0-or-later
// A law that the library has never seen goes through the same kernels as its own, in lanes where
// there are lanes. (Its properties are tested with those of all laws, law_properties_test.cpp.)
#include "contact/law/lane_law.hpp"
#include "contact/models.hpp"
#include "contact/sphere_sphere/sphere_kernel.hpp"
#include "geometry/base/rows.hpp"
#include "geometry/base/vector_width.hpp"
#include "tests/support/complexes.hpp"
#include "tests/support/one_at_a_time.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/weakening_slider.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace plekton::contact::new_law_test {
namespace {

using geometry::Sphere;
using geometry::Surface;
using test::Random;
using test::WeakeningSlider;
static_assert(LaneLaw<WeakeningSlider>);
static_assert(sizeof(WeakeningSlider::History) == 4 * sizeof(double));

constexpr double kStep = 2e-3;  // s

/// Two layers of spheres under a plane and on a sheet, which a chain of cylinders crosses; all of
/// them move a little.
struct Place {
  Place() {
    complex = test::sheet(kCells);
    for (int i = 0; i <= kCells; ++i) complex.node(Vec3(i, 0.3 * i + 0.4, -0.19));
    const int first = (kCells + 1) * (kCells + 1);
    for (int i = 0; i < kCells; ++i) complex.cylinder(first + i, first + i + 1);
    Random random(5);
    for (int layer = 0; layer < 2; ++layer) {
      for (int k = 0; k < kCells * kCells; ++k) {
        const Vec3 centre(0.5 + k % kCells, 0.5 + k / kCells, 0.58 + 0.98 * layer);
        spheres.push_back({{NodeId{complex.node(centre + random.in_cube(0.02))}}, 0.5});
      }
    }
    for (std::size_t i = 0; i < complex.x.size(); ++i) {
      velocity.push_back(random.in_cube(0.2));
      spin.push_back(random.in_cube(2.0));
    }
  }

  static constexpr int kCells = 8;
  test::Complex complex;
  std::vector<Sphere> spheres;
  std::vector<Vec3> velocity;
  std::vector<Vec3> spin;
  std::vector<Plane> planes{{Vec3(0, 0, 2.04), -Vec3::UnitZ(), Vec3(0.05, 0, 0), MaterialId{0}}};
};

struct Outcome {
  NodeForces forces{0};  ///< N, N m, summed over the steps
  double energy = 0.0;
  double dissipated = 0.0;
  ContactCounts counts;
};

template <class Law = WeakeningSlider>
Outcome outcome_of(int threads) {
  Place place;
  std::vector<Vec3>& x = place.complex.x;
  const Surface surface = place.complex.surface();
  const MaterialId stone{0};
  const auto contacts =
      model_of<Law>()({.spheres = place.spheres,
                       .surface = surface,
                       .materials = {Material{1e6, 0.5, 0.4}},
                       .of_spheres = std::vector<MaterialId>(place.spheres.size(), stone),
                       .of_structures = std::vector<MaterialId>(surface.structure_count(), stone),
                       .masses = {},
                       .skin = 0.05,
                       .meets_planes = {},
                       .rest = {}});
  geometry::ThreadPool pool(threads);
  Outcome outcome{NodeForces(x.size()), 0.0, 0.0, {}};
  for (int step = 0; step < 30; ++step) {
    const double to_and_fro = step % 10 < 5 ? kStep : -kStep;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += to_and_fro * place.velocity[i];
    contacts->advance({x, place.velocity, place.spin}, place.planes, kStep, pool, outcome.forces);
  }
  outcome.energy = contacts->elastic_energy();
  outcome.dissipated = contacts->dissipated();
  outcome.counts = contacts->counts();
  return outcome;
}

void expect_same_bits(const Outcome& a, const Outcome& b) {
  EXPECT_EQ(a.forces.force, b.forces.force);
  EXPECT_EQ(a.forces.torque, b.forces.torque);
  EXPECT_EQ(a.energy, b.energy);
  EXPECT_EQ(a.dissipated, b.dissipated);
}

TEST(NewLaw, ActsInContactsOfEveryKind) {
  const ContactCounts counts = outcome_of(1).counts;

  EXPECT_GT(counts.sphere_sphere, 64U);
  EXPECT_GT(counts.sphere_surface, 32U);
  EXPECT_GT(counts.between_structures, 0U);
  EXPECT_GT(counts.with_planes, 32U);
}

TEST(NewLaw, SlidesAndSticks) {
  const Outcome outcome = outcome_of(1);

  EXPECT_GT(outcome.energy, 0.0);
  EXPECT_GT(outcome.dissipated, 0.0);
}

TEST(NewLaw, HasTheSameBitsForAnyNumberOfThreads) {
  const Outcome of_one = outcome_of(1);

  for (const int threads : {2, 4}) expect_same_bits(outcome_of(threads), of_one);
}

TEST(NewLaw, HasTheSameBitsWrittenForOneContactAtATime) {
  using PlainLaw = test::OneAtATime<WeakeningSlider>;
  static_assert(ContactLaw<PlainLaw> && !LaneLaw<PlainLaw>);

  expect_same_bits(outcome_of<PlainLaw>(1), outcome_of(1));
}

template <class Width>
class NewLawInLanes : public testing::Test {};
using Widths = testing::Types<geometry::Width<2>, geometry::Width<4>, geometry::Width<8>>;
TYPED_TEST_SUITE(NewLawInLanes, Widths);

TYPED_TEST(NewLawInLanes, KeepsItsWholeHistory) {
  constexpr int kWidth = TypeParam::value;
  using Real = Pack<kWidth>;
  Random random(9);
  geometry::RowsOf<WeakeningSlider::History, 8> rows;
  std::vector<WeakeningSlider::History> plain;
  const WeakeningSlider::Parameters p{1e4, 1e6, 3e3, 0.5, 1e-5};
  const Vec3 normal = Vec3::UnitZ();
  std::vector<Vec3> slips;
  for (std::size_t lane = 0; lane < std::size_t{kWidth}; ++lane) {
    plain.push_back({1e-6 * normal.cross(random.direction()), 1e-5 * random.unit()});
    rows.set(lane, plain.back());
    slips.push_back(normal.cross(random.direction()));
  }
  auto packs = rows.template load<WeakeningSlider::HistoryOf<Real>>(0);
  geometry::RowsOf<Vec3, 8> slip_rows;
  for (std::size_t lane = 0; lane < slips.size(); ++lane) slip_rows.set(lane, slips[lane]);
  const RelativeMotionOf<Real> motion{
      {0.0, 0.0, 1.0}, slip_rows.template load<Vec3Of<Real>>(0), -1e-5, 0.0, 0.1};
  WeakeningSlider::force<Real>(
      {p.normal_stiffness, p.stiffening, p.tangential_stiffness, p.friction, p.polishing_way},
      motion, packs, 1e-5);
  rows.store(0, packs);

  for (std::size_t lane = 0; lane < plain.size(); ++lane) {
    const double before = plain[lane].way_slid;
    WeakeningSlider::force(p, {normal, slips[lane], -1e-5, 0.0, 0.1}, plain[lane], 1e-5);
    const auto after = rows.template at<WeakeningSlider::History>(lane);
    EXPECT_EQ(after.elastic_slip, plain[lane].elastic_slip);
    EXPECT_EQ(after.way_slid, plain[lane].way_slid);
    EXPECT_GE(after.way_slid, before);
  }
}

}  // namespace
}  // namespace plekton::contact::new_law_test
