// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <string>

namespace plekton::benchmarks {

/// Inputs of a kernel, visited one after the other again and again: so many that no branch
/// predictor learns by heart which way each of them goes.
inline constexpr std::size_t kConfigurations = 65536;

/// Asks a kernel about one input in every iteration; reports questions per second.
template <class Inputs, class Kernel>
void run_over(benchmark::State& state, const Inputs& inputs, Kernel kernel) {
  std::size_t next = 0;
  for ([[maybe_unused]] auto iteration : state) {
    benchmark::DoNotOptimize(kernel(inputs[next]));
    if (++next == inputs.size()) next = 0;
  }
  state.SetItemsProcessed(state.iterations());
}

/// Does a step with many bodies in every iteration; reports bodies per second.
template <class Step>
void run_steps(benchmark::State& state, std::size_t bodies, Step step) {
  for ([[maybe_unused]] auto iteration : state) {
    step();
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(bodies));
}

/// Lists a benchmark. Its inputs are made when it runs.
/// @param run  called with the benchmark::State
template <class Run>
void add_benchmark(const std::string& name, Run run) {
  benchmark::RegisterBenchmark(name.c_str(), run);
}

}  // namespace plekton::benchmarks
