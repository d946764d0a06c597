// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/query/nearest_search.hpp"
#include "geometry/query/ray.hpp"

#include <optional>
#include <vector>

namespace plekton::geometry {

/// Where a ray first enters one of the thick cells (hit() in ray.hpp), of equal t the lowest cell.
/// @param bounds  around all of them, with their radii
std::optional<RayHit> first_hit(const Ray& ray, const SearchedSurface& on, const Box& bounds);

/// Where it enters each of the cells that it enters at all, by t, then by cell.
std::vector<RayHit> all_hits(const Ray& ray, const SearchedSurface& on, const Box& bounds);

}  // namespace plekton::geometry
