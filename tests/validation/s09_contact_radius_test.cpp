// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/law/dmt_adhesion.hpp"
#include "contact/law/hertz_mindlin.hpp"
#include "contact/law/linear_frictional.hpp"
#include "contact/models.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

/// S9: laws after Hertz have the curvature of the undeformed surfaces where they touch. Against the
/// closed forms of Johnson, Contact Mechanics (1985), 4.1 and 4.2: a ball of R = 10 mm on a plane,
/// on a sheet of half thickness 1 mm and on a cylinder, and crossed cylinders.
namespace plekton::contact::s09_contact_radius_test {
namespace {

using geometry::Cylinder;
using geometry::Facet;
using geometry::NodeId;

constexpr double kRadius = 0.01;          // m, of the ball
constexpr double kHalfThickness = 0.001;  // m, of the sheet
constexpr double kWire = 0.002;           // m, radius of cylinders
constexpr double kOverlap = 1e-5;         // m
constexpr double kAdhesion = 0.05;        // J/m², w
const Material kMaterial{1e9, 0.0, 0.5, 0.25};
/// E* of two bodies of that material.
constexpr double kModulus = 1e9 / (2.0 * (1.0 - 0.25 * 0.25));
/// Of a force that follows from a distance of coordinates of 1 m: overlap / rounding.
constexpr double kRounding = 1e-10;

/// Johnson (4.22) and (4.23): force (N) of a contact with circular curvature.
double hertz_force(double radius) {
  return 4.0 / 3.0 * kModulus * std::sqrt(radius) * std::pow(kOverlap, 1.5);
}

/// Johnson (4.24) to (4.28) for any principal radii of relative curvature R' >= R'': the axes of
/// the ellipse are a >= b with e² = 1 - b²/a², and
///   R'/R'' = ((a/b)² E(e) - K(e)) / (K(e) - E(e)),
///   1/(2 R') = 3 P / (2 pi E*) (K - E) / (e² a³),   approach = 3 P / (2 pi E*) K / a.
/// K and E are the standard library's; b/a is found by bisection.
double elliptic_force(double larger, double smaller) {
  const auto integrals = [](double q) {
    const double e = std::sqrt((1.0 - q) * (1.0 + q));
    return std::pair(std::comp_ellint_1(e), std::comp_ellint_2(e));
  };
  double low = 1e-9;
  double high = 1.0 - 1e-9;
  for (int k = 0; k < 200; ++k) {
    const double q = 0.5 * (low + high);
    const auto [first, second] = integrals(q);
    const bool is_longer = (second / (q * q) - first) / (first - second) > larger / smaller;
    (is_longer ? low : high) = q;
  }
  const auto [first, second] = integrals(low);
  const double e_squared = (1.0 - low) * (1.0 + low);
  // P = c a³ and P = d a: the first over the second gives a.
  const double cube =
      2.0 * std::numbers::pi * kModulus * e_squared / (3.0 * (first - second) * 2.0 * larger);
  const double linear = 2.0 * std::numbers::pi * kModulus * kOverlap / (3.0 * first);
  return linear * std::sqrt(linear / cube);
}

/// A scene of one ball (its node is the last) or none, all of one material.
struct Bodies {
  std::vector<Vec3> x;
  std::vector<Cylinder> cylinders;
  std::vector<Facet> facets;
  std::vector<Plane> planes;
  bool has_ball = true;
};

/// A square sheet from -1 to 1 in the plane of z = -half thickness, so that its upper side is z =
/// 0.
Bodies sheet() {
  Bodies bodies;
  const double z = -kHalfThickness;
  bodies.x = {{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}};
  bodies.facets = {{{NodeId{0}, NodeId{1}, NodeId{2}}, kHalfThickness},
                   {{NodeId{0}, NodeId{2}, NodeId{3}}, kHalfThickness}};
  return bodies;
}
/// A bar along y from -1 to 1 in two pieces, whose top is z = 0.
Bodies bar() {
  Bodies bodies;
  bodies.x = {{0, -1, -kWire}, {0, 0, -kWire}, {0, 1, -kWire}};
  bodies.cylinders = {{{NodeId{0}, NodeId{1}}, kWire}, {{NodeId{1}, NodeId{2}}, kWire}};
  return bodies;
}

/// Force (N) on the ball, or on all nodes from the first given on if there is none, at rest.
template <class Law>
Vec3 force_on_last(const Bodies& bodies, std::size_t first,
                   const PropertiesOf<Law>& properties = {}) {
  std::vector<geometry::Sphere> spheres;
  if (bodies.has_ball) spheres.push_back({{geometry::id_at<NodeId>(bodies.x.size() - 1)}, kRadius});
  const geometry::Surface surface(bodies.cylinders, bodies.facets, bodies.x.size());
  const auto contacts = model_of<Law>({{{MaterialId{0}, MaterialId{0}}, properties}})(
      {.spheres = spheres,
       .surface = surface,
       .materials = {kMaterial},
       .of_spheres = std::vector<MaterialId>(spheres.size()),
       .of_structures = std::vector<MaterialId>(surface.structure_count()),
       .masses = {},
       .skin = 0.01,
       .meets_planes = {},
       .rest = {}});
  const std::vector<Vec3> still(bodies.x.size(), Vec3::Zero());
  geometry::ThreadPool pool;
  NodeForces forces(bodies.x.size());
  contacts->advance({bodies.x, still, still}, bodies.planes, 0.0, pool, forces);
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = first; i < bodies.x.size(); ++i) sum += forces.force[i];
  return sum;
}

/// On a ball at a place.
template <class Law>
double on_ball(Bodies bodies, const Vec3& centre, const PropertiesOf<Law>& properties = {}) {
  bodies.x.push_back(centre);
  return force_on_last<Law>(bodies, bodies.x.size() - 1, properties).norm();
}

/// Of a ball that is pressed by kOverlap into what has its top at z = 0, over x and y.
Vec3 above(double x, double y) {
  return {x, y, kRadius - kOverlap};
}

Bodies plane() {
  Bodies bodies;
  bodies.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), MaterialId{0}});
  return bodies;
}

