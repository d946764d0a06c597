// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <algorithm>

namespace plekton::geometry {

/// By x, then y, then z: an order of points in which their numbering has no part.
inline bool lexicographically_less(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace plekton::geometry
