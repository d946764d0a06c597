// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_surface/history_transfer.hpp"

#include "tests/support/ball_on_surface.hpp"

#include <gtest/gtest.h>

/// The tangential spring of a contact follows the ball, whatever elements it crosses.
namespace plekton::test::history_transfer_test {
namespace {

/// No sliding within the tests below.
constexpr Material kRough{1e6, 0.5, 1e3};
constexpr Material kSliding{1e6, 0.5, 0.3};

Vec3 tangential(const ContactRecord& row) {
  return row.tangential_force;
}

TEST(SlidingSphere, LoadsOneSpringAllTheWayOverAFlatMesh) {
  // Without spin the contact point moves with the ball: F = k_s s, opposite to the motion.
  const double spacing = 0.25;
  const double height = 0.95;
  for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(1, -1, 0), Vec3(0.9, 0.37, 0)}) {
    for (const double step : {0.004, 0.03, 0.6}) {
      SCOPED_TRACE(::testing::Message()
                   << "direction " << direction.transpose() << ", step " << step);
      SphereOnSurface ball(centred(sheet(16), 16, spacing), 0.9, kRough);
      const Vec3 stride = step * direction.normalized();
      ball.put(Vec3(-0.9 * direction.normalized() + height * Vec3::UnitZ()));
      const int steps = static_cast<int>(1.8 / step);
      for (int k = 1; k <= steps; ++k) {
        const Vec3 force = ball.move(stride);

        const Vec3 expected = -ball.parameters().tangential_stiffness * k * stride;
        ASSERT_NEAR((force - force[2] * Vec3::UnitZ() - expected).norm(), 0.0,
                    1e-9 * expected.norm());
        ASSERT_EQ(ball.contacts().touching(), 1u);
      }
    }
  }
}

TEST(SlidingSphere, KeepsItsSpringOverMeshesThatAreFlatButForRounding) {
  Random random(1);
  for (int trial = 0; trial < 10; ++trial) {
    const Mat3 turn = random.rotation();
    SphereOnSurface ball(rotated(centred(sheet(16), 16, 0.25), turn), 0.9, kRough);
    ball.put(turn * Vec3(-1.0, -0.75, 0.95));
    const Vec3 stride = turn * Vec3(0.01, 0, 0);  // along a line of edges
    for (int k = 1; k <= 180; ++k) {
      const Vec3 force = ball.move(stride);
      const Vec3 expected = -ball.parameters().tangential_stiffness * k * stride;
      const Vec3 normal = turn.col(2);
      ASSERT_NEAR((force - force.dot(normal) * normal - expected).norm(), 0.0,
                  1e-9 * expected.norm());
    }
  }
}

TEST(SlidingSphere, FeelsCoulombsForceAtEveryStepOnceItSlides) {
  SphereOnSurface ball(centred(sheet(16), 16, 0.25), 0.9, kSliding);
  ball.put(Vec3(-1.0, -1.0, 0.95));
  const Vec3 stride(0.01, 0.0063, 0);
  const double normal_force = ball.parameters().normal_stiffness * 0.05;
  for (int k = 1; k <= 150; ++k) {
    const Vec3 force = ball.move(stride);
    if (k < 10) continue;
    ASSERT_NEAR((force.head<2>() + 0.3 * normal_force * stride.head<2>().normalized()).norm(), 0.0,
                1e-9 * normal_force);
  }
}

TEST(SlidingSphere, KeepsItsSpringFromAFaceOverTheRimToTheOtherSide) {
  // First along the rim, then around it; the spring along the rim is square to that motion and
  // stays as it is.
  SphereOnSurface ball(centred(sheet(8), 8, 0.25), 0.9, kRough);
  ball.put(Vec3(0.8, -0.3, 0.95));
  for (int k = 0; k < 60; ++k) ball.move(Vec3(0, 0.01, 0));
  const double along = ball.forces().force.back()[1];
  EXPECT_NEAR(along, -0.6 * ball.parameters().tangential_stiffness, 1e-9 * std::abs(along));

  std::vector<Vec3> path;
  for (int k = 1; k <= 20; ++k) path.push_back(Vec3(0.8 + 0.01 * k, 0.3, 0.95));
  for (int k = 1; k <= 100; ++k) {
    const double angle = std::numbers::pi * k / 100;
    path.push_back(Vec3(1.0 + 0.95 * std::sin(angle), 0.3, 0.95 * std::cos(angle)));
  }
  for (int k = 1; k <= 20; ++k) path.push_back(Vec3(1.0 - 0.01 * k, 0.3, -0.95));
  for (const Vec3& place : path) {
    const Vec3 force = ball.move(place - ball.centre());
    ASSERT_EQ(ball.contacts().touching(), 1u);
    // The chords of the arc have a part along the turning normal, but none along the rim.
    ASSERT_NEAR(force[1], along, 1e-6 * std::abs(along)) << "at " << place.transpose();
  }
}

