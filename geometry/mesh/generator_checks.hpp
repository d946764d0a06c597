// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"

#include <sstream>
#include <string>

/// What every generator asks of its numbers.
namespace plekton::geometry {

/// @throws MeshError unless a length (m) is positive and below kLargestCoordinate.
inline void require_length(double length, const char* what) {
  if (length > 0.0 && length < kLargestCoordinate) return;
  std::ostringstream text;
  text << what << " of " << length << " m; expected a positive length below " << kLargestCoordinate
       << " m";
  throw MeshError(text.str());
}

/// @throws MeshError if a count is below its least.
inline void require_at_least(int least, int count, const char* what) {
  if (count < least)
    throw MeshError(std::string(what) + ": " + std::to_string(count) + "; expected at least " +
                    std::to_string(least));
}

}  // namespace plekton::geometry
