// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/scenes.hpp"

#include <array>
#include <set>
#include <utility>

namespace plekton::benchmarks {
namespace {

using contact::MaterialId;
using geometry::NodeId;
using geometry::Vec3;

constexpr double kTimeStep = 4e-6;
constexpr double kSkin = 1e-4;
const Vec3 kGravity(0.0, 0.0, -9.81);

void add_spheres(const Bed& bed, dynamics::Scene& scene) {
  for (const Bed::Grain& grain : bed.grains) {
    const auto sphere = scene.add_sphere(grain.position, grain.radius, 2500.0, MaterialId{0});
    const std::size_t node = index_of(scene.elements.spheres[index_of(sphere)].nodes[0]);
    scene.state.velocity[node] = grain.velocity;
    scene.state.angular_velocity[node] = grain.angular_velocity;
  }
}

void add_walls(double length, double width, dynamics::Scene& scene) {
  const Vec3 far(length, width, 0.0);
  const Vec3 none = Vec3::Zero();
  scene.planes.push_back({none, Vec3::UnitX(), none, MaterialId{0}});
  scene.planes.push_back({far, -Vec3::UnitX(), none, MaterialId{0}});
  scene.planes.push_back({none, Vec3::UnitY(), none, MaterialId{0}});
  scene.planes.push_back({far, -Vec3::UnitY(), none, MaterialId{0}});
}

/// Nodes of the sheet, row by row; those on the rim are held.
std::vector<NodeId> add_sheet_nodes(double side, int cells, double radius, dynamics::Scene& scene) {
  std::vector<NodeId> nodes;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const bool on_rim = i == 0 || j == 0 || i == cells || j == cells;
      nodes.push_back(
          scene.add_node(Vec3(i * side / cells, j * side / cells, -radius),
                         on_rim ? dynamics::Held::everything : dynamics::Held::nothing));
    }
  }
  return nodes;
}

std::vector<std::array<NodeId, 3>> sheet_facets(const std::vector<NodeId>& nodes, int cells) {
  std::vector<std::array<NodeId, 3>> facets;
  const auto at = [&](int i, int j) {
    return nodes[static_cast<std::size_t>(j * (cells + 1) + i)];
  };
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const NodeId a = at(i, j);
      const NodeId b = at(i + 1, j);
      const NodeId c = at(i, j + 1);
      const NodeId d = at(i + 1, j + 1);
      if ((i + j) % 2 != 0) {
        facets.insert(facets.end(), {{a, b, d}, {a, d, c}});
      } else {
        facets.insert(facets.end(), {{a, b, c}, {b, d, c}});
      }
    }
  }
  return facets;
}

}  // namespace

BenchmarkScene sphere_bed(const Bed& bed) {
  BenchmarkScene result{};
  result.scene.materials = {{2e6, 2.0 / 7.0, 0.5}};
  add_spheres(bed, result.scene);
  add_walls(bed.side * bed.extent, bed.side, result.scene);
  result.scene.planes.push_back({Vec3::Zero(), Vec3::UnitZ(), Vec3::Zero(), MaterialId{0}});
  result.options = {kTimeStep, {kGravity, 0.2, true}, kSkin, 1};
  result.element_count = bed.grains.size();
  return result;
}

BenchmarkScene spheres_on_membrane(const Bed& bed, int cells) {
  constexpr double kRadius = 3e-4;
  constexpr double kDensity = 3000.0;
  BenchmarkScene result{};
  result.scene.materials = {{2e6, 2.0 / 7.0, 0.5}};
  add_spheres(bed, result.scene);
  add_walls(bed.side, bed.side, result.scene);

  const auto nodes = add_sheet_nodes(bed.side, cells, kRadius, result.scene);
  const auto section = dynamics::circular_section(kRadius, 5e7, 0.3);
  const auto facets = sheet_facets(nodes, cells);
  std::set<std::pair<NodeId, NodeId>> sides;
  for (const auto& facet : facets) {
    result.scene.add_facet(facet[0], facet[1], facet[2], kRadius, MaterialId{0});
    for (std::size_t k = 0; k < 3; ++k) sides.insert(std::minmax(facet[k], facet[(k + 1) % 3]));
  }
  for (const auto& [a, b] : sides) result.scene.add_beam(a, b, section, kDensity);
  result.options = {kTimeStep, {kGravity, 0.3, true}, kSkin, 1};
  result.element_count = bed.grains.size() + facets.size();
  return result;
}

}  // namespace plekton::benchmarks
