// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/benchmarks/bed.hpp"

#include <cstdint>
#include <iosfwd>

namespace plekton::benchmarks {

enum class BedKind : std::uint8_t {
  cube,  ///< about as high as wide
  slab,  ///< about 5 spheres deep: to lie on a membrane
  flow   ///< a cube whose wall was withdrawn 32 ms ago, in a box three times as long as wide
};

struct BedOrder {
  BedKind kind = BedKind::cube;
  std::size_t spheres = 5000;  ///< at least 1
  std::uint64_t seed = 1;      ///< the same seed, the same bed
  int threads = 1;             ///< does not change the bed
};

/// A bed rests when the mean kinetic energy of its spheres is below this part of m g r.
constexpr double kRest = 2e-4;

/// Lets spheres fall from a loose grid with random places, radii and velocities, by the program's
/// own dynamics, until they rest (kRest). Friction is 0.1 meanwhile, for a dense bed.
/// @param progress  gets a line from time to time
/// @throws std::invalid_argument for no spheres
///         std::runtime_error if they do not come to rest
Bed make_bed(const BedOrder& order, std::ostream& progress);

/// Copies of a bed side by side, in a box copies times as wide: larger beds than one has the time
/// to settle.
/// @param copies  along x and y each
/// @throws std::invalid_argument for less than 1
Bed side_by_side(const Bed& bed, int copies);

}  // namespace plekton::benchmarks
