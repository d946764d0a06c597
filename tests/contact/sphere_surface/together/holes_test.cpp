// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/contact_surfaces.hpp"
#include "tests/support/force_jumps.hpp"

#include <gtest/gtest.h>

#include <tuple>

/// A grain of radius 1 pressed on nets and on plates with a hole: it is never pulled in, and what
/// carries it grows with depth.
namespace plekton::test::holes_test {
namespace {

constexpr double kDeepest = 0.05;  ///< m, overlap
constexpr double kStep = 0.001;    ///< m

/// Distance in the plane from a point to the nearest core point; 0 over a facet.
double distance_in_plane(const Vec3& p, const Surface& surface, Positions x) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < surface.edge_count(); ++e) {
    const auto& n = surface.nodes_of(id_at<EdgeId>(e));
    const Vec3 u = x[index_of(n[1])] - x[index_of(n[0])];
    const Vec3 w = p - x[index_of(n[0])];
    nearest = std::min(nearest, (w - std::clamp(w.dot(u) / u.squaredNorm(), 0.0, 1.0) * u).norm());
  }
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    const auto& n = surface.nodes_of(id_at<FaceId>(f));
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      inside =
          inside &&
          (x[index_of(n[(k + 1) % 3])] - x[index_of(n[k])]).cross(p - x[index_of(n[k])])[2] >= 0.0;
    }
    if (inside) nearest = 0.0;
  }
  return nearest;
}

/// Presses a grain down over a place in the plane z = 0 and expects a force upwards that grows with
/// depth.
class Press {
 public:
  Press(const Complex& complex, double radius)
      : x_(complex.x),
        surface_(complex.surface()),
        range_(1.0 + radius),
        cells_(all_cells(surface_)),
        finder_(surface_) {}

  void down_at(const Vec3& place) {
    SCOPED_TRACE(::testing::Message() << "place " << place.transpose());
    const double across = distance_in_plane(place, surface_, x_);
    double last = 0.0;
    for (double overlap = kStep; overlap < kDeepest + 0.5 * kStep; overlap += kStep) {
      const double distance = range_ - overlap;
      // A grain over an aperture falls through: even on a single rim its vertical force u sqrt(d² -
      // a²) / d, with u = range - d, falls from where a² range > d³.
      if (across * across * range_ > distance * distance * distance) return;
      const Vec3 centre(place[0], place[1], std::sqrt(distance * distance - across * across));

      const TotalContact total = total_contact(finder_, centre, range_, cells_, x_);

      // One piece at least at every level from the nearest point on.
      ASSERT_GE(total.overlaps, (range_ - total.nearest) * (1.0 - 1e-9));
      ASSERT_GT(total.force[2], 0.0) << "overlap " << overlap;
      ASSERT_GE(total.force[2], last) << "overlap " << overlap;
      last = total.force[2];
      most_sideways_ = std::max(most_sideways_, total.force.head<2>().norm() / total.force.norm());
      ++pressed_;
    }
  }

  int pressed() const { return pressed_; }
  double most_sideways() const { return most_sideways_; }

 private:
  std::vector<Vec3> x_;
  Surface surface_;
  double range_;
  std::vector<CellId> cells_;
  PatchFinder finder_;
  int pressed_ = 0;
  double most_sideways_ = 0.0;
};

/// Square net of a spacing, wide enough for all that is in range of the grain.
Complex square_net(double spacing, double wire_radius) {
  const double reach =
      std::min(1.0 + wire_radius, std::sqrt(2.0 * kDeepest * (1.0 + wire_radius)) + spacing);
  const int n = 2 * static_cast<int>(std::ceil(reach / spacing)) + 2;
  return centred(net(n), n, spacing);
}

TEST(GrainOnANet, IsPushedOutHarderTheDeeperItIs) {
  Random random(1);
  for (const double wire_radius : {0.05, 0.1, 0.2}) {
    for (const double aperture : {2.0, 1.5, 1.0, 0.7, 0.5, 0.3, 0.2, 0.1, 0.05}) {
      SCOPED_TRACE(::testing::Message()
                   << "wire radius " << wire_radius << ", aperture " << aperture);
      Press press(square_net(aperture, wire_radius), wire_radius);
      for (const Vec3& place : {Vec3(0.5, 0.5, 0), Vec3(0, 0.5, 0), Vec3(0, 0, 0),
                                Vec3(0.25, 0.25, 0), Vec3(1e-6, 0.5, 0)}) {
        press.down_at(aperture * place);
      }
      for (int k = 0; k < 15; ++k) press.down_at(aperture * Vec3(random.unit(), random.unit(), 0));
      EXPECT_GE(press.pressed(), 800);
    }
  }
}

