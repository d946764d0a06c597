// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/lost_grains.hpp"

#include "geometry/base/state_archive.hpp"

#include <gtest/gtest.h>

namespace plekton::apps::lost_grains_test {
namespace {

using geometry::id_at;
using geometry::NodeId;
using geometry::Vec3;

constexpr std::array<std::array<double, 3>, 3> kCorners = {
    {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}};

/// A triangle in the plane z = height.
std::array<Vec3, 3> triangle_at(double height) {
  std::array<Vec3, 3> triangle;
  for (std::size_t k = 0; k < 3; ++k) triangle[k] = Vec3(kCorners[k][0], kCorners[k][1], height);
  return triangle;
}

/// A facet and a grain of radius 0.1 m, to be moved step by step.
class Scene {
 public:
  explicit Scene(const Vec3& grain, const std::vector<contact::Plane>& planes = {})
      : planes_(planes),
        positions_{{triangle_at(0.0)[0], triangle_at(0.0)[1], triangle_at(0.0)[2], grain}} {
    elements_.facets.push_back({{id_at<NodeId>(0), id_at<NodeId>(1), id_at<NodeId>(2)}, 0.01});
    elements_.spheres.push_back({{id_at<NodeId>(3)}, 0.1});
    surface_ = geometry::Surface({}, elements_.facets, positions_.size());
    neighbours_.emplace(elements_.spheres, surface_, 0.05);
    neighbours_->update(positions_, pool_);
    lost_.emplace(elements_, positions_, planes);
  }

  /// Moves the grain on a straight way in small steps, with a look after each.
  void move_to(const Vec3& target) {
    const Vec3 start = positions_[3];
    constexpr int kSteps = 100;
    for (int i = 1; i <= kSteps; ++i) {
      positions_[3] = start + (target - start) * (static_cast<double>(i) / kSteps);
      look();
    }
  }
  /// Moves the facet with the grain, without turning it.
  void carry_by(const Vec3& way) {
    constexpr int kSteps = 100;
    for (int i = 0; i < kSteps; ++i) {
      for (Vec3& x : positions_) x += way / kSteps;
      look();
    }
  }
  void set_gravity(const Vec3& gravity) { gravity_ = gravity; }
  /// Of the grain, m/s.
  void set_velocity(const Vec3& velocity) { velocities_[3] = velocity; }
  const LostGrains& lost() const { return *lost_; }
  LostGrains& lost() { return *lost_; }

 private:
  void look() {
    neighbours_->update(positions_, pool_);
    lost_->look(positions_, *neighbours_, {planes_, gravity_, velocities_});
  }

