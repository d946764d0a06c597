// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/generate/lattice.hpp"
#include "geometry/mesh/mesh.hpp"
#include "tests/benchmarks/bed.hpp"
#include "tests/benchmarks/scenes/benchmark_scene.hpp"

/// What the scenes have in common: the numbers that every code takes, and the bodies made of them.
namespace plekton::benchmarks {

using contact::MaterialId;
using geometry::NodeId;
using geometry::Vec3;

constexpr double kTimeStep = 4e-6;             ///< s
constexpr double kSphereRadius = 1e-3;         ///< m, mean; radii are within 10 % of it
constexpr double kSphereDensity = 2500.0;      ///< kg/m³
constexpr double kYoungModulus = 2e6;          ///< Pa, of contacts: 2 kN/m between two mean spheres
constexpr double kStiffnessRatio = 2.0 / 7.0;  ///< tangential over normal
constexpr double kFriction = 0.5;
constexpr double kMembraneRadius = 3e-4;   ///< m, half of its thickness
constexpr double kBeamYoungModulus = 5e7;  ///< Pa, of membranes and grids
constexpr double kBeamPoissonRatio = 0.3;
constexpr double kBeamDensity = 3000.0;  ///< kg/m³
const Vec3 kGravity(0.0, 0.0, -9.81);    ///< m/s²

/// Of spheres, membranes, grids, and of walls that spheres touch.
constexpr MaterialId kCommonMaterial{0};
/// Of walls that nodes of membranes touch: with the common material 3.846 MPa, the stiffness and
/// slip that such nodes have where they bring the material of the beams to the wall.
constexpr MaterialId kStiffWallMaterial{1};

/// No bodies yet: the contact materials, gravity, the step, the skin as the program chooses it.
/// @param damping  numerical damping
BenchmarkScene empty_scene(double damping);

/// The spheres of a bed with their velocities.
void add_spheres(const Bed& bed, dynamics::Scene& scene);

/// Four walls at x = 0, x = length, y = 0, y = width.
struct Walls {
  double length;  ///< m
  double width;   ///< m
  MaterialId material = kCommonMaterial;
};
void add_walls(const Walls& walls, dynamics::Scene& scene);

/// A floor at z = 0.
void add_floor(MaterialId material, dynamics::Scene& scene);

/// The section of a bar of a membrane or a grid.
/// @param radius  m
dynamics::BeamSection beam_section(double radius);

/// A lattice of beams of one section, with a cylinder along every one; its nodes are free and at
/// rest.
/// @param radius   m, of the cylinders
/// @param density  kg/m³
/// @returns  the number of its first node; the others follow in the order of the points
std::size_t add_lattice(const geometry::Lattice& lattice, double radius,
                        const dynamics::BeamSection& section, double density,
                        dynamics::Scene& scene);

/// A mesh as a membrane: thick facets, a beam along every edge; its nodes are free and at rest.
/// @returns  the number of its first node; the others follow in the order of the points
std::size_t add_membrane(const geometry::Mesh& mesh, dynamics::Scene& scene);

}  // namespace plekton::benchmarks
