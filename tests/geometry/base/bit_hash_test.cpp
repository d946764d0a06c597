// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/bit_hash.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <set>

namespace plekton::geometry::bit_hash_test {
namespace {

std::uint64_t hash_of(const Vec3& v) {
  BitHash hash;
  hash.add(v);
  return hash.value();
}

// The second number is what Python's integers of any size make of the definition.
TEST(BitHash, IsAsItsDefinitionSays) {
  BitHash hash;
  EXPECT_EQ(hash.value(), 0x243F6A8885A308D3U);

  hash.add(std::uint64_t{1});

  EXPECT_EQ(hash.value(), 0x59AB0230F0F2730AU);
}

TEST(BitHash, DiffersForEveryBitOfEveryNumber) {
  const Vec3 v(1.0, -2.5e-3, 7e8);
  std::set<std::uint64_t> hashes = {hash_of(v)};
  for (int i = 0; i < 3; ++i) {
    for (unsigned bit = 0; bit < 64; ++bit) {
      Vec3 other = v;
      other[i] =
          std::bit_cast<double>(std::bit_cast<std::uint64_t>(v[i]) ^ std::uint64_t{1} << bit);
      hashes.insert(hash_of(other));
    }
  }

  EXPECT_EQ(hashes.size(), 3U * 64U + 1U);
}

TEST(BitHash, DiffersForAnotherOrderAndForTheSignOfZero) {
  EXPECT_NE(hash_of({1.0, 2.0, 3.0}), hash_of({2.0, 1.0, 3.0}));
  EXPECT_NE(hash_of({0.0, 0.0, 0.0}), hash_of({-0.0, 0.0, 0.0}));
  EXPECT_NE(hash_of({0.0, 0.0, 0.0}), BitHash().value());
}

}  // namespace
}  // namespace plekton::geometry::bit_hash_test
