// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/contacts.hpp"
#include "contact/laws/any_law.hpp"

#include <gtest/gtest.h>

#include <vector>

/// A19: a sphere glued to a facet, pulled off it. What YADE gives to one node (its defect D7) is
/// shared by all three.
namespace plekton::contact {
namespace {

constexpr double kSphere = 0.05;                                  // m
constexpr double kThickness = 0.02;                               // m, radius of the facet
constexpr double kModulus = 1e7;                                  // Pa
constexpr double kStrength = 5e4;                                 // Pa
constexpr double kTension = kStrength * kThickness * kThickness;  // N
const double kStiffness = 2.0 * kModulus * kSphere * kThickness / (kSphere + kThickness);

/// Two facets side by side, and a sphere above them.
class GluedSphere {
 public:
  GluedSphere(const CohesiveFrictional::Properties& properties, const Vec3& foot)
      : foot_(foot),
        contacts_(
            spheres_, surface_,
            {MaterialPairs<CohesiveFrictional>({Material{kModulus, 0.5, 0.4}},
                                               {{{MaterialId{0}, MaterialId{0}}, properties}}),
             {MaterialId{0}},
             {MaterialId{0}}},
            0.01) {}

  /// Moves the sphere to a gap. @returns the forces on all nodes; the sphere is the last
  const NodeForces& move_to(double gap) {
    const double dt = 1e-3;
    const Vec3 place = foot_ + (kSphere + kThickness + gap) * Vec3::UnitZ();
    v_.back() = x_.back().isZero(0.0) ? Vec3(Vec3::Zero()) : Vec3((place - x_.back()) / dt);
    x_.back() = place;
    forces_.set_zero();
    contacts_.advance({x_, v_, w_}, {}, dt, pool_, forces_);
    return forces_;
  }
  std::size_t touching() const { return contacts_.counts().sphere_surface; }

 private:
  std::vector<Vec3> x_{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.2, 0.9, 0), Vec3(1.1, 1, 0),
                       Vec3::Zero()};
  std::vector<Vec3> v_{5, Vec3::Zero()};
  std::vector<Vec3> w_{5, Vec3::Zero()};
  std::vector<geometry::Sphere> spheres_{{{NodeId{4}}, kSphere}};
  std::vector<geometry::Facet> facets_{{{NodeId{0}, NodeId{1}, NodeId{2}}, kThickness},
                                       {{NodeId{1}, NodeId{3}, NodeId{2}}, kThickness}};
  geometry::Surface surface_{{}, facets_, 5};
  Vec3 foot_;
  Contacts<CohesiveFrictional> contacts_;
  geometry::ThreadPool pool_;
  NodeForces forces_{5};
};

TEST(A19, ASphereGluedToAFacetPullsItsNodesByTheirBarycentricShares) {
  const Vec3 weights(0.5, 0.3, 0.2);
  GluedSphere sphere({kStrength, kStrength, 0.0},
                     weights[1] * Vec3(1, 0, 0) + weights[2] * Vec3(0.2, 0.9, 0));
  sphere.move_to(-1e-5);
  for (const double share : {0.1, 0.5, 0.999}) {
    const double pull = share * kTension;

    const NodeForces& forces = sphere.move_to(pull / kStiffness);

    EXPECT_NEAR(forces.force[4].z(), -pull, 1e-9 * kTension);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(forces.force[i].z(), weights[static_cast<int>(i)] * pull, 1e-9 * kTension);
    EXPECT_EQ(forces.force[3].norm(), 0.0);
  }
}

TEST(A19, TheBondFailsAtExactlyItsStrength) {
  const double limit = kTension / kStiffness;
  // Above the inside of a facet, above the side that both share, and above a corner.
  for (const Vec3& foot : {Vec3(0.4, 0.2, 0), Vec3(0.6, 0.45, 0), Vec3(0, 0, 0)}) {
    GluedSphere sphere({kStrength, kStrength, 0.0}, foot);
    sphere.move_to(-1e-5);

    EXPECT_NEAR(sphere.move_to((1.0 - 1e-9) * limit).force[4].z(), -kTension, 1e-8 * kTension);
    EXPECT_EQ(sphere.touching(), 1u);
    EXPECT_EQ(sphere.move_to((1.0 + 1e-9) * limit).force[4].norm(), 0.0);
    sphere.move_to(2.0 * limit);
    EXPECT_EQ(sphere.touching(), 0u);
  }
}

TEST(A19, NothingSticksThatHasNotTouched) {
  GluedSphere sphere({kStrength, kStrength, 0.0}, Vec3(0.4, 0.2, 0));

  EXPECT_EQ(sphere.move_to(0.5 * kTension / kStiffness).force[4].norm(), 0.0);
  EXPECT_EQ(sphere.touching(), 0u);
}

}  // namespace
}  // namespace plekton::contact
