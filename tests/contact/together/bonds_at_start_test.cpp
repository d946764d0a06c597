// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law/cohesive_frictional.hpp"
#include "contact/models.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

/// Which contacts are glued: those of the first step, or those that come later too.
namespace plekton::contact::bonds_at_start_test {
namespace {

constexpr double kRadius = 0.05;  // m, of all bodies
constexpr double kLimit = 2e-4;   // m, by which a bond of one contact stretches
constexpr double kModulus = 1e7;  // Pa: 5e5 N/m for a contact
constexpr double kStrength = kModulus * kLimit / kRadius;  // Pa

/// A ball over a ball, a ball over a sheet, a chain over a sheet, and a ball over a plane, all of
/// them at the same gap.
class Pairs {
 public:
  explicit Pairs(Bonds bonds)
      : contacts_(model_of<CohesiveFrictional>(
            {{{MaterialId{0}, MaterialId{0}}, {kStrength, kStrength, 0.0, bonds}}})(
            {.spheres = spheres_,
             .surface = surface_,
             .materials = {Material{kModulus, 0.5, 0.4}},
             .of_spheres = std::vector<MaterialId>(4, MaterialId{0}),
             .of_structures = std::vector<MaterialId>(surface_.structure_count(), MaterialId{0}),
             .masses = {},
             .skin = 0.01,
             .meets_planes = {},
             .rest = {}})) {}

  /// N, up, on what is above, in the order of the pairs.
  std::array<double, 4> forces_at(double gap) {
    const double up = 2.0 * kRadius + gap;
    for (const std::size_t node : {1U, 2U, 8U, 9U}) x_[node].z() = up;
    x_[3].z() = kRadius + gap - 1.0;
    forces_.set_zero();
    contacts_->advance({x_, still_, still_}, {{{Vec3(0, 0, -1), Vec3::UnitZ()}}}, 1e-4, pool_,
                       forces_);
    const auto& f = forces_.force;
    return {f[1].z(), f[2].z(), f[8].z() + f[9].z(), f[3].z()};
  }

 private:
  static constexpr NodeId node(int i) { return NodeId{i}; }

  std::vector<Vec3> x_{Vec3(0, 0, 0),    Vec3(0, 0, 9),    Vec3(2.1, 0.1, 9), Vec3(6, 0, 9),
                       Vec3(1.5, -1, 0), Vec3(4.5, -1, 0), Vec3(4.5, 1, 0),   Vec3(1.5, 1, 0),
                       Vec3(3.1, 0, 9),  Vec3(3.6, 0.2, 9)};
  std::vector<Vec3> still_{10, Vec3::Zero()};
  std::vector<geometry::Sphere> spheres_{
      {{node(0)}, kRadius}, {{node(1)}, kRadius}, {{node(2)}, kRadius}, {{node(3)}, kRadius}};
  std::vector<geometry::Facet> facets_{{{node(4), node(5), node(6)}, kRadius},
                                       {{node(4), node(6), node(7)}, kRadius}};
  std::vector<geometry::Cylinder> cylinders_{{{node(8), node(9)}, kRadius}};
  geometry::Surface surface_{cylinders_, facets_, 10};
  std::unique_ptr<Contacts> contacts_;
  geometry::ThreadPool pool_;
  NodeForces forces_{10};
};

constexpr double kTouching = -1e-3, kPulled = 0.5 * kLimit, kApart = 0.1;  // m

TEST(BondsAtStart, HoldUntilTheyBreakAndAreNotFormedAgain) {
  Pairs pairs(Bonds::at_start);
  for (const double force : pairs.forces_at(kTouching)) EXPECT_GT(force, 0.0);
  for (const double force : pairs.forces_at(kPulled)) EXPECT_LT(force, 0.0);
  for (const double force : pairs.forces_at(kTouching)) EXPECT_GT(force, 0.0);
  for (const double force : pairs.forces_at(kPulled)) EXPECT_LT(force, 0.0);
  for (const double force : pairs.forces_at(kApart)) EXPECT_EQ(force, 0.0);
  for (const double force : pairs.forces_at(kTouching)) EXPECT_GT(force, 0.0);
  for (const double force : pairs.forces_at(kPulled)) EXPECT_EQ(force, 0.0);
}

TEST(BondsAtStart, AreNotFormedOfContactsThatComeLater) {
  Pairs pairs(Bonds::at_start);
  for (const double gap : {kApart, kTouching})
    for (const double force : pairs.forces_at(gap)) EXPECT_EQ(force > 0.0, gap < 0.0);
  for (const double force : pairs.forces_at(kPulled)) EXPECT_EQ(force, 0.0);
}

TEST(BondsOfNewContacts, AreFormedWheneverBodiesComeToTouch) {
  Pairs pairs(Bonds::new_contacts);
  for (int round = 0; round < 3; ++round) {
    for (const double force : pairs.forces_at(kApart)) EXPECT_EQ(force, 0.0);
    for (const double force : pairs.forces_at(kTouching)) EXPECT_GT(force, 0.0);
    for (const double force : pairs.forces_at(kPulled)) EXPECT_LT(force, 0.0);
  }
}

TEST(NoBonds, AreFormedWhereTheLawSaysSo) {
  Pairs pairs(Bonds::none);
  for (const double force : pairs.forces_at(kTouching)) EXPECT_GT(force, 0.0);
  for (const double force : pairs.forces_at(kPulled)) EXPECT_EQ(force, 0.0);
}

}  // namespace
}  // namespace plekton::contact::bonds_at_start_test
