// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/benchmarks/bed_maker.hpp"
#include "tests/benchmarks/scenes/benchmark_scene.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace plekton::benchmarks {

/// What a scene is made from.
struct SceneInput {
  Bed bed;         ///< empty for scenes without one
  int cells = 32;  ///< squares along the side of a sheet
};

/// A row of the table of scenes.
struct SceneEntry {
  std::string_view name;
  std::string_view what;
  std::string_view elements;   ///< of which kinds
  std::optional<BedKind> bed;  ///< which kind of bed it takes; none: it needs no input
  std::size_t spheres;         ///< of the bed that is made where none is given
  int warm_up;                 ///< steps before the clock starts, until the scene is typical
  int steps;                   ///< steps to time
  BenchmarkScene (*make)(const SceneInput&);
};

/// All scenes of plekton-bench.
std::span<const SceneEntry> scene_table() noexcept;

/// The table as text, one line for each scene.
std::string list_of_scenes();

/// @throws std::invalid_argument with the list, if there is no scene of that name
const SceneEntry& find_scene(std::string_view name);

}  // namespace plekton::benchmarks
