// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/geometry/import_time.hpp"

#include "geometry/mesh/io/import.hpp"
#include "geometry/mesh/io/mesh_file.hpp"
#include "tests/support/temporary_folder.hpp"

#include <chrono>
#include <cmath>
#include <numbers>

namespace plekton::benchmarks {
namespace {

using geometry::Mesh;
using geometry::NodeId;
using geometry::Vec3;

/// n x n squares of two facets.
Mesh torus(int n) {
  Mesh mesh;
  const double turn = 2.0 * std::numbers::pi / n;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      const double radius = 1.0 + 0.3 * std::cos(k * turn);
      mesh.points.emplace_back(radius * std::cos(i * turn), radius * std::sin(i * turn),
                               0.3 * std::sin(k * turn));
    }
  }
  const auto at = [n](int i, int k) { return NodeId{(i % n) * n + k % n}; };
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      mesh.facets.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.facets.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  }
  return mesh;
}

}  // namespace

nlohmann::ordered_json import_time(int facets) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "torus.stl";
  const int n = static_cast<int>(std::ceil(std::sqrt(0.5 * facets)));
  geometry::write_mesh_file(file, torus(n));
  double best = 1e300;
  std::size_t found = 0;
  for (int run = 0; run < 3; ++run) {
    const auto start = std::chrono::steady_clock::now();
    found = geometry::import_mesh(file).mesh.facets.size();
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    best = std::min(best, time.count());
  }
  return {{"import", "torus.stl"}, {"facets", found}, {"s", best}};
}

}  // namespace plekton::benchmarks