/// Two large facets that make a valley along y, each rising by this angle (rad).
Complex valley(double angle) {
  Complex result;
  result.node(Vec3(0, -8, 0));
  result.node(Vec3(0, 8, 0));
  result.facet(0, 1, result.node(Vec3(8 * std::cos(angle), 0, 8 * std::sin(angle))));
  result.facet(1, 0, result.node(Vec3(-8 * std::cos(angle), 0, 8 * std::sin(angle))));
  return result;
}

TEST(SphereInAValley, SharesItsSpringByNormalForceWhenItsContactSplits) {
  SphereOnSurface ball(valley(0.35), 0.9, kRough);
  const Vec3 off_centre(0.01, 0, 0);
  ball.put(Vec3(0, -0.1, 0.9995) + off_centre);
  ASSERT_EQ(ball.contacts().touching(), 1u);
  for (int k = 0; k < 10; ++k) ball.move(Vec3(0, 0.02, 0));
  const double whole = ball.forces().force.back()[1];

  ball.move(Vec3(0, 0, 0.001));

  const auto rows = ball.rows();
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_NEAR(ball.forces().force.back()[1], whole, 1e-9 * std::abs(whole));
  EXPECT_NE(rows[0].normal_force.norm(), rows[1].normal_force.norm());
  EXPECT_NEAR(tangential(rows[0])[1] / tangential(rows[1])[1],
              rows[0].normal_force.norm() / rows[1].normal_force.norm(), 1e-9);
}

TEST(SphereInAValley, AddsItsSpringsWhenItsContactsMerge) {
  SphereOnSurface ball(valley(0.35), 0.9, kRough);
  ball.put(Vec3(0.01, -0.1, 1.0005));
  ASSERT_EQ(ball.contacts().touching(), 2u);
  for (int k = 0; k < 10; ++k) ball.move(Vec3(0, 0.02, 0));
  const auto rows = ball.rows();
  const double sum = tangential(rows[0])[1] + tangential(rows[1])[1];
  EXPECT_NEAR(sum, 2.0 * 0.2 * ball.parameters().tangential_stiffness,
              1e-9 * sum);  // on the surface

  ball.move(Vec3(0, 0, -0.001));

  ASSERT_EQ(ball.contacts().touching(), 1u);
  EXPECT_NEAR(tangential(ball.rows()[0])[1], sum, 1e-9 * sum);
}

TEST(SphereInAValley, StaysWithinCoulombsConeWhenItsContactsMerge) {
  SphereOnSurface ball(valley(0.35), 0.9, kSliding);
  ball.put(Vec3(0.01, -0.1, 1.0005));
  for (int k = 0; k < 20; ++k) ball.move(Vec3(0, 0.02, 0));
  ball.move(Vec3(0, 0, -0.001));

  const auto rows = ball.rows();

  ASSERT_EQ(rows.size(), 1u);
  EXPECT_LE(tangential(rows[0]).norm(), 0.3 * rows[0].normal_force.norm() * (1.0 + 1e-12));
}

TEST(Ball, StartsANewSpringWhereItTouchesElsewhere) {
  // A floor and, far from the foot on it, a wall of the same surface.
  Complex corner;
  for (const Vec3& x : {Vec3(-9, -9, 0), Vec3(-9, 9, 0), Vec3(2, -9, 0), Vec3(2, 9, 0),
                        Vec3(2, -9, 9), Vec3(2, 9, 9)}) {
    corner.node(x);
  }
  corner.facet(0, 2, 3);
  corner.facet(0, 3, 1);
  corner.facet(2, 4, 5);
  corner.facet(2, 5, 3);
  SphereOnSurface ball(corner, 0.9, kRough);
  ball.put(Vec3(0, 0, 0.99));
  double travelled = 0.0;
  while (ball.contacts().touching() == 1) {
    ball.move(Vec3(0.03, 0, 0));
    travelled += 0.03;
  }

  const auto rows = ball.rows();
  ASSERT_EQ(rows.size(), 2u);
  const bool floor_first = rows[0].normal[2] < -0.5;
  EXPECT_NEAR(tangential(rows[floor_first ? 0 : 1])[0],
              ball.parameters().tangential_stiffness * travelled,
              1e-9 * ball.parameters().tangential_stiffness);
  EXPECT_NEAR(tangential(rows[floor_first ? 1 : 0]).norm(), 0.0,
              1e-9 * ball.parameters().tangential_stiffness);
}

