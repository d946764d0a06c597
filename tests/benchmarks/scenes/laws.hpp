// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/benchmarks/scenes/benchmark_scene.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace plekton::benchmarks {

/// The laws that a scene may have: the name of a contact law, or that with "+parts": resistance to
/// rolling and twisting, and a dashpot.
std::vector<std::string> law_names();

/// Puts all contacts of a scene under a law, as a scenario would. Hertzian bodies get a modulus
/// with which they rest with about the overlaps of linear springs, so that there are as many
/// contacts; bonds and adhesion are a few weights of a sphere strong.
/// @throws std::invalid_argument with the names, if there is no such law
void set_law(std::string_view name, BenchmarkScene& scene);

}  // namespace plekton::benchmarks
