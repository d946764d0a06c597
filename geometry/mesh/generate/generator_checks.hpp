// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"

#include <cstdint>
#include <limits>
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

/// Asked before anything is made.
/// @param nodes  About how many there will be, from numbers that would overflow an int.
/// @throws MeshError if they are more than NodeId counts.
inline void require_numbers_for(double nodes, const char* what) {
  constexpr auto kMostNodes = std::numeric_limits<std::int32_t>::max();
  if (nodes < static_cast<double>(kMostNodes)) return;
  std::ostringstream text;
  text << what << " of about " << nodes << " nodes; their numbers end at " << kMostNodes
       << "; use fewer and larger cells";
  throw MeshError(text.str());
}

}  // namespace plekton::geometry
