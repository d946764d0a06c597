// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/vtk_blocks.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <new>
#include <vector>

namespace plekton::dynamics {
namespace {

// Large enough to make zlib's start-up (about 270 kB of tables) small, small enough for the cache.
constexpr std::size_t kBlockBytes = 256 * 1024;

/// Appends the compressed form of a block. @returns Its size (bytes).
std::uint64_t append_compressed(std::string& text, std::span<const std::byte> block) {
  const std::size_t start = text.size();
  uLongf size = compressBound(static_cast<uLong>(block.size()));
  text.resize(start + size);
  // With a buffer of compressBound() bytes zlib can fail for want of memory only.
  if (compress2(reinterpret_cast<Bytef*>(text.data() + start), &size,
                reinterpret_cast<const Bytef*>(block.data()), static_cast<uLong>(block.size()),
                Z_BEST_SPEED) != Z_OK) {
    throw std::bad_alloc();
  }
  text.resize(start + size);
  return size;
}

}  // namespace

std::string compressed_blocks(std::span<const std::byte> bytes) {
  const std::size_t block_count = (bytes.size() + kBlockBytes - 1) / kBlockBytes;
  std::vector<std::uint64_t> header = {block_count, kBlockBytes, bytes.size() % kBlockBytes};
  std::string blocks;
  for (std::size_t start = 0; start < bytes.size(); start += kBlockBytes) {
    const std::size_t size = std::min(kBlockBytes, bytes.size() - start);
    header.push_back(append_compressed(blocks, bytes.subspan(start, size)));
  }
  std::string text(reinterpret_cast<const char*>(header.data()), header.size() * sizeof(header[0]));
  return text += blocks;
}

}  // namespace plekton::dynamics
