// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/validation/hanging_chain.hpp"
#include "dynamics/simulation.hpp"
#include "tests/support/column.hpp"
#include "tests/support/free_swing.hpp"
#include "tests/support/refinement.hpp"

#include <gtest/gtest.h>

#include <numbers>

/// Beams and chains against theory, with more and more elements.
///
/// A beam between two nodes is exact for what acts at its nodes. What is spread along it, weight or
/// mass, is lumped there: the trapezoidal rule, of second order, whose error for a smooth g is
/// h² / 12 (g'(L) - g'(0)).
namespace plekton::test::beam_refinement_test {
namespace {

using dynamics::Held;
using std::numbers::pi;

constexpr double kModulus = 1e9;  // Pa

/// A load per length (N/m), lumped: half of that on either side of a node. One entry for each node.
std::vector<double> lumped(int elements, double length, double load) {
  std::vector<double> forces(static_cast<std::size_t>(elements) + 1, load * length / elements);
  forces.front() *= 0.5;
  forces.back() *= 0.5;
  return forces;
}

// w = q L⁴ / (8 E I) at the tip. With g = x² (3 L - x) / 6 the deflection is the sum of q g / (E
// I), and g''' is constant: the error is (1/2 L²) h² / 12 over L⁴ / 8, 1 / (3 n²), and nothing
// else.
TEST(BeamRefinement, ACantileverBendsUnderItsWeight) {
  const BeamSection section = dynamics::circular_section(0.01, kModulus, 0.3);
  constexpr double kDeflection = 1e-6;  // m; what is not linear is below its square
  Refinement table("cantilever under its weight, w at the tip (m)", kDeflection);
  for (const int elements : {1, 2, 4, 8, 16}) {
    Scene scene = chain(elements, 1.0, section);
    Eigen::VectorXd loads = Eigen::VectorXd::Zero(first_entry(scene.state.size()));
    const double load = 8.0 * kDeflection * kModulus * section.second_moment;
    const auto forces = lumped(elements, 1.0, load);
    for (std::size_t i = 0; i < forces.size(); ++i) loads[first_entry(i) + 2] = forces[i];

    balance(scene, loads, 1);

    table.add(elements, scene.state.position.back().z());
  }
  table.print();
  for (std::size_t row = 0; row < 4; ++row) EXPECT_NEAR(table.order(row), 2.0, 0.01);
  EXPECT_NEAR(table.last_error() * 3.0 * 16 * 16, 1.0, 0.02);
}

constexpr double kHeight = 1.0;  // m, of the frame
constexpr double kSpan = 1.5;    // m

/// Sway (m) of a portal frame with clamped feet whose left column carries a load q (N/m) from the
/// side, by slope and deflection, everything of bending stiffness B = E I: end moments, clockwise,
///
///     M_ij = 2 B / L (2 theta_i + theta_j - 3 psi) -/+ q L² / 12,
///
/// balance at both upper corners, and of the shear of both columns with q h / 2.
double sway_of_frame(double load, double bending) {
  const double column = 2.0 * bending / kHeight;
  const double girder = 2.0 * bending / kSpan;
  Eigen::Matrix3d equations;                                    // of theta_left, theta_right, psi
  equations << 2.0 * (column + girder), girder, -3.0 * column,  //
      girder, 2.0 * (column + girder), -3.0 * column,           //
      3.0 * column, 3.0 * column, -12.0 * column;
  const double end_moment = load * kHeight * kHeight / 12.0;
  const Eigen::Vector3d right(-end_moment, 0.0, -0.5 * load * kHeight * kHeight);
  return kHeight * equations.partialPivLu().solve(right)[2];
}

/// Columns along z at x = 0 and at the span, a girder between them; the feet are the first and the
/// last node.
Scene portal_frame(int elements, const BeamSection& section) {
  Scene scene;
  const auto add = [&](const Vec3& from, const Vec3& to) {
    for (int i = 1; i <= elements; ++i) {
      const NodeId node = scene.add_node(from + (to - from) * i / elements);
      scene.add_beam(geometry::id_at<NodeId>(geometry::index_of(node) - 1), node, section, 1000.0);
    }
  };
  scene.add_node(Vec3::Zero(), Held::everything);
  add(Vec3::Zero(), Vec3(0, 0, kHeight));
  add(Vec3(0, 0, kHeight), Vec3(kSpan, 0, kHeight));
  add(Vec3(kSpan, 0, kHeight), Vec3(kSpan, 0, 0));
  scene.properties.held.back() = Held::everything;
  return scene;
}

// Slope and deflection leave out stretching: r = 1 mm, so that it is 3 r² / h², 3e-6, of bending.
TEST(BeamRefinement, APortalFrameSwaysUnderALoadFromTheSide) {
  const BeamSection section = dynamics::circular_section(0.001, kModulus, 0.3);
  const double bending = kModulus * section.second_moment;
  constexpr double kLoad = 1e-7;  // N/m
  Refinement table("portal frame under a load from the side, sway (m)",
                   sway_of_frame(kLoad, bending));
  for (const int elements : {2, 4, 8, 16}) {
    Scene scene = portal_frame(elements, section);
    Eigen::VectorXd loads = Eigen::VectorXd::Zero(first_entry(scene.state.size()));
    const auto forces = lumped(elements, kHeight, kLoad);
    for (std::size_t i = 0; i < forces.size(); ++i) loads[first_entry(i)] = forces[i];

    balance(scene, loads, 1);

    table.add(elements, scene.state.position[static_cast<std::size_t>(elements)].x());
  }
  table.print();
  for (std::size_t row = 0; row < 3; ++row) EXPECT_NEAR(table.order(row), 2.0, 0.05);
  EXPECT_LT(table.last_error(), 2e-3);
}

// Tip of a cantilever under P L² / (E I) = 3, as in A2. An element that turns by phi against its
// neighbours has the energy of its curve up to terms of phi² of it, and phi falls with its length.
// The elastica does not stretch: r = 1 mm, so that the beam does by 3 r² / 4, 1e-6, at most.
TEST(BeamRefinement, AnElasticaBendsFar) {
  const BeamSection section = dynamics::circular_section(0.001, kModulus, 0.25);
  Refinement table("elastica, P L² / (E I) = 3, deflection of the tip (m)", 0.603253);
  for (const int elements : {4, 8, 16, 32}) {
    Scene scene = chain(elements, 1.0, section);
    Eigen::VectorXd loads = Eigen::VectorXd::Zero(first_entry(scene.state.size()));
    loads[loads.size() - 4] = -3.0 * kModulus * section.second_moment;

    balance(scene, loads, 10);

    table.add(elements, -scene.state.position.back().z());
  }
  table.print();
  EXPECT_NEAR(table.last_order(), 2.0, 0.1);
  EXPECT_LT(table.last_error(), 1e-3);
}

/// N, between two pins, by bisection.
double buckling_force(int elements, const BeamSection& section) {
  const Scene column = chain(elements, 1.0, section);
  const double euler = pi * pi * kModulus * section.second_moment;
  double below = 0.5 * euler, above = 2.0 * euler;
  while (above - below > 1e-9 * euler) {
    const double middle = 0.5 * (below + above);
    (is_stable(column, middle) ? below : above) = middle;
  }
  return below;
}

// Euler: P = pi² E I / L². The force P acts along straight chords: on a sine of nodes, with
// a = pi / n, it pushes with P / l 4 sin²(a / 2), and the spline through the nodes resists with
// E I / l³ 16 sin⁴(a / 2) 6 / (4 + 2 cos a). So P over Euler's is 24 sin²(a / 2) / (a² (4 + 2 cos
// a)) = 1 + a² / 12 + ..., an error of pi² / (12 n²).
TEST(BeamRefinement, AColumnBucklesUnderEulersForce) {
  const BeamSection section = dynamics::circular_section(0.002, kModulus, 0.25);
  Refinement table("column between pins, buckling force over Euler's", 1.0);
  const double euler = pi * pi * kModulus * section.second_moment;
  for (const int elements : {2, 4, 8, 16})
    table.add(elements, buckling_force(elements, section) / euler);
  table.print();
  EXPECT_NEAR(table.last_order(), 2.0, 0.05);
  EXPECT_NEAR(table.last_error() * 12.0 * 16 * 16 / (pi * pi), 1.0, 0.03);
}

/// 1/s, of the first mode of a cantilever of 1 m.
double first_frequency(int elements, const BeamSection& section) {
  Scene scene = chain(elements, 1.0, section, 1000.0);
  scene.properties.held.front() = Held::everything;
  std::vector<double> shape;
  for (std::size_t i = 0; i < scene.state.size(); ++i) {
    const double x = scene.state.position[i].x();
    const double w = x * x * (6.0 - 4.0 * x + x * x) / 3.0;  // near the mode: that of a weight
    shape.push_back(w * scene.properties.mass[i]);
    scene.state.velocity[i] = Vec3(0.0, 0.0, 1e-4 * w);
  }
  dynamics::Simulation simulation(std::move(scene), {});
  return frequency_of_swing(simulation, shape);
}

// omega = 1.8751041² / L² sqrt(E I / (rho A)). Lumping adds to the mass of the mode w, L = 1:
// 2 w w' / (12 n²) at the tip over the integral of w²; with w = 2 and w' = 2 * 1.37651 there and
// the integral 1, 0.9177 / n², so the frequency is 0.4588 / n² too low.
TEST(BeamRefinement, ACantileverSwingsAtItsFirstFrequency) {
  const BeamSection section = dynamics::circular_section(0.004, kModulus, 0.25);
  const double expected = 1.8751041 * 1.8751041 / (2.0 * pi) *
                          std::sqrt(kModulus * section.second_moment / (1000.0 * section.area));
  Refinement table("cantilever, first frequency (1/s)", expected);
  for (const int elements : {2, 4, 8, 16}) table.add(elements, first_frequency(elements, section));
  table.print();
  EXPECT_NEAR(table.last_order(), 2.0, 0.05);
  EXPECT_NEAR(table.last_error() * 16 * 16 / 0.4588, 1.0, 0.05);
}

// A chain of links is a polygon with corners on a curve whose second derivative is bounded: second
// order.
TEST(BeamRefinement, AChainHangsAsACatenary) {
  const apps::HangingChain exact = apps::catenary(apps::kChainWeight);
  Refinement sag("catenary, sag (m)", exact.sag);
  Refinement pull("catenary, horizontal pull (N)", exact.pull);
  for (const int links : {6, 12, 24}) {
    const apps::HangingChain chain = apps::hang_chain(links);
    sag.add(links, chain.sag);
    pull.add(links, chain.pull);
  }
  sag.print();
  pull.print();
  EXPECT_NEAR(sag.last_order(), 2.0, 0.1);
  EXPECT_NEAR(pull.last_order(), 2.0, 0.1);
}

}  // namespace
}  // namespace plekton::test::beam_refinement_test
