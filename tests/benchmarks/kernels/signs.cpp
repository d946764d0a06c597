// SPDX-License-Identifier: GPL-3.0-or-later
// The exact signs of geometry/base/predicates.hpp, one benchmark for each stage that may decide
// them.
#include "geometry/base/predicates.hpp"
#include "tests/benchmarks/kernels/run_over.hpp"
#include "tests/benchmarks/kernels/subjects.hpp"
#include "tests/support/point_triangle_families.hpp"

#include <initializer_list>
#include <stdexcept>
#include <string>
#include <vector>

namespace plekton::benchmarks {
namespace {

using geometry::sign_counters;
using test::Family;
using test::PointTriangle;

/// Which of its stages decides a sign.
enum class Stage : std::uint8_t { filter, double_double, interval, exact };

/// Asks once. @returns the stage that decided
template <class Sign>
Stage stage_of(const PointTriangle& query, Sign sign) {
  const auto before = sign_counters();
  benchmark::DoNotOptimize(sign(query));
  if (sign_counters().exact != before.exact) return Stage::exact;
  if (sign_counters().interval != before.interval) return Stage::interval;
  return sign_counters().double_double != before.double_double ? Stage::double_double
                                                               : Stage::filter;
}

/// For the filter points anywhere; for the others points 1e-17 to 1e-8 off the zero set of some
/// sign, from which those that are hard enough are chosen.
template <class Sign>
std::vector<PointTriangle> queries_for(Stage stage, Sign sign) {
  constexpr std::array kHard{Family::near_edge_plane, Family::above_a_vertex,
                             Family::coplanar_near_edge, Family::rotated_flat_grid};
  constexpr std::size_t kDraws = 1000 * kConfigurations;
  test::PointTriangleFamilies families(1);
  std::vector<PointTriangle> queries;
  for (std::size_t draw = 0; queries.size() < kConfigurations; ++draw) {
    if (draw == kDraws) throw std::runtime_error("too few queries for this stage");
    const Family family = stage == Stage::filter ? Family::generic : kHard[draw % kHard.size()];
    const PointTriangle query = families.draw(family);
    if (stage_of(query, sign) == stage) queries.push_back(query);
  }
  return queries;
}

template <class Sign>
void add_sign(const std::string& name, Sign sign) {
  struct NamedStage {
    const char* name;
    Stage stage;
  };
  for (const NamedStage& named :
       {NamedStage{"filter", Stage::filter}, NamedStage{"double_double", Stage::double_double}}) {
    add_benchmark("sign/" + name + "/" + named.name, [=](benchmark::State& state) {
      run_over(state, queries_for(named.stage, sign), sign);
    });
  }
}

}  // namespace

void add_signs() {
  add_sign("past_vertex",
           [](const PointTriangle& q) { return geometry::sign_past_vertex(q.x[0], q.x[1], q.p); });
  add_sign("inside_edge", [](const PointTriangle& q) {
    return geometry::sign_inside_edge(q.x[0], q.x[1], q.x[2], q.p);
  });
  add_sign("volume", [](const PointTriangle& q) {
    return geometry::sign_of_volume({q.x[0], q.x[1]}, {q.x[0], q.x[2]}, {q.x[0], q.p});
  });
}

}  // namespace plekton::benchmarks
