// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/io/vtk_bytes.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace plekton::geometry {
namespace {

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

bool is_xml_blank(char c) {
  return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

}  // namespace

/// Four digits of 6 bits make three bytes; a group that ends in one or two '=' makes two or one.
bool VtkBytes::decode_group() {
  std::uint32_t bits = 0;
  int digits = 0, padding = 0;
  while (digits + padding < 4) {
    if (stored_.empty()) return false;
    const char c = stored_.front();
    stored_.remove_prefix(1);
    if (is_xml_blank(c)) continue;
    if (c == '=') {
      ++padding;
      bits <<= 6;
      continue;
    }
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string_view::npos || padding > 0) return false;
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    ++digits;
  }
  if (padding > 2) return false;
  for (int byte = 0; byte < 3 - padding; ++byte)
    decoded_ += static_cast<char>(bits >> (16 - 8 * byte) & 0xff);
  return true;
}

std::optional<std::string> VtkBytes::take(std::size_t size) {
  if (!base64_) {
    if (size > stored_.size()) return std::nullopt;
    std::string bytes(stored_.substr(0, size));
    stored_.remove_prefix(size);
    return bytes;
  }
  std::string bytes;
  while (bytes.size() < size) {
    if (decoded_.empty() && !decode_group()) return std::nullopt;
    const std::size_t part = std::min(size - bytes.size(), decoded_.size());
    bytes.append(decoded_, 0, part);
    decoded_.erase(0, part);
  }
  return bytes;
}

std::optional<std::string> inflated(std::string_view block, std::size_t size) {
  // 1032 is the largest ratio that deflate reaches (zlib technical details); header and trailer
  // aside.
  constexpr std::size_t kLargestRatio = 1032;
  if (size / kLargestRatio > block.size()) return std::nullopt;
  std::string bytes(size, '\0');
  uLongf written = static_cast<uLongf>(size);
  const int outcome =
      uncompress(reinterpret_cast<Bytef*>(bytes.data()), &written,
                 reinterpret_cast<const Bytef*>(block.data()), static_cast<uLong>(block.size()));
  if (outcome != Z_OK || written != size) return std::nullopt;
  return bytes;
}

}  // namespace plekton::geometry
