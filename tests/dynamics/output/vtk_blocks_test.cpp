// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/vtk_blocks.hpp"

#include "tests/support/seeded_random.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace plekton::dynamics::vtk_blocks_test {
namespace {

using test::Random;
using testing::SizeIs;

std::vector<std::byte> random_bytes(Random& random, std::size_t count) {
  std::vector<std::byte> bytes(count);
  for (std::byte& byte : bytes) byte = static_cast<std::byte>(random.integer(0, 255));
  return bytes;
}

std::uint64_t word(const std::string& text, std::size_t place) {
  std::uint64_t number = 0;
  std::memcpy(&number, text.data() + 8 * place, 8);
  return number;
}

/// A block on its own: all of it is used, and it gives as many bytes as expected.
std::optional<std::vector<std::byte>> inflated(std::string block, std::size_t size) {
  std::vector<std::byte> bytes(size + 1);
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) return std::nullopt;
  stream.next_in = reinterpret_cast<Bytef*>(block.data());
  stream.avail_in = static_cast<uInt>(block.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  const int result = inflate(&stream, Z_FINISH);
  const bool is_whole = result == Z_STREAM_END && stream.avail_in == 0 && stream.total_out == size;
  inflateEnd(&stream);
  if (!is_whole) return std::nullopt;
  bytes.resize(size);
  return bytes;
}

// VTK's XML formats: number of blocks, bytes in a block, bytes in a last partial one, bytes of each
// compressed block; then the blocks.
TEST(VtkBlocks, GiveTheBytesBackBlockByBlock) {
  Random random(101);
  const std::uint64_t full = word(compressed_blocks(random_bytes(random, 1)), 1);
  for (const std::uint64_t size :
       {std::uint64_t{1}, full - 1, full, full + 1, 2 * full, 2 * full + full / 3}) {
    const std::vector<std::byte> bytes = random_bytes(random, size);

    const std::string text = compressed_blocks(bytes);

    const std::uint64_t blocks = word(text, 0), partial = word(text, 2);
    ASSERT_EQ(word(text, 1), full);
    ASSERT_LT(partial, full);
    ASSERT_EQ((blocks - (partial > 0 ? 1 : 0)) * full + partial, size);
    std::size_t at = 8 * (3 + blocks);
    std::vector<std::byte> back;
    for (std::uint64_t i = 0; i < blocks; ++i) {
      const std::uint64_t compressed = word(text, 3 + i);
      ASSERT_LE(at + compressed, text.size());
      const auto block =
          inflated(text.substr(at, compressed), i + 1 == blocks && partial > 0 ? partial : full);
      ASSERT_TRUE(block);
      back.insert(back.end(), block->begin(), block->end());
      at += compressed;
    }
    EXPECT_EQ(at, text.size());
    EXPECT_EQ(back, bytes);
  }
}

TEST(VtkBlocks, OfNothingAreNone) {
  const std::string text = compressed_blocks({});

  ASSERT_THAT(text, SizeIs(24));
  EXPECT_EQ(word(text, 0), 0U);
  EXPECT_EQ(word(text, 2), 0U);
}

/// Two equal blocks are equal bytes: none knows of the one before, and zlib's header says that they
/// were made as fast as may be (RFC 1950: 0x78, and a level of 0 in the upper two bits of the next).
TEST(VtkBlocks, AreEachMadeAloneAndFast) {
  Random random(102);
  const std::uint64_t full = word(compressed_blocks(random_bytes(random, 1)), 1);
  std::vector<std::byte> twice = random_bytes(random, full);
  for (std::byte& byte : twice) byte &= std::byte{3};  // compressible
  twice.insert(twice.end(), twice.begin(), twice.begin() + static_cast<std::ptrdiff_t>(full));

  const std::string text = compressed_blocks(twice);

  ASSERT_EQ(word(text, 0), 2U);
  const std::uint64_t size = word(text, 3);
  ASSERT_EQ(word(text, 4), size);
  EXPECT_EQ(text.substr(40, size), text.substr(40 + size));
  EXPECT_LT(size, full / 2);
  EXPECT_EQ(static_cast<unsigned char>(text[40]), 0x78U);
  EXPECT_EQ(static_cast<unsigned char>(text[41]) >> 6U, 0U);
}

}  // namespace
}  // namespace plekton::dynamics::vtk_blocks_test
