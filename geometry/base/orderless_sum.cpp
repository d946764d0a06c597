// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/orderless_sum.hpp"

#include <cmath>
#include <limits>

namespace plekton::geometry {

/// A number below half of 2^(32 (k + 1)) has no part in that unit: cut from higher up, it is cut in
/// the same places.
bool OrderlessSum::make_room(double largest) noexcept {
  const int exponent = std::ilogb(largest);
  if (exponent > kLargestExponent) {
    is_finite_ = 0;
    return false;
  }
  std::int32_t top = kLowest;
  while (kBits * (top + 1) - 1 <= exponent) ++top;
  raise(top);
  return true;
}

void OrderlessSum::raise(std::int32_t top) noexcept {
  for (; top_ < top; ++top_) counts_ = {0, counts_[0], counts_[1]};
}

std::array<double, OrderlessSum::kParts> OrderlessSum::units() const noexcept {
  return {std::ldexp(1.0, kBits * top_), std::ldexp(1.0, kBits * (top_ - 1)),
          std::ldexp(1.0, kBits * (top_ - 2))};
}

double OrderlessSum::value() const noexcept {
  if (is_finite_ == 0) return std::numeric_limits<double>::quiet_NaN();
  const std::array<double, kParts> unit = units();
  double sum = 0.0;
  for (std::size_t part = kParts; part-- > 0;)
    sum += static_cast<double>(counts_[part]) * unit[part];
  return sum;
}

}  // namespace plekton::geometry
