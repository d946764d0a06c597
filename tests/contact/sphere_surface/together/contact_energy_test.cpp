// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/contact_surfaces.hpp"

#include <gtest/gtest.h>

#include <functional>

/// Whether the force of a contact is the gradient of its energy, whatever moves: the ball, or the
/// nodes of the surface.
namespace plekton::test::contact_energy_test {
namespace {

struct Law {
  const char* name;
  double (*force)(double overlap);
  double (*energy)(double overlap);
};

const std::array<Law, 3> kLaws{
    {{"linear", [](double o) { return o; }, [](double o) { return 0.5 * o * o; }},
     {"Hertz", [](double o) { return std::pow(o, 1.5); },
      [](double o) { return 0.4 * std::pow(o, 2.5); }},
     {"attraction", [](double o) { return o > 0.0 ? -1.0 : 0.0; }, [](double o) { return -o; }}}};

/// A ball near a surface whose nodes may move.
class StructurePair {
 public:
  StructurePair(const Complex& complex, const Vec3& centre, double range, const Law& law)
      : x_(complex.x),
        surface_(complex.surface()),
        cells_(cells_near(surface_, centre, range + kMargin, x_)),
        centre_(centre),
        range_(range),
        law_(law),
        finder_(surface_) {}

  /// After all have gone some of their ways.
  double energy(const std::vector<Vec3>& ways, const Vec3& way, double part) {
    std::vector<Vec3> x = x_;
    const OneContact one = of_one();
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += part * ways[i];
    double sum = 0.0;
    for (const Patch& patch :
         finder_.find(centre_ + part * way, range_, cells_, x, contact::NormalLaw(one))) {
      for (const PatchTerm& term : finder_.terms(patch))
        sum += term.weight * one.energy(term.distance) + term.energy;
    }
    return sum;
  }

  /// Work of the forces per part of the ways.
  double power(const std::vector<Vec3>& ways, const Vec3& way) {
    double sum = 0.0;
    const OneContact one = of_one();
    for (const Patch& patch : finder_.find(centre_, range_, cells_, x_, contact::NormalLaw(one))) {
      for (const PatchTerm& term : finder_.terms(patch)) {
        Vec3 relative = -way;
        for (std::size_t k = 0; k < 3; ++k)
          relative += term.core.weights[static_cast<int>(k)] * ways[index_of(term.core.nodes[k])];
        sum += (term.weight * one.force(term.distance) + term.slope) * term.normal.dot(relative);
      }
    }
    return sum;
  }

  bool has_rings() {
    CriticalFeatureFinder critical(surface_);
    const auto patches = finder_.find(centre_, range_, cells_, x_);
    return has_cycles_or_voids(critical, centre_, range_, cells_, x_,
                               static_cast<int>(patches.size()));
  }
  std::size_t term_count() {
    std::size_t count = 0;
    for (const Patch& patch : finder_.find(centre_, range_, cells_, x_)) count += patch.term_count;
    return count;
  }
  double deepest() {
    double deepest = 0.0;
    for (const Patch& patch : finder_.find(centre_, range_, cells_, x_))
      deepest = std::max(deepest, range_ - finder_.terms(patch)[0].distance);
    return deepest;
  }

  /// By distance.
  struct OneContact {
    double range;
    Law law;
    double energy(double distance) const { return law.energy(std::max(0.0, range - distance)); }
    double force(double distance) const { return law.force(std::max(0.0, range - distance)); }
  };
  OneContact of_one() const { return {range_, law_}; }

  static constexpr double kMargin = 0.01;

