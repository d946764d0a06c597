// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/vector_width.hpp"

#include <vector>

namespace plekton::test {

/// Kernels run with vectors of so many numbers while it lives.
class VectorWidth {
 public:
  explicit VectorWidth(int width) : before_(geometry::vector_width()) {
    geometry::set_vector_width(width);
  }
  ~VectorWidth() { geometry::set_vector_width(before_); }
  VectorWidth(const VectorWidth&) = delete;
  VectorWidth& operator=(const VectorWidth&) = delete;

 private:
  int before_;
};

/// The widths that this processor has.
inline std::vector<int> vector_widths() {
  std::vector<int> widths;
  for (int width = 2; width <= geometry::widest_vectors(); width *= 2) widths.push_back(width);
  return widths;
}

}  // namespace plekton::test