TEST(ContactRadius, OfASphereOnAPlaneIsTheBalls) {
  const double expected = hertz_force(kRadius);

  const double force = on_ball<HertzMindlin>(plane(), above(0.1, 0.2));

  EXPECT_NEAR(force, expected, kRounding * expected);
}

TEST(ContactRadius, OfASphereOnAThinSheetIsTheBalls) {
  const double expected = hertz_force(kRadius);

  const double force = on_ball<HertzMindlin>(sheet(), above(0.1, 0.2));

  EXPECT_NEAR(force, expected, kRounding * expected);
}

/// From a face over a seam onto the other, onto the rim, and around it and a corner: one energy.
TEST(ContactRadius, StaysAsASphereRollsFromFacetToFacetAndOverTheRim) {
  const double expected = hertz_force(kRadius);
  const double range = kRadius + kHalfThickness - kOverlap;
  const Vec3 down(0.0, 0.0, -kHalfThickness);

  for (const Vec3& core : {Vec3(0.3, 0.1, 0.0), Vec3(0.2, 0.2, 0.0), Vec3(1.0, 0.1, 0.0)})
    EXPECT_NEAR(on_ball<HertzMindlin>(sheet(), core + down + range * Vec3::UnitZ()), expected,
                kRounding * expected);
  for (double turned = 0.1; turned < 3.1; turned += 0.1) {
    const Vec3 around_rim(std::sin(turned), 0.0, std::cos(turned));
    const Vec3 around_corner =
        Vec3(std::sin(turned), std::sin(turned), std::cos(turned)).normalized();
    EXPECT_NEAR(on_ball<HertzMindlin>(sheet(), Vec3(1, 0.1, 0) + down + range * around_rim),
                expected, kRounding * expected);
    EXPECT_NEAR(on_ball<HertzMindlin>(sheet(), Vec3(1, 1, 0) + down + range * around_corner),
                expected, kRounding * expected);
  }
}