 private:
  std::vector<Vec3> x_;
  Surface surface_;
  std::vector<CellId> cells_;
  Vec3 centre_;
  double range_;
  Law law_;
  PatchFinder finder_;
};

/// Along random ways of all nodes and the ball, of the ball alone, and of single nodes.
void expect_gradient(StructurePair& structure_pair, std::size_t nodes, const Law& law,
                     Random& random) {
  const double deepest = structure_pair.deepest();
  for (int k = 0; k < 8; ++k) {
    std::vector<Vec3> ways(nodes, Vec3::Zero());
    Vec3 way = Vec3::Zero();
    if (k < 2 || k == 3) way = random.in_cube(1.0);
    if (k < 3) {
      for (Vec3& w : ways) w = random.in_cube(1.0);
    } else if (k > 3) {
      ways[random.index(nodes)] = random.in_cube(1.0);
    }
    // The difference rounds to some 1e-16 / 1e-7 of the deepest, and has an error of second order
    // in the step, or of first order where a feature comes into range within it: the best of three
    // steps.
    const double power = structure_pair.power(ways, way) / law.force(deepest);
    double error = std::numeric_limits<double>::infinity();
    for (const double step : {1e-5 * deepest, 1e-6 * deepest, 1e-7 * deepest}) {
      const double slope =
          (structure_pair.energy(ways, way, step) - structure_pair.energy(ways, way, -step)) /
          (2.0 * step);
      error = std::min(error, std::abs(slope / law.force(deepest) + power));
    }
    ASSERT_LT(error, 2e-6) << law.name << ", way " << k << ", power " << power;
  }
}

struct Seen {
  int several = 0;  ///< structure pairs with several terms
  int rings = 0;    ///< with rings or hollows
};

Seen check(const std::function<Complex(Random&)>& surface,
           const std::function<Vec3(Random&)>& centre, int count) {
  Random random(11);
  Seen seen;
  for (int trial = 0; trial < count; ++trial) {
    const Complex complex = surface(random);
    const Vec3 place = centre(random);
    for (const Law& law : kLaws) {
      StructurePair structure_pair(complex, place, 1.0, law);
      if (!(structure_pair.deepest() > 1e-3)) continue;
      expect_gradient(structure_pair, complex.x.size(), law, random);
      if (::testing::Test::HasFailure()) return seen;
      seen.several += structure_pair.term_count() > 1;
      seen.rings += structure_pair.has_rings();
    }
  }
  return seen;
}

TEST(ContactEnergy, HasTheForceAsItsGradientOnSheetsOfAnyRoughness) {
  for (const double roughness : {0.01, 0.03, 0.1}) {
    SCOPED_TRACE(roughness);
    check([&](Random& r) { return roughened(centred(sheet(8), 8, 0.3), 0.3, roughness, r); },
          [](Random& r) { return Vec3(r.uniform(-0.5, 0.5), r.uniform(-0.5, 0.5), 0.9); }, 20);
  }
}

TEST(ContactEnergy, HasTheForceAsItsGradientInACrease) {
  const Seen seen = check(
      [](Random& r) {
        Complex crease = roughened(centred(sheet(8), 8, 0.5), 0.5, 0.01, r);
        for (Vec3& x : crease.x) x.z() += 0.3 * std::abs(x.x());
        return crease;
      },
      [](Random& r) { return Vec3(r.uniform(-0.3, 0.3), r.uniform(-0.3, 0.3), 0.95); }, 10);
  EXPECT_GT(seen.several, 10);
}

TEST(ContactEnergy, HasTheForceAsItsGradientBetweenTheBarsOfANet) {
  const Seen seen =
      check([](Random& r) { return roughened(centred(net(4), 4, 1.5), 1.5, 0.05, r); },
            [](Random& r) { return Vec3(r.uniform(-0.7, 0.7), r.uniform(-0.7, 0.7), 0.7); }, 10);
  EXPECT_GT(seen.several, 10);
}

TEST(ContactEnergy, HasTheForceAsItsGradientOnADentedSheetWhoseRingsCloseAndFill) {
  for (const double depth : {0.1, 0.4, 0.8}) {
    SCOPED_TRACE(depth);
    const Seen seen = check(
        [&](Random& r) {
          Complex dent = roughened(centred(sheet(8), 8, 0.2), 0.2, 0.005, r);
          for (Vec3& x : dent.x) x.z() += depth * x.head<2>().squaredNorm();
          return dent;
        },
        [](Random& r) { return Vec3(r.uniform(-0.1, 0.1), r.uniform(-0.1, 0.1), 0.95); }, 10);
    EXPECT_GE(seen.rings, depth > 0.3 ? 10 : 0);
  }
}

TEST(ContactEnergy, HasTheForceAsItsGradientOnNetsAndAroundHoles) {
  const auto over = [](Random& r) {
    return Vec3(r.uniform(-0.3, 0.3), r.uniform(-0.3, 0.3), r.uniform(0.85, 0.97));
  };
  const Seen on_nets =
      check([](Random& r) { return roughened(centred(net(8), 8, 0.2), 0.2, 0.01, r); }, over, 10);
  const Seen around = check(
      [](Random& r) { return roughened(plate_with_hole(12, 0.4, 2.0), 0.2, 0.01, r); }, over, 10);
  EXPECT_GT(on_nets.rings + around.rings, 15);
}

TEST(ContactEnergy, HasTheForceAsItsGradientOnClosedBodiesInsideTheSphere) {
  const Seen seen = check(
      [](Random& r) {
        return mapped(roughened(ball(1), 0.1, 0.02, r),
                      [](const Vec3& x) { return Vec3(0.4 * x); });
      },
      [](Random& r) { return Vec3(r.in_cube(0.8)); }, 15);
  EXPECT_GT(seen.rings, 4);
}

}  // namespace
}  // namespace plekton::test::contact_energy_test
