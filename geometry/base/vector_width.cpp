// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/vector_width.hpp"

#include <cstdlib>
#include <stdexcept>

namespace plekton::geometry {
namespace {

std::optional<std::string> asked_width() {
  const char* const text = std::getenv(kVectorWidthVariable);
  return text == nullptr ? std::nullopt : std::optional<std::string>(text);
}

int& width_in_use() {
  static int width = chosen_vector_width(asked_width(), widest_vectors());
  return width;
}

}  // namespace

int widest_vectors() noexcept {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) return 8;
  if (__builtin_cpu_supports("avx2")) return 4;
#endif
  return 2;
}

int chosen_vector_width(const std::optional<std::string>& asked, int widest) {
  if (!asked || asked->empty()) return widest;
  for (const int width : {2, 4, 8}) {
    if (*asked != std::to_string(width)) continue;
    if (width <= widest) return width;
    throw std::invalid_argument(std::string(kVectorWidthVariable) +
                                ": this processor has no vectors of " + *asked +
                                " numbers; the widest here are of " + std::to_string(widest));
  }
  throw std::invalid_argument(
      std::string(kVectorWidthVariable) + ": \"" + *asked +
      "\" is no width of vectors; give 2, 4 or 8 numbers, or unset it for the "
      "widest that the processor has");
}

int vector_width() {
  return width_in_use();
}

void set_vector_width(int width) {
  width_in_use() = chosen_vector_width(std::to_string(width), widest_vectors());
}

}  // namespace plekton::geometry
