// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/contact_surfaces.hpp"

#include <gtest/gtest.h>

/// A ball that slides over a surface: one contact on a flat one, no jumps on any.
namespace plekton::test::patch_continuity_test {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

/// A flat sheet of 12 x 12 squares of side 1 in a place of its own, and how to get there from the
/// plane z = 0.
struct FlatPlace {
  const char* name;
  Mat3 turn;
  double scale;
  Vec3 offset;

  Vec3 operator()(const Vec3& x) const { return scale * (turn * x) + offset; }
  /// Largest rounding error of a coordinate (m).
  double rounding() const { return kEps * (offset.norm() + 12.0 * scale); }
};

std::vector<FlatPlace> flat_places() {
  Random random(1);
  const Mat3 none = Mat3::Identity();
  return {{"integer", none, 1.0, Vec3::Zero()},
          {"turned", random.rotation(), 1.0, Vec3::Zero()},
          {"turned again", random.rotation(), 1.0, Vec3::Zero()},
          {"tiny", none, 1e-9, Vec3::Zero()},
          {"tiny and turned", random.rotation(), 1e-9, Vec3::Zero()},
          {"far away", none, 1.0, Vec3(1e6, -1e6, 1e6)},
          {"far away and turned", random.rotation(), 1.0, Vec3(1e6, 1e6, -1e6)}};
}

/// Start and end in the plane of the sheet: along a line of edges and its nodes, along a diagonal
/// of the squares, just beside an edge, and anyhow.
const std::array<std::array<Vec3, 2>, 5> kPaths{{{Vec3(3, 6, 0), Vec3(9, 6, 0)},
                                                 {Vec3(3, 3, 0), Vec3(9, 9, 0)},
                                                 {Vec3(3, 9, 0), Vec3(9, 3, 0)},
                                                 {Vec3(3, 6 + 1e-13, 0), Vec3(9, 6 - 1e-13, 0)},
                                                 {Vec3(3.1, 4.2, 0), Vec3(8.7, 7.9, 0)}}};

TEST(SphereOnAFlatMesh, IsOneContactAtEveryStep) {
  const double range = 2.5;
  for (const FlatPlace& place : flat_places()) {
    SCOPED_TRACE(place.name);
    const Complex complex = mapped(sheet(12), place);
    const Surface surface = complex.surface();
    const auto cells = all_cells(surface);
    PatchFinder finder(surface);
    for (const double overlap : {1e-3, 0.05}) {
      for (const auto& [start, end] : kPaths) {
        for (int step = 0; step <= 240; ++step) {
          const Vec3 foot = start + (step / 240.0) * (end - start);
          const Vec3 centre = place(foot + Vec3(0, 0, range - overlap));

          const TotalContact total =
              total_contact(finder, centre, place.scale * range, cells, complex.x);

          ASSERT_EQ(total.patches, 1);
          // The features in range, a few dozen at most, are at one height but for the rounding of
          // the coordinates.
          ASSERT_NEAR(total.overlaps / (place.scale * overlap), 1.0,
                      64 * place.rounding() / (place.scale * overlap));
          ASSERT_NEAR(total.effective_number(place.scale * range), 1.0,
                      64 * place.rounding() / (place.scale * overlap));
        }
      }
    }
  }
}

/// Slides a ball over a rough sheet and expects the force to follow it without a jump, whatever the
/// step.
///
/// A term pushes with (range - d) n, which changes by no more than the ball moves, as long as range
/// - d <= d; so the total changes by no more than that times the sum of |weight| on the way, a term
/// that comes or goes included.
void expect_no_jump(PatchFinder& finder, std::span<const CellId> cells, Positions x, int steps) {
  const double range = 1.0;
  Vec3 last_centre = Vec3::Zero();
  Vec3 last_force = Vec3::Zero();
  double last_weights = 0.0;
  for (int step = 0; step <= steps; ++step) {
    const double t = static_cast<double>(step) / steps;
    const Vec3 centre(-0.5 + t, -0.3 + 0.71 * t, range - 0.02);
    Vec3 force = Vec3::Zero();
    double weights = 0.0;
    for (const Patch& patch : finder.find(centre, range, cells, x)) {
      for (const PatchTerm& term : finder.terms(patch)) {
        force -= (term.weight * (range - term.distance) + term.slope) * term.normal;
        weights += std::abs(term.weight);
      }
    }
    if (step > 0) {
      ASSERT_LE((force - last_force).norm(),
                std::max(weights, last_weights) * (centre - last_centre).norm() + 64 * kEps * range)
          << "step " << step << " of " << steps;
    }
    last_centre = centre;
    last_force = force;
    last_weights = weights;
  }
}

TEST(SphereOnARoughMesh, FeelsAForceThatFollowsItsMotionWithoutAJump) {
  Random random(2);
  const double spacing = 0.3;
  for (const double roughness : {1e-12, 1e-6, 1e-3, 1e-2, 0.05}) {
    SCOPED_TRACE(roughness);
    for (int k = 0; k < 5; ++k) {
      const Complex complex = roughened(centred(sheet(8), 8, spacing), spacing, roughness, random);
      const Surface surface = complex.surface();
      PatchFinder finder(surface);
      for (const int steps : {200, 2000, 20000})
        expect_no_jump(finder, all_cells(surface), complex.x, steps);
    }
  }
}

/// Two facets that meet in an edge along y, bent by an angle (rad): > 0 a valley, < 0 a ridge.
Complex bent(double angle) {
  Complex hinge;
  hinge.node(Vec3(0, -1, 0));
  hinge.node(Vec3(0, 1, 0));
  hinge.facet(0, 1, hinge.node(Vec3(std::cos(angle), 0, std::sin(angle))));
  hinge.facet(1, 0, hinge.node(Vec3(-std::cos(angle), 0, std::sin(angle))));
  return hinge;
}

/// Force on a ball over the edge.
TotalContact on_hinge(double angle, double range, double height) {
  const Complex hinge = bent(angle);
  const Surface surface = hinge.surface();
  PatchFinder finder(surface);
  return total_contact(finder, Vec3(0, 0, height), range, all_cells(surface), hinge.x);
}

TEST(SphereOnAHinge, FeelsNoJumpThroughFlat) {
  const double range = 1.0;
  const double height = 0.98;
  const double flat = on_hinge(0.0, range, height).force[2];

  EXPECT_NEAR(flat, range - height, 4 * kEps);
  for (int power = -12; power <= -2; ++power) {
    const double angle = std::pow(10.0, power);
    // Valley: two facets of distance h cos(angle), minus the edge; ridge: the edge alone.
    EXPECT_NEAR(on_hinge(angle, range, height).force[2],
                2.0 * (range - height * std::cos(angle)) * std::cos(angle) - (range - height),
                8 * kEps);
    EXPECT_NEAR(on_hinge(-angle, range, height).force[2], flat, 4 * kEps);
  }
}

TEST(SphereOnAHinge, FeelsAForceThatIsLipschitzInTheAngle) {
  const double range = 1.0;
  const double height = 0.98;
  for (const int steps : {600, 6000}) {
    const double step = 2.0 * std::numbers::pi / 3.0 / steps;  // rad; from -60 to 60 degrees
    double last = on_hinge(-std::numbers::pi / 3.0, range, height).force[2];
    for (int k = 1; k <= steps; ++k) {
      const double force = on_hinge(-std::numbers::pi / 3.0 + k * step, range, height).force[2];
      // |d/da 2 (r - h cos a) cos a| <= 2 r |sin a| (2 h / r + 1) <= 6 r.
      ASSERT_LE(std::abs(force - last), 6.0 * range * step);
      last = force;
    }
  }
}

/// Height over a place x at which the nearest point of a hinge is at this distance.
double height_over_hinge(double angle, double x, double distance) {
  if (std::abs(x) < -distance * std::sin(angle))  // the edge of a ridge is nearest
    return std::sqrt(distance * distance - x * x);
  return std::abs(x) * std::tan(angle) + distance / std::cos(angle);
}

TEST(SphereOnAHinge, FeelsAForceThatFollowsItWhenItSlidesAcrossAtAnyOfAThousandAngles) {
  const double range = 0.2;
  for (const double overlap : {0.001, 0.01}) {
    for (int k = 0; k < 1000; ++k) {
      const double angle = std::numbers::pi / 3.0 * (2.0 * k / 999.0 - 1.0);
      const Complex hinge = bent(angle);
      const Surface surface = hinge.surface();
      const auto cells = all_cells(surface);
      PatchFinder finder(surface);
      // A term pushes with (range - d) n, whose gradient is at most 1 in size; there are three:
      // both facets and the pass on the edge.
      for (const int steps : {100, 1000}) {
        Vec3 last_force = Vec3::Zero();
        Vec3 last_centre = Vec3::Zero();
        for (int step = 0; step <= steps; ++step) {
          const double x = 0.15 * (2.0 * step / steps - 1.0);
          const Vec3 centre(x, 0.1, height_over_hinge(angle, x, range - overlap));
          const Vec3 force = total_contact(finder, centre, range, cells, hinge.x).force;
          if (step > 0) {
            ASSERT_LE((force - last_force).norm(),
                      3.0 * (centre - last_centre).norm() + 64 * kEps * range)
                << "angle " << angle << ", overlap " << overlap << ", x " << x;
          }
          last_force = force;
          last_centre = centre;
        }
      }
    }
  }
}

TEST(SphereInACorner, IsTwoContactsWhenTheEdgeIsOutOfRange) {
  const TotalContact corner = on_hinge(std::numbers::pi / 4.0, 1.0, 0.99 * std::numbers::sqrt2);

  EXPECT_EQ(corner.patches, 2);
  EXPECT_NEAR(corner.overlaps, 2.0 * 0.01, 8 * kEps);
  EXPECT_NEAR(corner.force[2], 2.0 * 0.01 * std::numbers::sqrt2 / 2.0, 8 * kEps);
}

}  // namespace
}  // namespace plekton::test::patch_continuity_test
