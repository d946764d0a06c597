// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace plekton::geometry {

/// Bytes that are stored as they are or as base64, taken one stretch after the other.
class VtkBytes {
 public:
  VtkBytes(std::string_view stored, bool base64) : stored_(stored), base64_(base64) {}

  /// The next bytes; no value if fewer are left or they are no base64. Base64 may have blanks, and
  /// padding wherever a writer ended a stretch.
  std::optional<std::string> take(std::size_t size);

 private:
  bool decode_group();

  std::string_view stored_;
  bool base64_;
  std::string decoded_;  ///< bytes of the last group that were not taken yet
};

/// What zlib made from a block.
/// @param size  Bytes that must come out. A block that claims more than zlib can pack is refused
///              before any memory is taken.
/// @returns No value if the block is damaged or gives another size.
std::optional<std::string> inflated(std::string_view block, std::size_t size);

}  // namespace plekton::geometry
