// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/state_tree.hpp"

#include "geometry/base/bit_hash.hpp"

#include <bit>
#include <type_traits>

namespace plekton::geometry {
namespace {

template <class Number>
std::uint64_t word_of(Number number) noexcept {
  if constexpr (std::is_same_v<Number, double>)
    return std::bit_cast<std::uint64_t>(number);
  else
    return static_cast<std::uint64_t>(number);
}

}  // namespace

std::uint64_t StateTree::hash() const {
  BitHash hash;
  for (const auto& [name, array] : arrays) {
    for (const char c : name) hash.add(std::uint64_t{static_cast<unsigned char>(c)});
    hash.add(std::uint64_t{array.columns});
    hash.add(std::uint64_t{array.size()});
    std::visit(
        [&](const auto& numbers) {
          for (const auto number : numbers) hash.add(word_of(number));
        },
        array.numbers);
  }
  return hash.value();
}

}  // namespace plekton::geometry
