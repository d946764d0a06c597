// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/scenes/spheres_on_membrane.hpp"

#include "tests/benchmarks/scenes/parts.hpp"

namespace plekton::benchmarks {
namespace {

/// The sheet with its top at z = 0. It is cut as all codes cut it, the first cell from b to c:
/// geometry::plane_sheet begins with the other diagonal.
geometry::Mesh sheet(double side, int cells) {
  geometry::Mesh mesh;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i)
      mesh.points.emplace_back(i * side / cells, j * side / cells, -kMembraneRadius);
  }
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const int corner = j * (cells + 1) + i;
      const NodeId a{corner};
      const NodeId b{corner + 1};
      const NodeId c{corner + cells + 1};
      const NodeId d{corner + cells + 2};
      if ((i + j) % 2 != 0) {
        mesh.facets.insert(mesh.facets.end(), {{a, b, d}, {a, d, c}});
      } else {
        mesh.facets.insert(mesh.facets.end(), {{a, b, c}, {b, d, c}});
      }
    }
  }
  return mesh;
}

void hold_rim(std::size_t first_node, int cells, dynamics::Scene& scene) {
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const bool on_rim = i == 0 || j == 0 || i == cells || j == cells;
      const auto place = static_cast<std::size_t>(j * (cells + 1) + i);
      if (on_rim) scene.properties.held[first_node + place] = dynamics::Held::everything;
    }
  }
}

}  // namespace

BenchmarkScene spheres_on_membrane(const Bed& bed, int cells) {
  BenchmarkScene result = empty_scene(0.3);
  add_spheres(bed, result.scene);
  add_walls({bed.side, bed.side}, result.scene);
  const geometry::Mesh mesh = sheet(bed.side, cells);
  hold_rim(add_membrane(mesh, result.scene), cells, result.scene);
  result.element_count = bed.grains.size() + mesh.facets.size();
  return result;
}

}  // namespace plekton::benchmarks
