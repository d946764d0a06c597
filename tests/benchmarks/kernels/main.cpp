// SPDX-License-Identifier: GPL-3.0-or-later
// plekton-bench-kernels: what a call of each kernel costs, with the options of Google Benchmark
// (--help). README.md says what the names mean.
#include "geometry/base/vector_width.hpp"
#include "geometry/version.hpp"
#include "tests/benchmarks/kernels/subjects.hpp"

#include <benchmark/benchmark.h>

#include <string>

namespace {

struct LanesOf {
  int& lanes;

  template <int W>
  PLEKTON_INLINE void operator()(plekton::geometry::Width<W>) const noexcept {
    lanes = W;
  }
};

void describe_build() {
  int lanes = 0;
  plekton::geometry::with_widest_vectors(LanesOf{lanes});
  benchmark::AddCustomContext("plekton_version", std::string(plekton::kVersion));
  benchmark::AddCustomContext("plekton_lanes", std::to_string(lanes));
#ifdef __OPTIMIZE__
  benchmark::AddCustomContext("plekton_build", "optimised");
#else
  benchmark::AddCustomContext("plekton_build", "not optimised: these times mean nothing");
#endif
}

}  // namespace

int main(int argc, char** argv) {
  using namespace plekton::benchmarks;
  add_closest_points();
  add_pairs();
  add_signs();
  add_contact_law();
  add_beams();
  add_broad_phase();
  add_patches();
  add_wrapped_balls();
  add_leapfrog();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  describe_build();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
