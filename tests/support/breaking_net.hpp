// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/simulation.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "tests/support/seeded_random.hpp"

#include <array>
#include <cstdint>
#include <stdexcept>
#include <utility>

/// Nets and lattice membranes whose bonds are broken one by one.
namespace plekton::test {

using dynamics::BeamBond;
using dynamics::Held;
using dynamics::Scene;
using geometry::NodeId;
using geometry::Vec3;
using BreakingSimulation = dynamics::Simulation;

inline constexpr double kMesh = 0.1;         // m, side of a square
inline constexpr double kWireRadius = 0.01;  // m
inline constexpr contact::MaterialId kWire{0};

struct NetOptions {
  int squares = 4;  ///< along each side
  bool has_facets = false;
  bool has_cylinders = true;  ///< along all bonds; without them only facets have a shape
  Held inside = Held::nothing;
  Held rim = Held::everything;
  double roughness = 0.0;  ///< m, nodes are moved by up to this much
};

inline NodeId net_node(const NetOptions& net, int i, int j) {
  return geometry::id_at<NodeId>(static_cast<std::size_t>(j * (net.squares + 1) + i));
}

/// A square net in z = 0 about the origin, of bonds along the sides of squares, and along their
/// diagonals where it has facets. It has to be the first of a scene.
inline void add_net(Scene& scene, const NetOptions& net, std::uint64_t seed = 1) {
  Random random(seed);
  for (int j = 0; j <= net.squares; ++j) {
    for (int i = 0; i <= net.squares; ++i) {
      const bool is_rim = i == 0 || j == 0 || i == net.squares || j == net.squares;
      scene.add_node(kMesh * Vec3(i - 0.5 * net.squares, j - 0.5 * net.squares, 0.0) +
                         random.in_cube(net.roughness),
                     is_rim ? net.rim : net.inside);
    }
  }
  const auto section = dynamics::circular_section(kWireRadius, 1e8, 0.3);
  const auto bond = [&](NodeId a, NodeId b) {
    scene.add_beam(a, b, section, 1000.0);
    if (net.has_cylinders) scene.add_cylinder(a, b, kWireRadius, kWire);
  };
  const auto at = [&](int i, int j) { return net_node(net, i, j); };
  for (int j = 0; j <= net.squares; ++j) {
    for (int i = 0; i <= net.squares; ++i) {
      if (i < net.squares) bond(at(i, j), at(i + 1, j));
      if (j < net.squares) bond(at(i, j), at(i, j + 1));
      if (i == net.squares || j == net.squares || !net.has_facets) continue;
      bond(at(i, j), at(i + 1, j + 1));
      scene.add_facet(at(i, j), at(i + 1, j), at(i + 1, j + 1), kWireRadius, kWire);
      scene.add_facet(at(i, j), at(i + 1, j + 1), at(i, j + 1), kWireRadius, kWire);
    }
  }
}

/// The bond between two nodes.
inline std::size_t bond_between(const std::vector<BeamBond>& bonds, NodeId a, NodeId b) {
  for (std::size_t i = 0; i < bonds.size(); ++i) {
    if (std::minmax(bonds[i].nodes[0], bonds[i].nodes[1]) == std::minmax(a, b)) return i;
  }
  throw std::logic_error("no bond between these nodes");
}

/// A scene of what is left of a simulation, as it is now.
inline Scene scene_left(const BreakingSimulation& simulation, const Scene& first) {
  Scene left = first;
  left.state = simulation.state();
  left.elements = simulation.elements();
  left.cylinder_materials.assign(left.elements.cylinders.size(), kWire);
  left.facet_materials.assign(left.elements.facets.size(), kWire);
  std::vector<BeamBond> bonds;
  for (std::size_t i = 0; i < first.bonds.size(); ++i) {
    if (!simulation.bonds().is_broken(i)) bonds.push_back(first.bonds[i]);
  }
  left.bonds = std::move(bonds);
  return left;
}

}  // namespace plekton::test
