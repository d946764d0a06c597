// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/carry_over/carried_planes.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace plekton::dynamics::carried_planes_test {
namespace {

contact::Plane plane_of(double height, const Vec3& velocity) {
  contact::Plane plane{Vec3(0, 0, height), Vec3::UnitZ()};
  plane.velocity = velocity;
  return plane;
}

/// One plane, which moved on from where it was made.
class CarriedPlanes : public testing::Test {
 protected:
  CarriedPlanes() {
    before_.planes = {plane_of(1.0, Vec3(0, 0, 5))};
    now_.planes = {plane_of(3.0, Vec3(4, 0, 5))};  // as it moved on, in the new scene
    made_ = {plane_of(2.0, Vec3(1, 0, -1))};
    change_.places.planes = {0};
  }

  const contact::Plane& settled() {
    settle_planes(before_, change_, made_, now_);
    return now_.planes[0];
  }

  Scene before_, now_;
  std::vector<contact::Plane> made_;
  SceneChange change_;
};

TEST_F(CarriedPlanes, StayWhereTheyAreWithTheVelocityOfTheirScene) {
  EXPECT_EQ(settled().point.z(), 3.0);
  EXPECT_EQ(now_.planes[0].velocity, Vec3(1, 0, -1));
}

TEST_F(CarriedPlanes, AreWhereTheirSceneHasThemIfTheyWereMovedThere) {
  change_.moved_planes = {true};
  EXPECT_EQ(settled().point.z(), 2.0);
  EXPECT_EQ(now_.planes[0].velocity, Vec3(1, 0, -1));
}

TEST_F(CarriedPlanes, ThatAMotionDrivesKeepTheVelocityThatItSets) {
  now_.loads.plane_motions.push_back({.plane = 0, .velocity = Vec3(4, 0, 5)});
  EXPECT_EQ(settled().velocity, Vec3(4, 0, 5));
}

TEST_F(CarriedPlanes, ThatAServoTakesOverFromAMotionKeepTheirPaceAlongTheNormalAlone) {
  before_.loads.plane_motions.push_back({.plane = 0, .velocity = Vec3(4, 0, 5)});
  now_.loads.servos.push_back({.plane = 0, .force = 1.0, .largest_speed = 1.0});
  EXPECT_EQ(settled().velocity, Vec3(1, 0, 5));
}

TEST_F(CarriedPlanes, ThatAServoGoesOnDrivingKeepTheirPace) {
  before_.loads.servos.push_back({.plane = 0, .force = 1.0, .largest_speed = 1.0});
  now_.loads.servos = before_.loads.servos;
  EXPECT_EQ(settled().velocity, Vec3(4, 0, 5));
}

TEST_F(CarriedPlanes, WidenAsTheirSceneHasItUnlessAServoDrivesThem) {
  for (contact::Plane* plane : {&now_.planes[0], &made_[0]}) {
    plane->form = contact::Plane::Form::sphere;
    plane->radius = 1.0;
  }
  now_.planes[0].widening = 0.25;
  EXPECT_EQ(settled().widening, 0.0);
  now_.planes[0].widening = 0.25;
  now_.loads.servos.push_back({.plane = 0, .pressure = 1.0, .largest_speed = 1.0});
  EXPECT_EQ(settled().widening, 0.25);
}

}  // namespace
}  // namespace plekton::dynamics::carried_planes_test
