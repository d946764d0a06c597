// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::geometry {

enum class PlyEncoding { ascii, little_endian, big_endian };
enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// One column of an element: a number, or a list of numbers with its length before it.
struct PlyProperty {
  std::string name;
  PlyType type;
  bool is_list;
  PlyType length_type;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding;
  std::vector<PlyElement> elements;
  std::size_t body;       ///< position of the first byte behind the header
  std::size_t body_line;  ///< its line, counted from 1
};

std::size_t size_of(PlyType type) noexcept;
constexpr bool is_integer(PlyType type) noexcept {
  return type < PlyType::float32;
}

/// @throws MeshError naming the line for anything that is not a header of PLY 1.0.
PlyHeader read_ply_header(std::string_view bytes, const std::string& name);

}  // namespace plekton::geometry
