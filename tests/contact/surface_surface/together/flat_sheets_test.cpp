// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/bodies_of_cells.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

/// Sheets that lie flat on each other, their meshes registered or nearly so. k = 1 N/m: a force
/// over the overlap is a number of contacts, and a square of one range (sum of both radii) counts
/// for one.
namespace plekton::test::flat_sheets_test {
namespace {

constexpr double kRange = 0.1;
constexpr double kOverlap = 0.001;
constexpr double kHeight = kRange - kOverlap;

double largest_force_along_plane(const StructurePair& structure_pair) {
  double largest = 0.0;
  for (const Vec3& force : structure_pair.forces())
    largest = std::max(largest, force.head<2>().norm());
  return largest;
}

TEST(FlatSheets, PushAtTheMiddleOfARegisteredSquareAtEveryAngle) {
  const Body b = sheet(8, 8, 0.4, 0.4);
  for (const double turn : {0.0, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4}) {
    StructurePair structure_pair(sheet(20, 20, 1.0, 1.0), b, kRange);
    structure_pair.place(moved(b, {0.0, 0.0, turn}, {0.0, 0.0, kHeight}));
    EXPECT_NEAR(structure_pair.force_on_b().z() / kOverlap, 16.0, 1e-9) << turn;
    const Vec3 moment = structure_pair.moment_on_b({0.0, 0.0, kHeight});
    // Edges that cross at 1e-12 do so at a place that rounding moves by 1e-4 of their length.
    const double part_of_side = turn == 1e-12 ? 1e-5 : 1e-6;
    EXPECT_LT(moment.head<2>().norm(), part_of_side * 0.4 * structure_pair.force_on_b().norm())
        << turn;
  }
}

TEST(FlatSheets, HardlyPushNodesAlongThePlaneOfADish) {
  for (const double slope : {1e-6, 1e-5, 1e-4, 1e-3}) {
    for (const double turn : {0.0, 1e-9, 1e-7, 1e-5}) {
      Body b = sheet(2, 2, 0.4, 0.4);
      for (Vec3& x : b.x) x.z() += slope * x.head<2>().norm();
      StructurePair structure_pair(sheet(2, 2, 0.4, 0.4), b, kRange);
      structure_pair.place(moved(b, {0.0, 0.0, turn}, {0.0, 0.0, kHeight}));
      EXPECT_LT(largest_force_along_plane(structure_pair),
                1e-3 * structure_pair.force_on_b().norm())
          << slope << ' ' << turn;
    }
  }
}

// The diagonals of two pairs of facets cross at an angle that goes to 0.
TEST(FlatSheets, PushNoHarderThanTheNormalForceWhereEdgesCoincide) {
  for (const double d : {1e-6, 1e-9, 1e-12}) {
    Body lower;
    lower.x = {{0, -0.5, 0}, {0, 0.5, 0}, {-0.6, 0, 0}, {0.6, 0, 0}};
    lower.facets = {{0, 1, 2}, {0, 3, 1}};
    const double z = 2 * 5e-3 - 2e-5;
    Body upper;
    upper.x = {{-d, -0.05, z}, {d, 0.05, z + 1e-5}, {-0.05, 0.01, z}, {0.05, -0.01, z}};
    upper.facets = {{0, 1, 2}, {0, 3, 1}};
    StructurePair structure_pair(lower, upper, 1e-2);
    structure_pair.place(upper);
    const double normal = structure_pair.force_on_b().z();
    EXPECT_GT(normal, 0.0);
    for (const Vec3& force : structure_pair.forces()) {
      EXPECT_LT(force.norm(), normal) << d;
      EXPECT_LT(force.head<2>().norm(), 1e-2 * normal) << d;
    }
  }
}

// Stiffness of a node: that of the facets around it, 6 * (side^2 / 2) / range^2 / 6 contacts or so.
TEST(FlatSheets, PushANodeAlikeOnBothSidesOfFlat) {
  const Body a = sheet(4, 4, 0.8, 0.8);
  const Body b = sheet(2, 2, 0.4, 0.4);
  const std::size_t middle = 4;
  const auto force_at = [&](double height) {
    Body bent = moved(b, Vec3::Zero(), {0.0, 0.0, kHeight});
    bent.x[middle].z() += height;
    StructurePair structure_pair(a, b, kRange);
    structure_pair.place(bent);
    return structure_pair.forces()[structure_pair.first_node_of_b() + middle].z();
  };
  const double step = 1e-10;
  const double stiffness = 16.0;  // N/m, of the whole sheet: more than that of one node
  EXPECT_LT(std::abs(force_at(step) - force_at(-step)), 2.0 * step * stiffness);
}

/// A bumpy sheet.
Body bumpy(int cells, double side, double height, Random& random) {
  Body body = sheet(cells, cells, side, side, Cut::alternating);
  for (Vec3& x : body.x) x.z() += height * random.uniform(-1.0, 1.0);
  return body;
}

/// N. Where a rim of one sheet passes over an edge of the other, the other's resistance to a fold
/// there begins or ends: a fold by an angle t makes its facets, seen along their normals from one
/// range above, share or miss a strip of range * t, with energy / range^2 on it. A node of cells of
/// 0.2 m is the end of two edges in line with one facet on either side of each, and folds them by 4
/// / 0.2 m together at most.
constexpr double kFoldChange = 0.5 * kOverlap * kOverlap * 0.2 / kRange * 4.0 / 0.2;

/// m, of differences of the energy. Where meshes are registered its slope changes at ways of range
/// * slope, 5e-7 m of the least bumps but none; that of a coordinate of 1 m is rounded by 1e-16 m,
/// so forces that follow are off by some 1e-8 of the largest.
constexpr double kStep = 1e-8;
/// Of forces, as parts of the largest: a few times that.
constexpr double kGradientError = 1e-7;
constexpr std::array kBumps = {0.0, 1e-6, 1e-5, 1e-4, 5e-4, 2e-3};  // m

/// Minus the slope of an energy at 0. Richardson: the error falls with the fourth power of the
/// step.
template <class Energy>
double minus_slope(const Energy& energy) {
  const auto slope = [&](double way) { return (energy(way) - energy(-way)) / (2.0 * way); };
  return -(4.0 * slope(0.5 * kStep) - slope(kStep)) / 3.0;
}

TEST(FlatSheets, PushAgainstTheGradientOfTheirEnergyAlsoOntoTheirMirrorImage) {
  Random random(5);
  for (const double height : kBumps) {
    const Body a = bumpy(5, 1.0, height, random);
    Body b;  // its middle, turned over
    for (std::size_t j = 1; j < 5; ++j) {
      for (std::size_t i = 1; i < 5; ++i) b.x.push_back(a.x[6 * j + i]);
    }
    b.facets = sheet(3, 3, 0.6, 0.6, Cut::alternating).facets;
    for (Vec3& x : b.x) x.z() = kHeight - x.z();
    StructurePair structure_pair(a, b, kRange);
    structure_pair.place(b);
    const std::vector<Vec3> forces = structure_pair.forces();
    double largest = 0.0;
    for (const Vec3& force : forces) largest = std::max(largest, force.norm());
    for (std::size_t i = 0; i < b.x.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        const double expected = minus_slope([&](double way) {
          Body shifted = b;
          shifted.x[i][axis] += way;
          structure_pair.place(shifted);
          return structure_pair.energy();
        });
        EXPECT_NEAR(forces[structure_pair.first_node_of_b() + i][axis], expected,
                    kGradientError * largest)
            << height << ' ' << i << ' ' << axis;
      }
    }
  }
}

constexpr double kCell = 0.2;  // m

/// One sheet that is folded by a column of cells that stands up, so that the rest of it lies on its
/// mirror image, and its contacts with itself. k = 1 N/m.
class FoldedSheet {
 public:
  FoldedSheet(double bump, Random& random) {
    std::array<std::array<double, kRows + 1>, kColumns + 1> heights{};
    for (auto& column : heights)
      for (double& z : column) z = bump * random.uniform(-1.0, 1.0);
    const std::size_t last = 2 * kColumns + 1;  // column of nodes
    std::vector<Vec3> flat;
    for (std::size_t j = 0; j <= kRows; ++j) {
      const double y = kCell * static_cast<double>(j);
      for (std::size_t i = 0; i <= last; ++i) {
        const bool is_above = i > kColumns;
        const std::size_t column = is_above ? last - i : i;
        const double z = heights[column][j];
        flat.emplace_back(kCell * static_cast<double>(i), y, 0.0);
        x_.emplace_back(kCell * static_cast<double>(column), y, is_above ? kHeight - z : z);
      }
    }
    surface_ = std::make_unique<geometry::Surface>(std::vector<Cylinder>{}, facets(), x_.size());
    contacts_ = std::make_unique<contact::StructureContacts>(*surface_);
    neighbours_ = std::make_unique<geometry::CellNeighbours>(*surface_, flat, 0.0, true);
  }