TEST(Ball, LosesItsSpringWhenItLetsGo) {
  SphereOnSurface ball(centred(sheet(8), 8, 0.25), 0.9, kRough);
  ball.put(Vec3(0, 0, 0.99));
  ball.move(Vec3(0.1, 0, 0));
  const double energy = ball.contacts().elastic_energy();
  const double normal_energy = 0.5 * ball.parameters().normal_stiffness * 0.01 * 0.01;

  ball.move(Vec3(0, 0, 0.1));
  const double dissipated = ball.dissipated();
  const Vec3 force = ball.move(Vec3(0, 0, -0.1));

  EXPECT_NEAR(dissipated, energy - normal_energy, 1e-9 * energy);
  EXPECT_NEAR(force.head<2>().norm(), 0.0, 1e-12 * force.norm());
}

TEST(Ball, FeelsTheSameWhateverTheOrderInWhichTheSurfaceWasCreated) {
  Random random(2);
  for (int trial = 0; trial < 10; ++trial) {
    // Every other time so fine and rough that passes close rings.
    const double spacing = trial % 2 == 0 ? 0.4 : 0.1;
    const Complex complex =
        roughened(centred(sheet(16), 16, spacing), spacing, trial % 2 == 0 ? 0.05 : 0.01, random);
    SphereOnSurface first(complex, 0.9, kSliding);
    SphereOnSurface second(reordered(complex, random), 0.9, kSliding);
    const Vec3 start(-0.3, -0.3, 0.96);
    first.put(start);
    second.put(start);
    for (int k = 0; k < 300; ++k) {
      const Vec3 stride =
          (spacing + 0.1) * Vec3(0.005, 0.006 * std::sin(0.05 * k), 0.002 * std::cos(0.1 * k));
      first.spin().back() = second.spin().back() = random.in_cube(0.01);
      const Vec3 force = first.move(stride);
      ASSERT_NEAR((second.move(stride) - force).norm(), 0.0,
                  1e-9 * first.parameters().normal_stiffness * 0.02)
          << "step " << k;
    }
  }
}

/// Two faces of a valley below a ball, and a contact of the last step.
struct Valley {
  static constexpr double kSpring = 1e6;  // N/m, along the normal; half of it across
  Complex complex = valley(0.35);
  Surface surface{complex.cylinders, complex.facets, complex.x.size() + 1};
  std::vector<Vec3> still = std::vector<Vec3>(complex.x.size() + 1, Vec3::Zero());
  PatchFinder finder{surface};
  HistoryTransfer transfer{surface};
  SphereSurfacePair pair{0.9, 1.0, 1.0, 0.0, id_at<NodeId>(complex.x.size()), {}};
  const Vec3 slip{0.0, 0.002, 0.0};  // m
  std::vector<PatchContact> last;
  std::vector<Feature> minima;

  explicit Valley(const Vec3& centre) {
    complex.x.push_back(centre);
    // Bodies as large as 1 m: E R is the spring.
    pair.parameters = MaterialPairs({{kSpring, 0.5, 1e3}})
                          .combine(BodyPart{MaterialId{0}, 1.0}, BodyPart{MaterialId{0}, 1.0});
  }

  void add_last(std::int64_t id, double elastic_force, const std::vector<Feature>& on) {
    ContactMemory<AnyLaw> memory;
    memory.history.keep(*pair.parameters.law, LinearFrictional::History{slip});
    memory.normal = -Vec3::UnitZ();
    last.push_back({memory, Vec3(0, 0, -1), -0.01, elastic_force, 0.0, id,
                    static_cast<std::uint32_t>(minima.size()),
                    static_cast<std::uint32_t>(on.size())});
    minima.insert(minima.end(), on.begin(), on.end());
  }

  PatchesOfPair now() {
    return {pair, finder.find(complex.x.back(), 1.0, all_cells(surface), complex.x), finder};
  }
  ContactsOfPair before() const { return {last, minima.data()}; }
  Motion motion() const { return {complex.x, still, still}; }
  /// J, of one spring with all of the slip.
  double energy() const { return 0.5 * 0.5 * kSpring * slip.squaredNorm(); }
};

/// That pushes with a force (N), along the last normal.
PatchState pushing(double elastic_force) {
  PatchState state;
  state.normal = -Vec3::UnitZ();
  state.gap = -0.01;
  state.elastic_force = elastic_force;
  return state;
}

Vec3 slip_of(const Transferred& transferred) {
  return transferred.history.as<LinearFrictional::History>().elastic_slip;
}

