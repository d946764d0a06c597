// SPDX-License-Identifier: GPL-3.0-or-later
// Nearest points of the cores of two primitives, certified: geometry/closest.
#include "geometry/closest/core_pair.hpp"
#include "geometry/closest/point_segment.hpp"
#include "geometry/closest/point_triangle.hpp"
#include "geometry/closest/segment_segment.hpp"
#include "geometry/closest/segment_triangle.hpp"
#include "geometry/closest/triangle_triangle.hpp"
#include "tests/benchmarks/kernels/inputs.hpp"
#include "tests/benchmarks/kernels/subjects.hpp"

#include <string>

namespace plekton::benchmarks {
namespace {

struct NamedFamily {
  const char* name;
  PairFamily family;
};

/// Cores as they usually lie, and those for which doubles do not suffice.
constexpr std::array kFamilies{
    NamedFamily{"distant", PairFamily::distant},
    NamedFamily{"generic", PairFamily::generic},
    NamedFamily{"near_parallel", PairFamily::near_parallel},
    NamedFamily{"integer_grid", PairFamily::integer_grid},
    NamedFamily{"touching", PairFamily::touching},
    NamedFamily{"crossing", PairFamily::crossing},
};

/// Points are not parallel to anything, and two of them have nothing to cross.
bool applies(PairFamily family, std::size_t count_a, std::size_t count_b) {
  if (family == PairFamily::near_parallel) return count_a > 1;
  if (family == PairFamily::crossing) return count_b > 1;
  return true;
}

template <std::size_t kCountA, std::size_t kCountB, class Kernel>
void add_cores(const std::string& cores, Kernel kernel) {
  const auto ask = [kernel](const auto& pair) { return kernel(pair.a, pair.b); };
  for (const NamedFamily& named : kFamilies) {
    if (!applies(named.family, kCountA, kCountB)) continue;
    add_benchmark("closest/" + cores + "/" + named.name, [=](benchmark::State& state) {
      run_over(state, core_pairs<kCountA, kCountB>(named.family), ask);
    });
  }
  for (const bool turned : {false, true}) {
    const char* const name = turned ? "/turned_flat_lattice" : "/flat_lattice";
    add_benchmark("closest/" + cores + name, [=](benchmark::State& state) {
      run_over(state, lattice_pairs<kCountA, kCountB>(turned), ask);
    });
  }
}

}  // namespace

void add_closest_points() {
  add_cores<1, 1>("point_point", [](const auto& a, const auto& b) {
    return geometry::closest_points({{a[0], a[0], a[0]}, 1}, {{b[0], b[0], b[0]}, 1});
  });
  add_cores<1, 2>("point_segment",
                  [](const auto& a, const auto& b) { return geometry::point_segment(a[0], b); });
  add_cores<1, 3>("point_triangle",
                  [](const auto& a, const auto& b) { return geometry::point_triangle(a[0], b); });
  add_cores<2, 2>("segment_segment",
                  [](const auto& a, const auto& b) { return geometry::segment_segment(a, b); });
  add_cores<2, 3>("segment_triangle",
                  [](const auto& a, const auto& b) { return geometry::segment_triangle(a, b); });
  add_cores<3, 3>("triangle_triangle",
                  [](const auto& a, const auto& b) { return geometry::triangle_triangle(a, b); });
}

}  // namespace plekton::benchmarks