TEST(GrainOnAPlateWithAHole, IsPushedOutHarderTheDeeperItIs) {
  Random random(2);
  for (const int corners : {3, 4, 6, 7, 8, 12, 24, 48, 96}) {
    for (const double rim : {0.1, 0.25, 0.5, 0.8}) {
      SCOPED_TRACE(::testing::Message() << corners << " corners, rim radius " << rim);
      Press press(plate_with_hole(corners, rim, 3.0), 0.05);
      const double half_side = std::numbers::pi / corners;
      press.down_at(rim * std::cos(half_side) * Vec3(std::cos(half_side), std::sin(half_side), 0));
      press.down_at(Vec3(rim, 0, 0));
      press.down_at(Vec3(1e-6 * rim, 0, 0));
      for (int k = 0; k < 20; ++k) {
        const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
        press.down_at(random.uniform(0.0, 1.1) * rim * Vec3(std::cos(angle), std::sin(angle), 0));
      }
      EXPECT_GE(press.pressed(), 1000);
    }
  }
}

TEST(GrainOnAPlateWithAHole, IsCarriedStraightUpOverTheMiddle) {
  for (const int corners : {3, 4, 6, 8, 12, 24, 48, 96}) {
    for (const double rim : {0.1, 0.25, 0.5, 0.8}) {
      Press press(plate_with_hole(corners, rim, 3.0), 0.05);

      press.down_at(Vec3::Zero());

      EXPECT_LT(press.most_sideways(), 1e-9) << corners << " corners, rim radius " << rim;
    }
  }
}

TEST(GrainOnANet, IsCarriedStraightUpOverTheMiddleOfAnAperture) {
  for (const double aperture : {1.0, 0.5, 0.2, 0.1, 0.05}) {
    Press press(square_net(aperture, 0.1), 0.1);

    press.down_at(Vec3(0.5 * aperture, 0.5 * aperture, 0));

    EXPECT_LT(press.most_sideways(), 1e-9) << "aperture " << aperture;
  }
}

TEST(GrainOnANet, FeelsAForceThatFollowsItsMotionWithoutAJump) {
  const double wire_radius = 0.05;
  const double range = 1.0 + wire_radius;
  for (const double aperture : {2.0, 1.0, 0.5, 0.2, 0.1}) {
    for (const double overlap : {0.001, 0.01, 0.05}) {
      SCOPED_TRACE(::testing::Message() << "aperture " << aperture << ", overlap " << overlap);
      expect_no_jump(square_net(aperture, wire_radius), range, overlap,
                     Vec3(-0.69 * aperture, 0.07 * aperture, range - overlap),
                     Vec3(0.61 * aperture, 0.97 * aperture, range - overlap));
    }
  }
}

TEST(GrainOnANet, FeelsNoJumpWhereItCrossesTheRimOfTheNet) {
  const double range = 1.05;
  for (const double aperture : {0.5, 0.3, 0.2}) {
    const int n = static_cast<int>(2.0 / aperture);
    const Complex complex = centred(net(n), n, aperture);
    const double rim = aperture * (n - n / 2);
    for (const double overlap : {0.01, 0.05}) {
      for (const double x : {0.0, 0.13, 0.5}) {
        SCOPED_TRACE(::testing::Message()
                     << "aperture " << aperture << ", overlap " << overlap << ", x " << x);
        expect_no_jump(complex, range, overlap,
                       Vec3(x * aperture, rim - 0.3 * aperture, range - overlap),
                       Vec3(x * aperture, rim + 0.3 * aperture, range - overlap));
      }
    }
  }
}

TEST(GrainOnAPlateWithAHole, FeelsAForceThatFollowsItsMotionWithoutAJump) {
  const double range = 1.05;
  for (const int corners : {3, 4, 6, 7, 12, 24, 48}) {
    for (const double rim : {0.1, 0.25, 0.5}) {
      for (const double overlap : {0.001, 0.01, 0.05}) {
        SCOPED_TRACE(::testing::Message()
                     << corners << " corners, rim radius " << rim << ", overlap " << overlap);
        expect_no_jump(plate_with_hole(corners, rim, 3.0), range, overlap,
                       Vec3(-1.3 * rim, 0.23 * rim, range - overlap),
                       Vec3(1.2 * rim, 0.31 * rim, range - overlap));
      }
    }
  }
}

