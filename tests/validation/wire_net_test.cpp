// SPDX-License-Identifier: GPL-3.0-or-later
// Wires and nets of wire that are pulled until they break, against the curves they are given.
//
// A double-twisted hexagonal net between guides at its sides is pulled along its twists. With the
// mesh size D, the twist length t and the height h of a single wire, a wire is l = sqrt(h² + D²/4)
// long. Every second twist of a row is half of a mesh aside, so a guided net deforms alike in all
// its meshes: with the stretched height h', l' = sqrt(h'² + D²/4), a twist carries
//
//     P = 2 f_wire(l' / l - 1) h' / l' = f_twist(t' / t - 1),
//
// and the net of n meshes across and R rows of twists n P at the elongation R (t' - t) + (R + 1)
// (h' - h). At the sides a twist has one wire at either end instead of two, and half of the force.
#include "dynamics/simulation.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "geometry/mesh/generate/lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <utility>
#include <vector>

namespace plekton::test::wire_net_test {
namespace {

using dynamics::Held;
using dynamics::Scene;
using dynamics::Simulation;
using dynamics::WireCurve;
using geometry::index_of;
using geometry::LatticePart;
using geometry::NodeId;
using geometry::Vec3;

constexpr double kWireRadius = 1.35e-3;  // m
constexpr double kDensity = 7850.0;      // kg/m³
const WireCurve kWire{{{0.012, 1380.0}, {0.05, 2150.0}, {0.1, 2400.0}}};
const WireCurve kTwist{{{0.012, 2760.0}, {0.05, 4300.0}, {0.1, 4800.0}}};

WireCurve scaled(WireCurve curve, double factor) {
  for (WireCurve::Point& point : curve.points) point.force *= factor;
  return curve;
}

NodeId add_pin(Scene& scene, const Vec3& place) {
  return scene.add_node(place, Held::rotation);
}

/// Bars along x, each of some wires one after the other, from the first node to the last.
struct Strip {
  Scene scene;
  std::vector<NodeId> first, last;
};

Strip parallel_wires(int count, int pieces, double length, const WireCurve& curve) {
  Strip strip;
  Scene& scene = strip.scene;
  for (int w = 0; w < count; ++w) {
    NodeId before = add_pin(scene, Vec3(0.0, 0.01 * w, 0.0));
    strip.first.push_back(before);
    for (int i = 1; i <= pieces; ++i) {
      const NodeId next = add_pin(scene, Vec3(length * i / pieces, 0.01 * w, 0.0));
      scene.add_beam(before, next, dynamics::wire_section(kWireRadius, curve), kDensity);
      before = next;
    }
    strip.last.push_back(before);
  }
  std::vector<std::size_t> all(scene.bonds.size());
  std::iota(all.begin(), all.end(), 0U);
  scene.bond_laws = {{curve, std::move(all)}};
  return strip;
}

dynamics::PrescribedMotion moving(std::vector<NodeId> nodes, const Vec3& velocity,
                                  dynamics::TimeTable factor = {}) {
  dynamics::PrescribedMotion motion;
  motion.nodes = std::move(nodes);
  motion.velocity = velocity;
  motion.factor = std::move(factor);
  return motion;
}

/// N, of the bonds on some nodes, along a direction.
double force_on(const Simulation& simulation, const std::vector<NodeId>& nodes, int axis) {
  double sum = 0.0;
  for (const NodeId node : nodes) sum += simulation.forces().force[index_of(node)][axis];
  return sum;
}

TEST(WireStrip, FollowsTheCurveOfItsWiresAndBreaksAtItsEnd) {
  constexpr int kWires = 7;
  constexpr double kLength = 0.3;
  constexpr double kSpeed = 2.0;  // m/s
  Strip strip = parallel_wires(kWires, 1, kLength, kWire);
  // Between held nodes the wires have no inertia: the curve is exact at any speed.
  strip.scene.loads.motions = {moving(strip.first, Vec3::Zero()),
                               moving(strip.last, kSpeed * Vec3::UnitX())};
  const std::vector<NodeId> last = strip.last;
  dynamics::SimulationOptions options;
  options.time_step = 1e-6;
  Simulation simulation(std::move(strip.scene), options);

  double worst = 0.0;
  double at_break = 0.0;
  while (at_break == 0.0) {
    const double strain = (simulation.state().position[index_of(last[0])].x() - kLength) / kLength;
    simulation.step();
    const double force = -force_on(simulation, last, 0);
    if (strain <= kWire.breaking_strain())
      worst = std::max(worst, std::abs(force - kWires * kWire.force_at(strain)));
    if (simulation.bonds().is_broken(0)) at_break = strain;
    ASSERT_LT(strain, 0.2);
  }

  // A length is rounded to eps L, worth eps times the first slope.
  EXPECT_LT(worst, 100.0 * 2.2e-16 * kWires * kWire.first_slope());
  EXPECT_NEAR(at_break, kWire.breaking_strain(), kSpeed * 1e-6 / kLength);
  for (std::size_t i = 0; i < simulation.bonds().size(); ++i)
    EXPECT_TRUE(simulation.bonds().is_broken(i));
  // The area under the curve, to the second order of the step.
  double area = 0.0;
  WireCurve::Point before{0.0, 0.0};
  for (const WireCurve::Point& point : kWire.points) {
    area += 0.5 * (before.force + point.force) * (point.strain - before.strain);
    before = point;
  }
  EXPECT_NEAR(simulation.energy().bond_dissipated, kWires * area * kLength,
              1e-4 * kWires * area * kLength);
  EXPECT_LT(simulation.energy().closure(), 1e-6);
}

TEST(WireStrip, FollowsTheCurveWithWiresOfManyPieces) {
  constexpr double kLength = 0.5;
  constexpr int kPieces = 10;
  constexpr double kSpeed = 0.2;  // m/s
  Strip strip = parallel_wires(1, kPieces, kLength, kWire);
  strip.scene.loads.motions = {
      moving(strip.first, Vec3::Zero()),
      moving(strip.last, kSpeed * Vec3::UnitX(), dynamics::TimeTable({{0.0, 0.0}, {0.01, 1.0}}))};
  std::vector<std::size_t> all(kPieces);
  std::iota(all.begin(), all.end(), 0U);
  strip.scene.loads.beam_damping = {{all, 0.1}};
  const std::vector<NodeId> first = strip.first, last = strip.last;
  Simulation simulation(std::move(strip.scene), {});

  double worst = 0.0;
  double breaking = 0.0;
  while (breaking == 0.0) {
    const double strain = (simulation.state().position[index_of(last[0])].x() - kLength) / kLength;
    simulation.step();
    if (!simulation.yielding_bonds().broken().empty()) breaking = strain;
    if (breaking == 0.0)
      worst = std::max(worst, std::abs(force_on(simulation, first, 0) - kWire.force_at(strain)));
    ASSERT_LT(strain, 0.2);
  }

  // Inertia: density c v A = 7850 * 1600 m/s * 0.2 m/s * 5.7 mm² = 15 N from end to end while the
  // wire is elastic.
  EXPECT_LT(worst, 15.0);
  EXPECT_NEAR(breaking, kWire.breaking_strain(), 0.02 * kWire.breaking_strain());
  for (int i = 0; i < 2000; ++i) simulation.step();
  EXPECT_LT(std::abs(force_on(simulation, first, 0)), 1.0);  // of the dashpots of loose pieces
  EXPECT_LT(simulation.energy().closure(), 5e-3);
}

constexpr geometry::HexagonalNet kNet{
    .mesh_size = 0.083, .twist_length = 0.04, .wire_height = 0.04, .meshes_across = 6, .rows = 5};
constexpr double kPull = 0.25;  // m/s

/// The net between its grips and guides.
struct GuidedNet {
  Scene scene;
  std::vector<NodeId> bottom, top;
};

std::vector<NodeId> nodes_at(const Scene& scene, int axis, double place) {
  std::vector<NodeId> nodes;
  for (std::size_t i = 0; i < scene.state.size(); ++i) {
    if (std::abs(scene.state.position[i][axis] - place) < 1e-9)
      nodes.push_back(geometry::id_at<NodeId>(i));
  }
  return nodes;
}

GuidedNet guided_net() {
  GuidedNet net;
  Scene& scene = net.scene;
  constexpr contact::MaterialId kSteel{0};
  scene.materials = {{1e9, 0.3, 0.36}};
  const geometry::Lattice lattice = geometry::hexagonal_net(kNet);
  Vec3 lower = lattice.points[0], upper = lattice.points[0];
  for (const Vec3& point : lattice.points) {
    add_pin(scene, point);
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  std::vector<dynamics::BondLaw> laws{{kWire, {}}, {kTwist, {}}, {scaled(kTwist, 0.5), {}}};
  for (const auto& [nodes, part] : lattice.edges) {
    const double x = lattice.points[index_of(nodes[0])].x();
    const bool is_aside = std::min(x - lower.x(), upper.x() - x) < 1e-9;
    scene.add_cylinder(nodes[0], nodes[1], kWireRadius, kSteel);
    dynamics::BondLaw& law = laws[part == LatticePart::wire ? 0 : is_aside ? 2 : 1];
    law.bonds.push_back(scene.add_beam(
        nodes[0], nodes[1], dynamics::wire_section(kWireRadius, std::get<WireCurve>(law.law)),
        kDensity));
  }
  scene.bond_laws = std::move(laws);
  net.bottom = nodes_at(scene, 1, lower.y());
  net.top = nodes_at(scene, 1, upper.y());
  for (const double side : {lower.x(), upper.x()}) {
    for (const NodeId node : nodes_at(scene, 0, side))
      scene.properties.held[index_of(node)] = Held::rotation | Held::along_x;
  }
  const dynamics::TimeTable ramp({{0.0, 0.0}, {0.02, 1.0}});
  scene.loads.motions = {moving(net.bottom, Vec3::Zero()),
                         moving(net.top, kPull * Vec3::UnitY(), ramp)};
  std::vector<std::size_t> all(scene.bonds.size());
  std::iota(all.begin(), all.end(), 0U);
  scene.loads.beam_damping = {{std::move(all), 0.1}};
  return net;
}

/// How the guided net stretches as its wires do.
struct NetState {
  double elongation;  // m, of the net
  double force;       // N, of the net
};

NetState net_at(double wire_strain) {
  const double half = 0.5 * kNet.mesh_size;
  const double wire = std::hypot(kNet.wire_height, half) * (1.0 + wire_strain);
  const double height = std::sqrt(wire * wire - half * half);
  const double twist_force = 2.0 * kWire.force_at(wire_strain) * height / wire;
  double low = 0.0, high = kTwist.breaking_strain();
  for (int i = 0; i < 60; ++i) {
    const double mid = 0.5 * (low + high);
    (kTwist.force_at(mid) < twist_force ? low : high) = mid;
  }
  return {kNet.rows * low * kNet.twist_length + (kNet.rows + 1) * (height - kNet.wire_height),
          kNet.meshes_across * twist_force};
}

/// N, at an elongation below that of the break.
double net_force(double elongation) {
  double low = 0.0, high = kWire.breaking_strain();
  for (int i = 0; i < 60; ++i) {
    const double mid = 0.5 * (low + high);
    (net_at(mid).elongation < elongation ? low : high) = mid;
  }
  return net_at(low).force;
}

TEST(WireNet, FollowsTheCurveOfItsMeshesAndClosesItsEnergyThroughTheBreaks) {
  GuidedNet net = guided_net();
  const std::size_t across = 2 * static_cast<std::size_t>(kNet.meshes_across);
  const double start = net.scene.state.position[index_of(net.top[0])].y();
  Simulation simulation(std::move(net.scene), {});
  const NetState last = net_at(kWire.breaking_strain());

  std::printf("elongation (mm)  force (kN)  by hand (kN)  closure\n");
  double worst = 0.0, first_break = 0.0, largest = 0.0, closure = 0.0;
  std::size_t broken = 0;
  int rows = 0;
  for (double elongation = 0.0; elongation < 1.3 * last.elongation;) {
    elongation = simulation.state().position[index_of(net.top[0])].y() - start;
    simulation.step();
    const double force = -force_on(simulation, net.top, 1);
    broken += simulation.yielding_bonds().broken().size();
    if (broken > 0 && first_break == 0.0) first_break = elongation;
    largest = std::max(largest, force);
    if (first_break == 0.0) worst = std::max(worst, std::abs(force - net_force(elongation)));
    if (simulation.steps() % 50 == 0) closure = std::max(closure, simulation.energy().closure());
    if (elongation * 20.0 < last.elongation * rows) continue;
    ++rows;
    std::printf("%12.2f  %12.3f  %12.3f  %10.2g\n", 1e3 * elongation, 1e-3 * force,
                first_break == 0.0 ? 1e-3 * net_force(elongation) : 0.0,
                simulation.energy().closure());
  }
  std::printf("first break at %.2f mm (by hand %.2f), largest force %.3f kN (%.3f), %zu broken\n",
              1e3 * first_break, 1e3 * last.elongation, 1e-3 * largest, 1e-3 * last.force, broken);

  EXPECT_LT(worst, 0.02 * last.force);
  EXPECT_NEAR(first_break, last.elongation, 0.02 * last.elongation);
  EXPECT_NEAR(largest, last.force, 0.02 * last.force);
  EXPECT_GE(broken, across);  // it has torn from side to side
  EXPECT_LT(std::abs(force_on(simulation, net.top, 1)), 0.01 * last.force);
  EXPECT_EQ(simulation.elements().cylinders.size() + broken, simulation.bonds().size());
  EXPECT_LT(closure, 5e-3);
}

}  // namespace
}  // namespace plekton::test::wire_net_test