/// 1/R' = 1/R, 1/R'' = 1/R + 1/r.
TEST(ContactRadius, OfASphereOnACylinderIsThatOfAnEllipse) {
  const double across = kRadius * kWire / (kRadius + kWire);
  const double expected = elliptic_force(kRadius, across);
  EXPECT_GT(expected, 1.05 * hertz_force(across));
  EXPECT_LT(expected, 0.95 * hertz_force(kRadius));

  // Along it, at the joint of its pieces, and at its end.
  for (const double y : {0.3, 0.0, -0.4, 1.0}) {
    const double force = on_ball<HertzMindlin>(bar(), above(0.0, y));
    EXPECT_NEAR(force, expected, kRounding * expected) << y;
  }
}

/// Two bars at right angles: R' and R'' are their radii; of equal bars a sphere's on a plane.
TEST(ContactRadius, OfCrossedCylindersIsThatOfAnEllipse) {
  for (const double other : {kWire, 0.5 * kWire, 5.0 * kWire}) {
    Bodies bodies = bar();
    bodies.has_ball = false;
    bodies.x.push_back({-1.0, 0.3, other - kOverlap});
    bodies.x.push_back({1.0, 0.3, other - kOverlap});
    bodies.cylinders.push_back({{NodeId{3}, NodeId{4}}, other});
    const double expected = other == kWire
                                ? hertz_force(kWire)
                                : elliptic_force(std::max(kWire, other), std::min(kWire, other));

    const double force = force_on_last<HertzMindlin>(bodies, 3).norm();

    EXPECT_NEAR(force, expected, kRounding * expected) << other;
  }
}

/// Derjaguin, Muller & Toporov (1975): 2 pi R w, here with R = sqrt(R' R'') (Derjaguin 1934).
double pull_off(double equivalent_radius) {
  return 2.0 * std::numbers::pi * equivalent_radius * kAdhesion;
}

/// What adhesion takes off the force.
double attraction(const Bodies& bodies, const Vec3& centre) {
  return on_ball<HertzMindlin>(bodies, centre) - on_ball<DmtAdhesion>(bodies, centre, {kAdhesion});
}

TEST(ContactRadius, DecidesThePullOffForce) {
  const double across = kRadius * kWire / (kRadius + kWire);
  const double rounding = kRounding * hertz_force(kRadius);

  EXPECT_NEAR(attraction(plane(), above(0.1, 0.2)), pull_off(kRadius), rounding);
  EXPECT_NEAR(attraction(sheet(), above(0.1, 0.2)), pull_off(kRadius), rounding);
  EXPECT_NEAR(attraction(bar(), above(0.0, 0.3)), pull_off(std::sqrt(kRadius * across)), rounding);
  EXPECT_NEAR(pull_off(kRadius), 3.14e-3, 0.002e-3);
}

/// N/m, of linear springs.
double linear_stiffness(const Bodies& bodies, const Vec3& centre,
                        const LinearFrictional::Properties& properties = {}) {
  return on_ball<LinearFrictional>(bodies, centre, properties) / kOverlap;
}

/// Linear springs: E R of both sides in series, with E = 1 GPa and 10 mm on 1 mm, as Effeindzourou
/// et al. (2016) have it; as on a plane; and as the pair of materials says.
TEST(ContactStiffness, IsThatOfTheThicknessOrOfTheCurvatureOrAsGiven) {
  using Radius = LinearFrictional::StiffnessRadius;
  const double of_plane = 1e9 * kRadius;
  const double of_thickness =
      2e9 * kRadius * kHalfThickness / (kRadius + kHalfThickness);  // 0.18 of it
  const Vec3 place = above(0.1, 0.2);

  EXPECT_NEAR(linear_stiffness(plane(), place), of_plane, kRounding * of_plane);
  EXPECT_NEAR(linear_stiffness(sheet(), place), of_thickness, kRounding * of_plane);
  EXPECT_NEAR(linear_stiffness(sheet(), place, {.radius = Radius::curvature}), of_plane,
              kRounding * of_plane);
  for (const Bodies& bodies : {plane(), sheet()})
    EXPECT_NEAR(linear_stiffness(bodies, place, {.normal_stiffness = 3e5}), 3e5, kRounding * 3e5);
  EXPECT_NEAR(linear_stiffness(bar(), above(0.0, 0.3), {.normal_stiffness = 3e5}), 3e5,
              kRounding * 3e5);
}

}  // namespace
}  // namespace plekton::contact::s09_contact_radius_test
