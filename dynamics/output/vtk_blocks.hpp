// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace plekton::dynamics {

/// An array as VTK's XML formats expect it with vtkZLibDataCompressor and header_type UInt64: the
/// number of blocks, the bytes in a full block, the bytes in a last partial block (0 if there is
/// none), the compressed bytes of each block, then the blocks. An empty array has 0 blocks. Time
/// grows linearly with the bytes; zlib's level 1, because higher levels win little on results and
/// cost several times as much.
std::string compressed_blocks(std::span<const std::byte> bytes);

}  // namespace plekton::dynamics
