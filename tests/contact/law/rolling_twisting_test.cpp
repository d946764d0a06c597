// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law/rolling_twisting.hpp"

#include "contact/law/linear_frictional.hpp"
#include "contact/law/sum.hpp"
#include "tests/support/seeded_random.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <span>
#include <vector>

namespace plekton::contact::rolling_twisting_test {
namespace {

using Law = Sum<LinearFrictional, RollingTwisting>;
const Body kBody{{1e6, 0.4, 0.5}, 0.1};
const Body kLarger{{1e6, 0.4, 0.5}, 0.2};

ContactForce turn(const Law::Parameters& p, const Vec3& rotation, Law::History& history) {
  const double gap = -1e-3;
  return Law::force(p,
                    relative_motion(Vec3::UnitZ(), gap, Law::elastic_normal_force(p, gap),
                                    Vec3::Zero(), rotation),
                    history, 1.0);
}

TEST(RollingTwisting, IsASpringOfTheArmsTimesTheTangentialStiffness) {
  const auto p = Law::combine({{}, {0.3, 0.7}}, kBody, kLarger);
  const double stiffness = p.whole.tangential_stiffness * 0.1 * 0.2;
  Law::History history{};

  const ContactForce answer = turn(p, Vec3(1e-4, 0.0, 2e-4), history);

  EXPECT_NEAR(answer.moment[0], -0.3 * stiffness * 1e-4, 1e-16 * stiffness);
  EXPECT_NEAR(answer.moment[2], -0.7 * stiffness * 2e-4, 1e-16 * stiffness);
  EXPECT_NEAR(answer.dissipated, 0.0, 1e-15 * stiffness * 4e-8);
}

// It kept its moment for good, and a ball drove itself over a floor.
TEST(RollingTwisting, GivesUpItsMomentWithItsStiffness) {
  Law::History history{};
  turn(Law::combine({{}, {0.3, 0.7}}, kBody, kLarger), Vec3(1e-4, 0.0, 2e-4), history);

  const auto without_rolling = Law::combine({{}, {0.0, 0.7}}, kBody, kLarger);
  const ContactForce twisted = turn(without_rolling, Vec3::Zero(), history);
  const ContactForce free = turn(Law::combine({{}, {}}, kBody, kLarger), Vec3::Zero(), history);

  EXPECT_EQ(twisted.moment.head<2>().norm(), 0.0);
  EXPECT_NE(twisted.moment[2], 0.0);
  EXPECT_EQ(free.moment.norm(), 0.0);
}

TEST(RollingTwisting, SlidesAtTheLimitOfTheNormalForce) {
  const auto p = Law::combine({{}, {0.3, 0.7, 0.05, 0.02}}, kBody, kLarger);
  const double normal_force = Law::elastic_normal_force(p, -1e-3);
  Law::History history{};

  const ContactForce answer = turn(p, Vec3(1.0, 0.0, 1.0), history);

  EXPECT_NEAR(answer.moment[0], -0.05 * 0.1 * normal_force, 1e-12 * normal_force);
  EXPECT_NEAR(answer.moment[2], -0.02 * 0.1 * normal_force, 1e-12 * normal_force);
  EXPECT_GT(answer.dissipated, 0.0);
}

/// Of a contact whose bodies are the other way round: what b had is a's, and the normal turns over.
TEST(RollingTwisting, ExchangesItsBodiesByAShareBelowZero) {
  const RollingTwisting::History before{Vec3(0.3, -0.2, 0.0), 0.7, 1e-5};
  RollingTwisting::History after;

  RollingTwisting::accumulate_history(after, before, -1.0);

  const Vec3 normal = Vec3::UnitZ();
  EXPECT_EQ(RollingTwisting::moment(after, -normal), -RollingTwisting::moment(before, normal));
}

TEST(RollingTwisting, TurnsItsMomentWithTheContactButNotTheTwist) {
  const auto p = Law::combine({{}, {0.3, 0.7}}, kBody, kLarger);
  Law::History history{};
  const Vec3 before = turn(p, Vec3(1e-4, 0.0, 2e-4), history).moment;

  Law::rotate(history, {Vec3::UnitZ(), Vec3::UnitX(), 0.0});  // z to x, so x to -z

  EXPECT_NEAR(history.part.rolling[2], -before[0], 1e-15 * before.norm());
  EXPECT_EQ(history.part.twisting, before[2]);
}

/// What a ball of a radius meets as it turns among contacts with these normals: what slips, with
/// springs along the tangents, and what turns there, each per unit of angle.
Mat3 against_turning(std::span<const Vec3> normals, double slip, double rolling, double twisting) {
  Mat3 sum = Mat3::Zero();
  for (const Vec3& normal : normals) {
    const Mat3 along = normal * normal.transpose();
    sum += (slip + rolling) * (Mat3::Identity() - along) + twisting * along;
  }
  return sum;
}
double largest_eigenvalue(const Mat3& matrix) {
  return Eigen::SelfAdjointEigenSolver<Mat3>(matrix).eigenvalues()[2];
}

/// For a step; k_s r² = 1 is slip, of which the rest are multiples.
double effective_slip(double rolling, double twisting) {
  const Body ball{{1e6, 0.4, 0.5}, 0.1};
  const auto p = RollingTwisting::combine({rolling, twisting}, ball, ball);
  return RollingTwisting::effective(p, ContactStiffness{1.0, 1.0}).tangential;
}

// The larger of both was taken: of six contacts with both a fifth too little.
TEST(RollingTwisting, CountsForAStepAtLeastAsItResistsTurningOfABallThatIsHeldAllAround) {
  test::Random random(3);
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<Vec3> normals(1 + random.index(12));
    for (Vec3& normal : normals) normal = random.direction();
    const double rolling = random.coin() ? random.uniform(0.0, 5.0) : 0.0;
    const double twisting = random.coin() ? random.uniform(0.0, 5.0) : 0.0;

    const double counts = effective_slip(rolling, twisting);

    EXPECT_GE((1.0 + 1e-12) * largest_eigenvalue(against_turning(normals, counts, 0.0, 0.0)),
              largest_eigenvalue(against_turning(normals, 1.0, rolling, twisting)))
        << normals.size() << " contacts, " << rolling << ", " << twisting;
  }
}

TEST(RollingTwisting, CountsForAStepExactlyWithSixContactsThatRollAsTheyTwist) {
  const std::vector<Vec3> normals{Vec3::UnitX(),  Vec3::UnitY(),  Vec3::UnitZ(),
                                  -Vec3::UnitX(), -Vec3::UnitY(), -Vec3::UnitZ()};

  const double counts = effective_slip(0.8, 0.8);

  EXPECT_NEAR(largest_eigenvalue(against_turning(normals, counts, 0.0, 0.0)),
              largest_eigenvalue(against_turning(normals, 1.0, 0.8, 0.8)), 1e-14 * 10.0);
}

}  // namespace
}  // namespace plekton::contact::rolling_twisting_test
