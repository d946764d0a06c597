// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/generate/generators.hpp"
#include "tests/support/seeded_random.hpp"
#include "tests/support/sheet_structure.hpp"

#include <algorithm>
#include <numbers>

/// Sheets to be loaded: meshes, and scenes made of them.
namespace plekton::test {

using dynamics::SheetSection;
using geometry::Mesh;

/// A disk around the origin in z = 0: rings of 6, 12, 18, ... nodes around one in the middle.
inline Mesh disk(double radius, int rings) {
  Mesh mesh;
  mesh.points.push_back(Vec3::Zero());
  const auto first = [](int ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); };
  for (int ring = 1; ring <= rings; ++ring) {
    for (int k = 0; k < 6 * ring; ++k) {
      const double angle = std::numbers::pi * k / (3.0 * ring);
      mesh.points.push_back(radius * ring / rings * Vec3(std::cos(angle), std::sin(angle), 0.0));
    }
  }
  for (int ring = 1; ring <= rings; ++ring) {
    const auto outer = [&](int k) { return NodeId{first(ring) + k % (6 * ring)}; };
    const auto inner = [&](int k) {
      return NodeId{ring == 1 ? 0 : first(ring - 1) + k % (6 * (ring - 1))};
    };
    for (int sector = 0; sector < 6; ++sector) {
      for (int k = 0; k < ring; ++k) {
        const int out = sector * ring + k;
        const int in = sector * (ring - 1) + k;
        mesh.facets.push_back({outer(out), outer(out + 1), inner(in)});
        if (k + 1 < ring) mesh.facets.push_back({inner(in), outer(out + 1), inner(in + 1)});
      }
    }
  }
  return mesh;
}

/// Moves every point that a test picks in x and y, by up to a length.
template <class Picks>
void jitter(Mesh& mesh, double length, Picks picks) {
  Random random(21);
  for (Vec3& x : mesh.points) {
    const Vec3 way = random.in_cube(length);
    if (picks(x)) x.head<2>() += way.head<2>();
  }
}

/// @param held  what of a node is held, by its place
template <class HeldAt>
Scene sheet_of(const Mesh& mesh, const SheetSection& section, double density, HeldAt held) {
  Scene scene;
  for (const Vec3& x : mesh.points) scene.add_node(x, held(x));
  for (const auto& facet : mesh.facets) scene.add_sheet_facet(facet, section, density);
  return scene;
}

/// Dead load (N) along a direction, the same on each area: a third of each facet's on its corners.
inline SheetLoads uniform_load(const Scene& scene, const Vec3& pressure) {
  SheetLoads loads{Eigen::VectorXd::Zero(static_cast<Eigen::Index>(6 * scene.state.size())), 0.0};
  for (const auto& facet : scene.sheet_facets) {
    for (const NodeId node : facet.nodes) {
      loads.dead.segment<3>(static_cast<Eigen::Index>(6 * index_of(node))) +=
          dynamics::area_of(facet) / 3.0 * pressure;
    }
  }
  return loads;
}

/// The node nearest to a place.
inline std::size_t nearest_node(const Scene& scene, const Vec3& place) {
  const auto& x = scene.state.position;
  return static_cast<std::size_t>(std::min_element(x.begin(), x.end(),
                                                   [&](const Vec3& a, const Vec3& b) {
                                                     return (a - place).squaredNorm() <
                                                            (b - place).squaredNorm();
                                                   }) -
                                  x.begin());
}

}  // namespace plekton::test
