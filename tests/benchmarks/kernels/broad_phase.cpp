// SPDX-License-Identifier: GPL-3.0-or-later
// Lists of candidates for packings of spheres: the tree of boxes, its pairs, and both as a
// simulation asks for them.
#include "geometry/neighbor/broad_phase.hpp"

#include "geometry/neighbor/neighbours.hpp"
#include "tests/benchmarks/kernels/run_over.hpp"
#include "tests/benchmarks/kernels/subjects.hpp"
#include "tests/support/seeded_random.hpp"

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace plekton::benchmarks {
namespace {

using geometry::Box;
using geometry::BroadPhase;
using geometry::IndexPair;
using geometry::Vec3;

constexpr double kRadius = 1e-3;         // m, mean
constexpr double kSkin = 0.1 * kRadius;  // m

/// A dense packing in a cube: a face-centred lattice of spheres of 0.9 to 1.1 radii that touch on
/// average, in random order; and the same a moment later, each moved by 0.6 skins, so that lists
/// expire.
struct Packing {
  std::vector<geometry::Sphere> spheres;
  std::array<std::vector<Vec3>, 2> x;
};

std::vector<Vec3> shuffled_lattice(std::size_t count, test::Random& random) {
  const double spacing = 2.0 * std::sqrt(2.0) * kRadius;
  const int side = static_cast<int>(std::ceil(std::cbrt(static_cast<double>(count) / 4.0)));
  std::vector<Vec3> x;
  for (int i = 0; i < side * side * side; ++i) {
    const Vec3 corner(i % side, i / side % side, i / side / side);
    for (const Vec3& at :
         {Vec3(0, 0, 0), Vec3(0.5, 0.5, 0), Vec3(0.5, 0, 0.5), Vec3(0, 0.5, 0.5)}) {
      if (x.size() < count) x.push_back(spacing * (corner + at));
    }
  }
  for (std::size_t i = count; i > 1; --i) std::swap(x[i - 1], x[random.index(i)]);
  return x;
}

Packing packing(std::size_t count) {
  test::Random random(1);
  Packing made;
  for (const Vec3& site : shuffled_lattice(count, random)) {
    const Vec3 x = site + random.in_cube(0.05 * kRadius);
    made.spheres.push_back({{geometry::id_at<geometry::NodeId>(made.spheres.size())},
                            random.uniform(0.9, 1.1) * kRadius});
    made.x[0].push_back(x);
    made.x[1].emplace_back(x + 0.6 * kSkin * random.direction());
  }
  return made;
}

std::vector<Box> boxes_of(const Packing& packing, std::size_t moment) {
  std::vector<Box> boxes;
  for (const auto& sphere : packing.spheres)
    boxes.push_back(box(sphere, packing.x[moment], 0.5 * kSkin));
  return boxes;
}

void time_rebuild(benchmark::State& state, std::size_t count) {
  const auto boxes = boxes_of(packing(count), 0);
  BroadPhase tree;
  run_steps(state, count, [&] { tree.rebuild(boxes); });
}

void time_refit(benchmark::State& state, std::size_t count) {
  const Packing spheres = packing(count);
  const std::array boxes{boxes_of(spheres, 0), boxes_of(spheres, 1)};
  BroadPhase tree;
  tree.rebuild(boxes[0]);
  std::size_t moment = 0;
  run_steps(state, count, [&] {
    moment = 1 - moment;
    tree.refit(boxes[moment]);
  });
}

void time_self_pairs(benchmark::State& state, std::size_t count) {
  BroadPhase tree;
  tree.rebuild(boxes_of(packing(count), 0));
  std::vector<IndexPair> pairs;
  run_steps(state, count, [&] { tree.self_pairs(pairs); });
  state.counters["pairs_per_sphere"] =
      static_cast<double>(pairs.size()) / static_cast<double>(count);
}

void time_lists(benchmark::State& state, std::size_t count) {
  const Packing spheres = packing(count);
  const geometry::Surface none;
  geometry::ThreadPool pool;
  geometry::Neighbours neighbours(spheres.spheres, none, kSkin);
  std::size_t moment = 0;
  bool all_made = neighbours.update(spheres.x[0], pool);
  run_steps(state, count, [&] {
    moment = 1 - moment;
    all_made = neighbours.update(spheres.x[moment], pool) && all_made;
  });
  if (!all_made) state.SkipWithError("a list was kept; nothing to time");
  state.counters["pairs_per_sphere"] =
      static_cast<double>(neighbours.sphere_pairs().size()) / static_cast<double>(count);
}

}  // namespace

void add_broad_phase() {
  using Time = void (*)(benchmark::State&, std::size_t);
  for (const std::size_t count : {std::size_t{10000}, std::size_t{100000}}) {
    for (const auto& [name, time] : {std::pair<const char*, Time>{"rebuild", time_rebuild},
                                     {"refit", time_refit},
                                     {"self_pairs", time_self_pairs},
                                     {"new_lists", time_lists}}) {
      add_benchmark("broad_phase/" + std::string(name) + "/" + std::to_string(count),
                    [time = time, count](benchmark::State& state) { time(state, count); });
    }
  }
}

}  // namespace plekton::benchmarks