  std::vector<contact::Plane> planes_;
  Vec3 gravity_{0.0, 0.0, -9.81};
  std::vector<Vec3> velocities_ = std::vector<Vec3>(4, Vec3::Zero());
  std::vector<Vec3> positions_;
  geometry::Elements elements_;
  geometry::Surface surface_;
  geometry::ThreadPool pool_{1};
  std::optional<geometry::Neighbours> neighbours_;
  std::optional<LostGrains> lost_;
};

TEST(LostGrains, CountAGrainThatPassesThroughAFacet) {
  Scene scene({0.2, 0.2, 0.3});
  scene.move_to({0.2, 0.2, -0.3});

  EXPECT_EQ(scene.lost().through_membranes(), 1U);
  EXPECT_EQ(scene.lost().total(), 1U);
}

TEST(LostGrains, CountNoGrainThatGoesAroundTheRim) {
  Scene scene({0.2, 0.2, 0.3});
  scene.move_to({-0.3, 0.2, 0.3});
  scene.move_to({-0.3, 0.2, -0.3});
  scene.move_to({0.2, 0.2, -0.3});

  EXPECT_EQ(scene.lost().total(), 0U);
}

TEST(LostGrains, StayLostWhenTheyComeBack) {
  Scene scene({0.2, 0.2, 0.3});
  scene.move_to({0.2, 0.2, -0.3});
  scene.move_to({0.2, 0.2, 0.3});

  EXPECT_EQ(scene.lost().total(), 1U);
}

TEST(LostGrains, CountThoseThatStagesHaveTakenOut) {
  using geometry::StateArchive;
  Scene before({0.2, 0.2, 0.3});
  before.move_to({0.2, 0.2, -0.3});
  geometry::StateTree state;
  before.lost().exchange(StateArchive::writer(state));
  std::size_t removed = 2;
  exchange_removed(StateArchive::writer(state), removed);

  Scene after({0.2, 0.2, 0.3});
  after.lost().exchange(StateArchive::reader(state));

  EXPECT_EQ(after.lost().total(), 3U);
  geometry::StateTree again;
  after.lost().exchange(StateArchive::writer(again));
  EXPECT_EQ(again.hash(), state.hash());
}

/// As one that was written before the number was there.
TEST(LostGrains, AreThoseThatAreThereOfAStateThatKnowsOfNoOthers) {
  using geometry::StateArchive;
  Scene before({0.2, 0.2, 0.3});
  before.move_to({0.2, 0.2, -0.3});
  geometry::StateTree state;
  before.lost().exchange(StateArchive::writer(state));
  Scene after({0.2, 0.2, 0.3});
  after.lost().exchange(StateArchive::reader(state));

  EXPECT_FALSE(state.arrays.contains("removed"));
  EXPECT_EQ(after.lost().total(), 1U);
}

TEST(LostGrains, CountAGrainThatLeavesTheGrownBox) {
  Scene scene({0.2, 0.2, 0.3});
  scene.move_to(
      {0.2, 2.0, 0.3});  // the box is 1.01 m at its longest, grown by that it ends at 2.02 m
  EXPECT_EQ(scene.lost().total(), 0U);
  scene.move_to({0.2, 2.1, 0.3});

  EXPECT_EQ(scene.lost().out_of_bounds(), 1U);
  EXPECT_EQ(scene.lost().total(), 1U);
}

TEST(LostGrains, CountNoneThatFallsOnAPlaneFarBelow) {
  const contact::Plane floor{{0.0, 0.0, -50.0}, {0.0, 0.0, 1.0}};
  Scene scene({1.5, 0.2, 0.3}, {floor});

  scene.move_to({1.5, 0.2, -49.9});

  EXPECT_EQ(scene.lost().total(), 0U);
}

/// Near the wall at one side, from where it rolls to the other.
TEST(LostGrains, CountNoneThatIsAnywhereInAContainer) {
  using Form = contact::Plane::Form;
  for (const Form form : {Form::cylinder, Form::sphere}) {
    const contact::Plane wall{.point = {-20.0, 0.0, 0.0},
                              .normal = Vec3::Zero(),
                              .form = form,
                              .radius = 22.0,
                              .axis = Vec3::UnitZ()};
    Scene scene({0.2, 0.2, 0.3}, {wall});

    scene.move_to({-41.5, 0.2, 0.3});
    scene.move_to({-20.0, -21.5, 0.3});

    EXPECT_EQ(scene.lost().total(), 0U);
  }
}

contact::Plane flat(const Vec3& point, const Vec3& normal) {
  return {.point = point, .normal = normal};
}

// The floor ended where the box did, though a plane has no end.
TEST(LostGrains, CountNoneThatRollsAwayOnAFloorOrFliesAboveIt) {
  for (const Vec3& normal : {Vec3(0.0, 0.0, 1.0), Vec3(0.6, 0.0, 0.8)}) {
    Scene scene({0.2, 0.2, 0.3}, {flat({0.0, 0.0, -0.5}, normal)});
    scene.move_to({60.0, 0.2, 0.3});
    scene.move_to({60.0, 0.2, 50.0});

    EXPECT_EQ(scene.lost().total(), 0U);
  }
}

TEST(LostGrains, CountOneThatFallsBesideAWallBelowACeilingOrBehindAFloor) {
  const contact::Plane wall = flat({-1.0, 0.0, 0.0}, Vec3::UnitX());
  const contact::Plane ceiling = flat({0.0, 0.0, 2.0}, -Vec3::UnitZ());
  const contact::Plane floor = flat({0.0, 0.0, -0.5}, Vec3::UnitZ());
  for (const contact::Plane& plane : {wall, ceiling, floor}) {
    Scene scene({1.5, 0.2, 0.3}, {plane});
    scene.move_to({1.5, 0.2, -20.0});

    EXPECT_EQ(scene.lost().out_of_bounds(), 1U);
  }
}

TEST(LostGrains, CountNoneThatIsCarriedAwayByAMembrane) {
  Scene scene({0.2, 0.2, 0.3});
  scene.carry_by({60.0, 0.0, 0.0});
  EXPECT_EQ(scene.lost().total(), 0U);
  scene.move_to({64.0, 0.2, 0.3});  // the facet's longest side is 1.02 m with its thickness

  EXPECT_EQ(scene.lost().out_of_bounds(), 1U);
}

TEST(LostGrains, CountOneThatFallsOutOfACylinderAndNoneInABowl) {
  using Form = contact::Plane::Form;
  const auto lost_in = [](Form form, const Vec3& axis, double radius) {
    const contact::Plane wall{.point = Vec3::Zero(),
                              .normal = Vec3::Zero(),
                              .form = form,
                              .radius = radius,
                              .axis = axis};
    Scene scene({0.2, 0.2, 0.3}, {wall});
    scene.move_to({1.2, 0.2, 0.3});
    scene.move_to({1.2, 0.2, -30.0});
    return scene.lost().total();
  };

  EXPECT_EQ(lost_in(Form::cylinder, Vec3::UnitZ(), 5.0), 1U);
  EXPECT_EQ(lost_in(Form::cylinder, Vec3::UnitX(), 40.0), 0U);
  EXPECT_EQ(lost_in(Form::sphere, Vec3::Zero(), 40.0), 0U);
}

TEST(LostGrains, CountWithoutGravityOneThatFliesAwayAndNoneThatAPlaneIsAheadOf) {
  const auto lost_with = [](const Vec3& velocity) {
    Scene scene({0.2, 0.2, 0.3}, {flat({0.0, 0.0, -0.5}, Vec3::UnitZ())});
    scene.set_gravity(Vec3::Zero());
    scene.set_velocity(velocity);
    scene.move_to({30.0, 0.2, 30.0});
    return scene.lost().total();
  };

  EXPECT_EQ(lost_with({1.0, 0.0, 1.0}), 1U);
  EXPECT_EQ(lost_with({1.0, 0.0, 0.0}), 1U);
  EXPECT_EQ(lost_with({1.0, 0.0, -0.1}), 0U);
  EXPECT_EQ(lost_with(Vec3::Zero()), 0U);
}

TEST(LostGrains, CountNoneThatRollsOnAPlaneWithoutGravity) {
  Scene scene({1.5, 0.2, -0.41}, {flat({0.0, 0.0, -0.5}, Vec3::UnitZ())});
  scene.set_gravity(Vec3::Zero());
  scene.set_velocity({1.0, 0.0, 0.0});
  scene.move_to({30.0, 0.2, -0.41});

  EXPECT_EQ(scene.lost().total(), 0U);
}

TEST(LostGrains, WantToBeLookedAtTheMoreOftenTheFasterAnythingMoves) {
  const Scene scene({0.2, 0.2, 0.3});  // its grain has a radius of 0.1 m
  const auto steps_at = [&](double speed) {
    return scene.lost().steps_to_next_look(std::vector<Vec3>{Vec3::Zero(), {0.0, 0.0, -speed}},
                                           1e-3);
  };

  EXPECT_EQ(steps_at(0.0), LostGrains::kMostSteps);
  EXPECT_EQ(steps_at(1.0), LostGrains::kMostSteps);
  EXPECT_EQ(steps_at(5.0), 5);  // 2 x 5 steps x 5 mm = R / 2
  EXPECT_EQ(steps_at(1000.0), 1);
}

TEST(PassesThrough, SeesAFacetMoveOverAPointThatRests) {
  const Vec3 point(0.2, 0.2, 0.5);
  EXPECT_TRUE(passes_through(point, point, triangle_at(0.0), triangle_at(1.0)));
  EXPECT_FALSE(passes_through(point, point, triangle_at(0.0), triangle_at(0.4)));
}

TEST(PassesThrough, SeesNothingWhenBothMoveAlike) {
  EXPECT_FALSE(
      passes_through({0.2, 0.2, 0.5}, {0.2, 0.2, 1.5}, triangle_at(0.0), triangle_at(1.0)));
}

TEST(PassesThrough, MissesNoPointOnTheSeamBetweenTwoTriangles) {
  const auto left = triangle_at(0.0);
  const std::array<Vec3, 3> right = {Vec3(1.0, 0.0, 0.0), Vec3(1.0, 1.0, 0.0), Vec3(0.0, 1.0, 0.0)};
  for (int i = 1; i < 100; ++i) {
    const double t = i / 100.0;
    const Vec3 above(t, 1.0 - t, 0.3), below(t, 1.0 - t, -0.2);
    EXPECT_TRUE(passes_through(above, below, left, left) ||
                passes_through(above, below, right, right))
        << t;
  }
}

TEST(PassesThrough, IsImpossibleForATriangleWithoutArea) {
  const std::array<Vec3, 3> line = {Vec3::Zero(), Vec3(1.0, 0.0, 0.0), Vec3(2.0, 0.0, 0.0)};
  EXPECT_FALSE(passes_through({0.5, 0.0, 1.0}, {0.5, 0.0, -1.0}, line, line));
}

}  // namespace
}  // namespace plekton::apps::lost_grains_test