TEST(GrainOnARoughSheet, FeelsAForceThatFollowsItsMotionWithoutAJump) {
  // Facets much smaller than the part of the sheet that the grain touches: dents and their rims are
  // rings that close and fill on the way.
  Random random(4);
  const double range = 1.05;
  for (const double spacing : {0.1, 0.05}) {
    for (const double roughness : {0.005, 0.02, 0.05}) {
      SCOPED_TRACE(::testing::Message() << "spacing " << spacing << ", roughness " << roughness);
      const int n = static_cast<int>(1.0 / spacing);
      const Complex sheet =
          roughened(centred(test::sheet(n), n, spacing), spacing, roughness, random);
      const double overlap = 0.03;
      expect_no_jump(sheet, range, overlap, Vec3(-0.1, 0.013, range - overlap),
                     Vec3(-0.05, 0.028, range - overlap));
    }
  }
}

TEST(GrainOnANet, FeelsTheSameWhateverTheOrderInWhichTheNetWasCreated) {
  Random random(3);
  const double wire_radius = 0.05;
  const double range = 1.0 + wire_radius;
  for (const double aperture : {0.2, 0.1, 0.05}) {
    const Complex first = square_net(aperture, wire_radius);
    const Complex second = reordered(first, random);
    const Surface first_surface = first.surface();
    const Surface second_surface = second.surface();
    PatchFinder first_finder(first_surface);
    PatchFinder second_finder(second_surface);
    const auto cells = all_cells(first_surface);
    for (int k = 0; k < 100; ++k) {
      const Vec3 centre(random.unit() * aperture, random.unit() * aperture,
                        range - random.uniform(0.001, 0.05));
      const Vec3 force = total_contact(first_finder, centre, range, cells, first.x).force;
      ASSERT_NEAR(
          (total_contact(second_finder, centre, range, cells, second.x).force - force).norm(), 0.0,
          1e-9 * force.norm());
    }
  }
}

/// At such places a pass and the top that fills its ring are born together, in the middle of the
/// levels: integrals over levels that know only of these events see one more of them on one side.
TEST(GrainBesideAnOpenCube, FeelsNoJumpWhereARingIsBornAndFilledAtOnce) {
  for (const auto& [missing, centre, range] :
       {std::tuple(5, Vec3(0, 0.5, -3), 4.16208813), std::tuple(3, Vec3(-1.5, 1, 4), 4.79067805),
        std::tuple(2, Vec3(1, 4, -3), 5.87990288)}) {
    for (int first = 0; first < 12; ++first) {
      Complex open = cube(1);
      open.facets.erase(open.facets.begin() + first);
      if (missing != first) open.facets.erase(open.facets.begin() + (missing - (first < missing)));
      const Surface surface = open.surface();
      PatchFinder finder(surface);
      const auto cells = all_cells(surface);
      const auto force_at = [&, reach = range](const Vec3& at) {
        return total_contact(finder, at, reach, cells, open.x).force;
      };
      const Vec3 force = force_at(centre);
      for (const double step : {1e-9, 1e-7, 1e-5}) {
        for (int axis = 0; axis < 3; ++axis) {
          for (const double side : {-step, step}) {
            EXPECT_LT((force_at(centre + side * Vec3::Unit(axis)) - force).norm(),
                      20.0 * step + 1e-11)
                << "without " << missing << " and " << first << ", axis " << axis << ", " << side;
          }
        }
      }
    }
  }
}

/// Grains that are symmetric to a few facets: features of different cells are equally far, or
/// differ by less than the distances round to.
TEST(GrainOnThreeSidesOfACube, FeelsNoJumpWhereDistancesTieButForRounding) {
  Complex three_sides;
  for (const Vec3& x :
       {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(0, 1, 1), Vec3(1, 1, 1)}) {
    three_sides.node(x);
  }
  three_sides.facet(1, 3, 5);
  three_sides.facet(2, 4, 5);
  three_sides.facet(0, 3, 2);
  const Surface surface = three_sides.surface();
  PatchFinder finder(surface);
  const double range = 3.7164;
  const auto cells = all_cells(surface);
  const auto force_at = [&](const Vec3& centre) {
    return total_contact(finder, centre, range, cells, three_sides.x).force;
  };
  const Vec3 tied(2, 3.5, 0);
  const Vec3 force = force_at(tied);
  for (int axis = 0; axis < 3; ++axis) {
    for (double step = 1e-14; step < 1e-3; step *= 3.0) {
      for (const double side : {-step, step}) {
        // The force follows the position: a contact turns by 1 / distance, and shares change over
        // distances of the size of the cube.
        EXPECT_LT((force_at(tied + side * Vec3::Unit(axis)) - force).norm(), 5.0 * step + 1e-12)
            << "axis " << axis << ", step " << side;
      }
    }
  }
}

}  // namespace
}  // namespace plekton::test::holes_test
