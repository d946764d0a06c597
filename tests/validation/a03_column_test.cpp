// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/simulation.hpp"
#include "tests/support/column.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace plekton::test::a03_column_test {
namespace {

using dynamics::Held;

constexpr double kLength = 1.0;  // m
constexpr int kElements = 20;

BeamSection section_of_column() {
  return dynamics::circular_section(0.02, 1e9, 0.25);
}

/// N. Euler: P = pi² E I / L².
double euler(const BeamSection& section) {
  return std::numbers::pi * std::numbers::pi * section.young_modulus * section.second_moment /
         (kLength * kLength);
}

TEST(A03Column, BucklesAtTheForceOfEuler) {
  const Scene column = chain(kElements, kLength, section_of_column());
  const double force = euler(section_of_column());

  EXPECT_TRUE(is_stable(column, 0.985 * force));
  EXPECT_FALSE(is_stable(column, 1.015 * force));
}

struct Shortened {
  double shortening;  ///< m
  double force;       ///< N, that the moved pin takes along the column
  double deflection;  ///< m, of the middle
};

/// A column between pins in the x-z plane, with a small force on its middle, one of whose pins
/// comes on by so much (m) in so much time (s).
class PressedColumn {
 public:
  PressedColumn(double shortening, double time)
      : speed_(shortening / time), simulation_(scene(shortening / time), options()) {}

  Shortened at(double time) {
    while (simulation_.time() < time) simulation_.step();
    return {speed_ * simulation_.time(), simulation_.forces().force[kElements].x(),
            simulation_.state().position[kElements / 2].z()};
  }

 private:
  static Scene scene(double speed) {
    const BeamSection section = section_of_column();
    Scene scene = chain(kElements, kLength, section);
    constexpr Held kInPlane = Held::along_y | Held::about_x | Held::about_z;
    for (Held& held : scene.properties.held) held = kInPlane;
    scene.properties.held.front() = Held::translation | kInPlane;
    scene.properties.held.back() = Held::along_z | kInPlane;
    dynamics::PrescribedMotion pin;
    pin.nodes = {NodeId{kElements}};
    pin.held = Held::along_x;
    pin.velocity = Vec3(-speed, 0.0, 0.0);
    scene.loads.motions.push_back(pin);
    dynamics::NodalForce aside;
    aside.nodes = {NodeId{kElements / 2}};
    aside.force = Vec3(0.0, 0.0, 1e-4 * euler(section));
    scene.loads.forces.push_back(aside);
    return scene;
  }
  static dynamics::SimulationOptions options() {
    dynamics::SimulationOptions options;
    options.motion.damping = 0.2;
    return options;
  }

  double speed_;
  dynamics::Simulation simulation_;
};

// The column is straight up to Euler's force, at a shortening of 0.99 mm, and bends from there on
// at nearly the same force: P = P_E (1 + (e - e_E) / (2 L)) to first order (Timoshenko & Gere,
// Theory of Elastic Stability (1961), 2.7), 0.1 % at thrice the shortening. Elements are too stiff
// by pi² / (12 n²) = 0.2 %. The first sway takes 64 ms without a force, so 3 s are slow.
TEST(A03Column, HoldsTheForceOfEulerWhileItBends) {
  const BeamSection section = section_of_column();
  const double force = euler(section);
  const double at_buckling = force * kLength / (section.young_modulus * section.area);
  constexpr double kTime = 3.0;  // s
  PressedColumn column(3.0 * at_buckling, kTime);

  // Along a straight bar, while its force is half of Euler's: that of its middle bends it aside by
  // twice what it would alone, 4e-5 of its length.
  const Shortened straight = column.at(kTime / 6.0);
  EXPECT_NEAR(straight.force / force, straight.shortening / at_buckling, 0.015 * 0.5);

  constexpr int kSamples = 40;  // of the last third
  double mean = 0.0, least = INFINITY, most = 0.0;
  Shortened last{};
  for (int i = 1; i <= kSamples; ++i) {
    last = column.at(kTime * (2.0 + static_cast<double>(i) / kSamples) / 3.0);
    mean += last.force / force / kSamples;
    least = std::min(least, last.force / force);
    most = std::max(most, last.force / force);
  }

  std::printf("column: plateau P / P_E = %.4f (%.4f to %.4f), middle aside by %.4f m\n", mean,
              least, most, last.deflection);
  EXPECT_NEAR(mean, 1.0, 0.015);
  EXPECT_GT(least, 0.985);
  EXPECT_LT(most, 1.015);
  // A half sine of amplitude a shortens the column by pi² a² / (4 L): it has bent, not been
  // crushed.
  const double bent = 2.0 * std::sqrt((last.shortening - at_buckling) * kLength) / std::numbers::pi;
  EXPECT_NEAR(last.deflection, bent, 0.015 * bent);
}

}  // namespace
}  // namespace plekton::test::a03_column_test
