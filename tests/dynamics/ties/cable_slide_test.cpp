// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/ties/cable_slide.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace plekton::dynamics::cable_slide_test {
namespace {

/// Nodes 0, 1, ... at these places, in a chain.
struct Chain {
  explicit Chain(std::vector<Vec3> places, bool is_closed = false) : x(std::move(places)) {
    for (std::size_t i = 0; i < x.size(); ++i) cable.nodes.push_back(geometry::id_at<NodeId>(i));
    cable.is_closed = is_closed;
    is_there.assign(cable.segments(), char{1});
  }
  CableShape shape() const { return {cable, is_there, x}; }
  Vec3 place(CablePosition at) const {
    return shape().start(at.segment) + at.along * shape().chord(at.segment);
  }

  std::vector<Vec3> x;
  Cable cable;
  std::vector<char> is_there;
};

/// Two segments of 1 m at a right angle: along x, then along y.
Chain corner() {
  return Chain({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0)});
}

Tie tie(double friction, double slip_force, double rest_length = 0.0) {
  Tie tie{.node = NodeId{9}, .to = CablePlace{}, .stiffness = 100.0};
  tie.rest_length = rest_length;
  tie.pushes = false;
  tie.friction = friction;
  tie.slip_force = slip_force;
  return tie;
}

TEST(CableSlide, GoesToTheFootOfThePoint) {
  const Slide slide = slide_to_nearest(corner().shape(), Vec3(0.25, -0.5, 3.0), {0, 0.75});

  EXPECT_EQ(slide.to.segment, 0U);
  EXPECT_DOUBLE_EQ(slide.to.along, 0.25);
  EXPECT_DOUBLE_EQ(slide.distance, -0.5);
}

TEST(CableSlide, CrossesASeamOfAStraightCableWithoutAJump) {
  const Chain straight({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(3, 0, 0), Vec3(4, 0, 0)});

  const Slide slide = slide_to_nearest(straight.shape(), Vec3(3.5, 1, 0), {0, 0.5});

  EXPECT_EQ(slide.to.segment, 2U);
  EXPECT_DOUBLE_EQ(slide.to.along, 0.5);
  EXPECT_DOUBLE_EQ(slide.distance, 3.0);
}

/// The distance of a point that goes round a corner, inside and outside of it, has no jump: its
/// steps are no longer than those of the point.
TEST(CableSlide, KeepsTheDistanceContinuousRoundACornerOnEitherSide) {
  const Chain chain = corner();
  for (const Vec3& step : {Vec3(1e-3, 1e-3, 0.0), Vec3(0.7e-3, 1e-3, 0.0)}) {
    for (const Vec3& start : {Vec3(0.5, 0.1, 0.0), Vec3(0.8, -0.4, 0.0)}) {
      Vec3 point = start;
      CablePosition at = slide_to_nearest(chain.shape(), point, {0, 0.5}).to;
      double before = (point - chain.place(at)).norm();
      for (int i = 0; i < 600; ++i) {
        point += step;
        at = slide_to_nearest(chain.shape(), point, at).to;
        const double now = (point - chain.place(at)).norm();
        EXPECT_LE(std::abs(now - before), 1.0001 * step.norm()) << i;
        before = now;
      }
      EXPECT_EQ(at.segment, 1U);
    }
  }
}

TEST(CableSlide, EndsWhereTheCableEndsAndWhereItIsTorn) {
  Chain chain = corner();
  EXPECT_EQ(slide_to_nearest(chain.shape(), Vec3(-2, 0, 0), {1, 0.5}).to.segment, 0U);
  EXPECT_DOUBLE_EQ(slide_to_nearest(chain.shape(), Vec3(-2, 0, 0), {0, 0.5}).to.along, 0.0);

  chain.is_there[0] = 0;

  const Slide slide = slide_to_nearest(chain.shape(), Vec3(-2, 0, 0), {1, 0.5});
  EXPECT_EQ(slide.to.segment, 1U);
  EXPECT_DOUBLE_EQ(slide.to.along, 0.0);
}