  const std::vector<Vec3>& positions() const { return x_; }
  /// J, with nodes elsewhere.
  double energy_at(const std::vector<Vec3>& x) {
    if (neighbours_->update(x, pool_)) {
      const contact::MaterialPairs materials(
          {contact::Material{2.0 / kRange, 0.0, 0.0}},
          {{{contact::MaterialId{0}, contact::MaterialId{0}},
            contact::AnyLaw::of<contact::LinearFrictional>({})}});
      const std::vector<contact::MaterialId> of_structures(1);
      contacts_->rebuild(neighbours_->pairs(), {materials, {}, of_structures});
    }
    const std::vector<Vec3> still(x.size(), Vec3::Zero());
    contacts_->advance({x, still, still}, 0.0, pool_);
    return contacts_->elastic_energy();
  }
  std::vector<Vec3> forces() {
    energy_at(x_);
    NodeForces forces(x_.size());
    contacts_->add_forces(forces);
    return forces.force;
  }

 private:
  static constexpr std::size_t kColumns = 4;  ///< of cells, of either half
  static constexpr std::size_t kRows = 3;

  /// Diagonals by turns, those of one half above those of the other.
  static std::vector<Facet> facets() {
    std::vector<Facet> facets;
    constexpr std::size_t kCells = 2 * kColumns + 1;
    const auto node = [](std::size_t i, std::size_t j) {
      return geometry::id_at<NodeId>(j * (kCells + 1) + i);
    };
    for (std::size_t j = 0; j < kRows; ++j) {
      for (std::size_t i = 0; i < kCells; ++i) {
        const bool is_above = i > kColumns;
        const bool is_even = ((is_above ? kCells - 1 - i : i) + j) % 2 == 0;
        const NodeId a = node(i, j), b = node(i + 1, j), c = node(i, j + 1), d = node(i + 1, j + 1);
        const auto add = [&](NodeId p, NodeId q, NodeId r) {
          facets.push_back({{p, q, r}, 0.5 * kRange});
        };
        if (is_even != is_above) {
          add(a, b, c);
          add(b, d, c);
        } else {
          add(a, b, d);
          add(a, d, c);
        }
      }
    }
    return facets;
  }

