// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/beam_structure.hpp"
#include "tests/support/seeded_random.hpp"

#include <numeric>
#include <vector>

/// Free lattices of beams and of wires that are pulled apart by their velocities, yield and break.
namespace plekton::test {

inline constexpr double kLatticeSpacing = 0.1;  // m

/// A free lattice of n x n nodes with bonds along the rows, columns and one diagonal.
inline Scene free_lattice(int n, const BeamSection& section) {
  Scene scene;
  const auto node = [n](int i, int j) {
    return geometry::id_at<NodeId>(static_cast<std::size_t>(i * n + j));
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) scene.add_node(kLatticeSpacing * Vec3(i, j, 0.0));
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      if (i + 1 < n) scene.add_beam(node(i, j), node(i + 1, j), section, 1000.0);
      if (j + 1 < n) scene.add_beam(node(i, j), node(i, j + 1), section, 1000.0);
      if (i + 1 < n && j + 1 < n) scene.add_beam(node(i, j), node(i + 1, j + 1), section, 1000.0);
    }
  }
  return scene;
}

inline std::vector<std::size_t> all_bonds(const Scene& scene) {
  std::vector<std::size_t> bonds(scene.bonds.size());
  std::iota(bonds.begin(), bonds.end(), 0U);
  return bonds;
}

/// Velocities (m/s, rad/s) at random, which pull it apart.
inline void throw_apart(Scene& scene, double speed, double spin) {
  Random random(9);
  for (std::size_t i = 0; i < scene.state.size(); ++i) {
    scene.state.velocity[i] = random.in_cube(speed);
    scene.state.angular_velocity[i] = random.in_cube(spin);
  }
}

/// Beams that yield, and break where they have yielded by much.
inline Scene yielding_beams() {
  Scene scene = free_lattice(5, dynamics::circular_section(0.01, 1e8, 0.3));
  dynamics::BondStrength strength;
  strength.yield_stress = 4e5;
  strength.hardening = 1e7;
  strength.rupture_strain = 0.03;
  scene.bond_laws = {{strength, all_bonds(scene)}};
  throw_apart(scene, 4.0, 40.0);
  return scene;
}

/// Likewise of wires.
inline Scene yielding_wires() {
  const dynamics::WireCurve curve{{{0.004, 120.0}, {0.02, 160.0}, {0.05, 170.0}}};
  Scene scene = free_lattice(5, dynamics::wire_section(0.01, curve));
  for (dynamics::Held& held : scene.properties.held) held = dynamics::Held::rotation;
  scene.bond_laws = {{curve, all_bonds(scene)}};
  throw_apart(scene, 8.0, 0.0);
  return scene;
}

}  // namespace plekton::test