TEST(CableSlide, GoesRoundAClosedCable) {
  const Chain ring({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 1, 0)}, true);

  const Slide slide = slide_to_nearest(ring.shape(), Vec3(0.2, 0.55, 0), {0, 0.1});

  EXPECT_EQ(slide.to.segment, 2U);
  EXPECT_LT(slide.distance, 0.0);
}

/// Force along the cable 100 N/m times 0.3 m, across it 100 N/m times 0.4 m.
TEST(CableSlide, HoldsBelowTheLimitOfCoulomb) {
  const Vec3 node(0.8, 0.4, 0.0);

  EXPECT_EQ(slide_with_friction(corner().shape(), tie(0.76, 0.0), node, {0, 0.5}).distance, 0.0);
  EXPECT_EQ(slide_with_friction(corner().shape(), tie(0.0, 30.1), node, {0, 0.5}).distance, 0.0);
  EXPECT_EQ(slide_with_friction(corner().shape(), tie(0.5, 10.1), node, {0, 0.5}).distance, 0.0);
}

TEST(CableSlide, SlidesUntilCoulombHoldsIt) {
  const Vec3 node(0.8, 0.4, 0.0);

  // 100 u = mu 40 + B, u the distance to the foot.
  const auto distance = [&](double friction, double slip_force) {
    return slide_with_friction(corner().shape(), tie(friction, slip_force), node, {0, 0.5})
        .distance;
  };
  EXPECT_NEAR(distance(0.5, 0.0), 0.3 - 0.2, 1e-15);
  EXPECT_NEAR(distance(0.0, 10.0), 0.3 - 0.1, 1e-15);
  EXPECT_NEAR(distance(0.25, 5.0), 0.3 - 0.15, 1e-15);
}

/// With a rest length of 0.3 m: F = 100 (d - 0.3), F u / d = mu F p / d + B.
TEST(CableSlide, SlidesUntilCoulombHoldsATieWithARestLength) {
  const Vec3 node(0.8, 0.4, 0.0);
  const double friction = 0.25;
  const double slip_force = 3.0;

  const Slide slide =
      slide_with_friction(corner().shape(), tie(friction, slip_force, 0.3), node, {0, 0.5});

  const double along = 0.3 - slide.distance;
  const double distance = std::hypot(along, 0.4);
  const double force = 100.0 * (distance - 0.3);
  EXPECT_GT(slide.distance, 0.0);
  EXPECT_NEAR(force * along / distance, friction * force * 0.4 / distance + slip_force, 1e-12);
}

TEST(CableSlide, WithFrictionCrossesSeamsAndCorners) {
  const Chain straight({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(3, 0, 0), Vec3(4, 0, 0)});

  const Slide forwards =
      slide_with_friction(straight.shape(), tie(0.5, 0.0), Vec3(3.6, 0.4, 0), {0, 0.5});
  EXPECT_EQ(forwards.to.segment, 2U);
  EXPECT_NEAR(forwards.distance, 2.9, 1e-15 * 10);
  const Slide backwards =
      slide_with_friction(straight.shape(), tie(0.5, 0.0), Vec3(0.4, 0.4, 0), {2, 0.5});
  EXPECT_EQ(backwards.to.segment, 0U);
  EXPECT_NEAR(backwards.distance, -2.9, 1e-15 * 10);
  const Slide round =
      slide_with_friction(corner().shape(), tie(0.0, 10.0), Vec3(1.2, 0.6, 0.0), {0, 0.5});
  EXPECT_EQ(round.to.segment, 1U);
  EXPECT_NEAR(round.to.along, 0.5, 1e-15 * 10);
}

TEST(CableSlide, PassesSegmentsWithoutLengthAndStopsOnARingOfThem) {
  const Chain with_knot({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)});
  const Chain knot({Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)}, true);
  const Vec3 node(1.5, 0.1, 0.0);

  EXPECT_EQ(slide_with_friction(with_knot.shape(), tie(0.5, 0.0), node, {0, 0.5}).to.segment, 2U);
  EXPECT_EQ(slide_with_friction(knot.shape(), tie(0.5, 0.0), node, {0, 0.5}).distance, 0.0);
}

}  // namespace
}  // namespace plekton::dynamics::cable_slide_test