  std::vector<Vec3> x_;
  geometry::ThreadPool pool_{1};
  std::unique_ptr<geometry::Surface> surface_;
  std::unique_ptr<contact::StructureContacts> contacts_;
  std::unique_ptr<geometry::CellNeighbours> neighbours_;
};

// S12. Where all is flat, rims lie on rims, those too where cells near the fold begin, which leave
// each other alone. There the energy has a kink: the force is that of one of its sides, and the
// slope the mean of both. Moved along the plane by s, a node shares s * L less one way and no more
// the other way, L half of both its rims together; moved across it, it folds an edge.
TEST(FlatSheets, FoldedOntoTheirMirrorImagePushAgainstTheGradientOfTheirEnergy) {
  constexpr double kAlong = 0.5 * (0.5 * kOverlap * kOverlap) * kCell / (kRange * kRange);  // N
  constexpr double kAcross = 0.5 * kFoldChange;
  Random random(5);
  for (const double bump : kBumps) {
    FoldedSheet sheet(bump, random);
    const std::vector<Vec3> forces = sheet.forces();
    double largest = 0.0;
    for (const Vec3& force : forces) largest = std::max(largest, force.norm());
    EXPECT_GT(largest, 0.0);
    for (std::size_t i = 0; i < forces.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        const double expected = minus_slope([&](double way) {
          std::vector<Vec3> shifted = sheet.positions();
          shifted[i][axis] += way;
          return sheet.energy_at(shifted);
        });
        const double kink = bump > 0.0 ? 0.0 : axis < 2 ? kAlong : kAcross;
        EXPECT_NEAR(forces[i][axis], expected, kGradientError * largest + kink)
            << bump << ' ' << i << ' ' << axis;
      }
    }
  }
}

// But for jumps where a rim passes over an edge: 5e-6 to 8e-6 N is seen whatever the step, 0.1 to
// 0.2 % of the largest force on a node.
TEST(FlatSheets, ChangeTheirForcesInProportionToTheStepButForFoldsUnderRims) {
  Random random(6);
  const Body a = sheet(5, 5, 1.0, 1.0);
  for (const double bump : {0.0, 1e-5, 2e-4}) {
    const Body b = bumpy(3, 0.6, bump, random);
    std::vector<Vec3> direction;
    for (std::size_t i = 0; i < b.x.size(); ++i)
      direction.emplace_back(0.3 * random.uniform(-1, 1), 0.3 * random.uniform(-1, 1),
                             random.uniform(-1, 1));
    double last = 0.0;
    for (const double step : {1e-5, 1e-6, 1e-7, 1e-8}) {
      StructurePair structure_pair(a, b, kRange);
      double largest = 0.0;
      std::vector<Vec3> before;
      for (int i = -20; i <= 20; ++i) {
        Body placed = moved(b, Vec3::Zero(), {0.0, 0.0, kHeight});
        for (std::size_t n = 0; n < b.x.size(); ++n)
          placed.x[n] += (i - 0.37) * step * direction[n];
        structure_pair.place(placed);
        for (std::size_t n = 0; n < before.size(); ++n)
          largest = std::max(largest, (structure_pair.forces()[n] - before[n]).norm());
        before = structure_pair.forces();
      }
      if (last > 0.0) {
        EXPECT_LT(largest, 0.1 * last + kFoldChange) << bump << ' ' << step;
      }
      last = largest;
    }
  }
}

}  // namespace
}  // namespace plekton::test::flat_sheets_test
