// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/query/nearest_search.hpp"

#include <optional>
#include <ostream>

namespace plekton::geometry {

/// Where a point is to a closed surface of facets without thickness.
enum class Side : std::uint8_t { outside, on, inside };

inline std::ostream& operator<<(std::ostream& out, Side side) {
  constexpr const char* kNames[] = {"outside", "on", "inside"};
  return out << kNames[static_cast<std::size_t>(side)];
}

/// The lowest edge with an odd number of facets, which keeps a surface from being closed.
std::optional<EdgeId> open_edge(const Surface& surface);

/// On which side of a surface, all of whose edges have an even number of facets, a point is: inside
/// if a ray from it crosses an odd number of facets. So facets may be turned any way, a shell
/// inside a shell encloses a hollow that is outside, and what is inside of two crossing parts is
/// outside.
///
/// Exact: a ray along an axis, moved aside by two infinitesimal amounts so that it meets no edge
/// (Edelsbrunner & Muecke, ACM Trans. Graph. 9 (1990) 66), crosses a facet by the signs of two by
/// two and three by three determinants of coordinate differences. A facet without area is crossed
/// never. Takes O(log facets + facets over and at the point).
Side side_of(const Vec3& point, const SearchedSurface& on, const Box& bounds);

}  // namespace plekton::geometry
