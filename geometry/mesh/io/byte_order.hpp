// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <string>
#include <string_view>

namespace plekton::geometry {

enum class ByteOrder { little, big };

/// A number stored at a position of some bytes, which must hold all of it.
template <class Number>
Number load(std::string_view bytes, std::size_t position, ByteOrder order) noexcept {
  assert(position + sizeof(Number) <= bytes.size());
  std::array<char, sizeof(Number)> raw;
  std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(position), sizeof(Number), raw.begin());
  if ((order == ByteOrder::little) != (std::endian::native == std::endian::little))
    std::reverse(raw.begin(), raw.end());
  return std::bit_cast<Number>(raw);
}

/// Appends a number to some bytes, lowest byte first.
template <class Number>
void append_little(std::string& bytes, Number number) {
  auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  if constexpr (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

}  // namespace plekton::geometry
