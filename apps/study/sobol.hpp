// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace plekton::apps {

/// Most parameters that sobol_points() knows.
inline constexpr std::size_t kMostSobolParameters = 3667;

/// The first points of Sobol's sequence in the unit cube, each coordinate in [0, 1). The first is
/// the origin, which belongs to the sequence: without it 2^m points are no net any more (A. B.
/// Owen, On dropping the first Sobol' point, 2020). More points begin with the same ones.
/// Source: S. Joe and F. Y. Kuo, SIAM J. Sci. Comput. 30 (2008) 2635-2654, direction numbers
/// new-joe-kuo-6.21201, from Boost.
/// @param parameters  1 to kMostSobolParameters
std::vector<std::vector<double>> sobol_points(std::size_t count, std::size_t parameters);

}  // namespace plekton::apps
