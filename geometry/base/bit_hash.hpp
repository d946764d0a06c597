// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/types.hpp"

#include <bit>
#include <cstdint>

namespace plekton::geometry {

/// A hash of 64 bits over the bits of numbers, in the order in which they are added: the same on
/// every processor, and another one as soon as one bit differs. No defence against forgery.
///
/// From hash = 0x243F6A8885A308D3 (of pi, so that leading zeros count), for each word of 64 bits:
/// hash = (hash xor word) times 0x9E3779B97F4A7C15 modulo 2^64 (the golden ratio, odd), then hash
/// = hash xor (hash >> 32). Both are one to one, so that two sequences that differ in one word
/// never have the same hash.
class BitHash {
 public:
  void add(std::uint64_t word) noexcept {
    hash_ = (hash_ ^ word) * 0x9E3779B97F4A7C15U;
    hash_ ^= hash_ >> 32U;
  }
  /// Its 64 bits as IEEE 754 has them; 0 and -0 differ.
  void add(double number) noexcept { add(std::bit_cast<std::uint64_t>(number)); }
  void add(const Vec3& v) noexcept {
    add(v.x());
    add(v.y());
    add(v.z());
  }

  std::uint64_t value() const noexcept { return hash_; }

 private:
  std::uint64_t hash_ = 0x243F6A8885A308D3U;
};

}  // namespace plekton::geometry