TEST(HistoryTransfer, SharesASlipByForceAndGivesTheNumberToTheLargest) {
  Valley valley(Vec3(0.01, 0, 1.0005));
  valley.add_last(7, 4.0, {Feature(FaceId{0}), Feature(FaceId{1})});
  const std::vector<PatchState> states{pushing(1.0), pushing(3.0)};
  const auto now = valley.now();
  ASSERT_EQ(now.patches.size(), 2u);

  const auto loss = valley.transfer.to_patches(now, valley.before(), states, valley.motion(), 1e-3);

  EXPECT_NEAR((slip_of(valley.transfer.of_patch(0)) - 0.25 * valley.slip).norm(), 0.0, 1e-15);
  EXPECT_NEAR((slip_of(valley.transfer.of_patch(1)) - 0.75 * valley.slip).norm(), 0.0, 1e-15);
  EXPECT_EQ(valley.transfer.of_patch(0).id, 0);
  EXPECT_EQ(valley.transfer.of_patch(1).id, 7);
  EXPECT_EQ(loss.dissipated, 0.0);
  EXPECT_NEAR(loss.tracking, (1.0 - 0.0625 - 0.5625) * valley.energy(), 1e-12 * valley.energy());
}

TEST(HistoryTransfer, KeepsTheNumberOfTheLargestOfContactsThatMerge) {
  Valley valley(Vec3(0.01, 0, 0.9995));
  valley.add_last(3, 1.0, {Feature(FaceId{0})});
  valley.add_last(4, 2.0, {Feature(FaceId{1})});
  const auto now = valley.now();
  ASSERT_EQ(now.patches.size(), 1u);

  valley.transfer.to_patches(now, valley.before(), std::vector{pushing(3.0)}, valley.motion(),
                             1e-3);

  EXPECT_EQ(valley.transfer.of_patch(0).id, 4);
  EXPECT_NEAR((slip_of(valley.transfer.of_patch(0)) - 2.0 * valley.slip).norm(), 0.0, 1e-15);
}

TEST(HistoryTransfer, DissipatesWhatNothingFollows) {
  Valley valley(Vec3(0, 0, 3.0));
  valley.add_last(1, 1.0, {Feature(FaceId{0})});
  const auto now = valley.now();
  ASSERT_TRUE(now.patches.empty());

  const auto loss = valley.transfer.to_patches(now, valley.before(), {}, valley.motion(), 1e-3);

  EXPECT_NEAR(loss.dissipated, valley.energy(), 1e-12 * valley.energy());
  EXPECT_EQ(loss.tracking, 0.0);
}

TEST(HistoryTransfer, GivesASingleFeatureWhatTheGeneralWayGivesToTheLastBit) {
  // The ball is over the one face, and its contact was on the other one.
  Valley valley(Vec3(2.0, 0, 1.7));
  valley.add_last(5, 1.0, {Feature(FaceId{1})});
  const auto now = valley.now();
  ASSERT_EQ(now.patches.size(), 1u);
  ASSERT_EQ(now.patches[0].root, Feature(FaceId{0}));
  PatchState state = pushing(1.0);
  state.normal = Vec3(0.1, 0.2, -1.0).normalized();
  state.twist_rate = 3.0;

  const auto loss =
      valley.transfer.to_patches(now, valley.before(), std::vector{state}, valley.motion(), 1e-3);
  Transferred alone;
  const auto loss_alone =
      valley.transfer.to_single_feature(now, valley.before(), state, valley.motion(), 1e-3, alone);

  EXPECT_EQ(alone.id, 5);
  EXPECT_EQ(alone.id, valley.transfer.of_patch(0).id);
  EXPECT_EQ(alone.history.numbers, valley.transfer.of_patch(0).history.numbers);
  EXPECT_EQ(loss_alone.tracking, loss.tracking);
  EXPECT_EQ(loss_alone.dissipated, loss.dissipated);
}

TEST(HistoryTransfer, CountsContactsThatGoOnWithTheOppositeNormalWhereTheCentreIsByTheCore) {
  Valley valley(Vec3(0.01, 0, 0.9995));
  valley.add_last(3, 1.0, {Feature(FaceId{0})});
  PatchState turned = pushing(1.0);
  turned.normal = Vec3::UnitZ();
  PatchState through = turned;
  through.gap = 0.1 - valley.pair.range;
  const auto now = valley.now();

  valley.transfer.begin_step();
  valley.transfer.to_patches(now, valley.before(), std::vector{pushing(1.0)}, valley.motion(),
                             1e-3);
  EXPECT_EQ(valley.transfer.pass_throughs(), 0);
  valley.transfer.to_patches(now, valley.before(), std::vector{turned}, valley.motion(), 1e-3);
  EXPECT_EQ(valley.transfer.pass_throughs(), 0);
  valley.transfer.to_patches(now, valley.before(), std::vector{through}, valley.motion(), 1e-3);
  EXPECT_EQ(valley.transfer.pass_throughs(), 1);
  valley.transfer.begin_step();
  EXPECT_EQ(valley.transfer.pass_throughs(), 0);
}

}  // namespace
}  // namespace plekton::test::history_transfer_test
