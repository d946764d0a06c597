// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/io/byte_order.hpp"
#include "geometry/mesh/io/xml_elements.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::geometry {

/// How a VTK XML file stores its arrays.
struct VtkEncoding {
  ByteOrder byte_order = ByteOrder::little;
  std::size_t header_size = 4;   ///< bytes of a length in front of an array, 4 or 8
  std::string_view compressor;   ///< as the file names it; only vtkZLibDataCompressor can be read
  bool appended_raw = false;     ///< appended arrays are bytes; base64 otherwise
  std::string_view appended;     ///< appended arrays, which offsets count from; may be empty
  std::size_t file_size = 0;     ///< bytes
  std::size_t numbers_read = 0;  ///< of all arrays so far
};

/// Most numbers that arrays hold for each byte of their file. Packed by zlib a regular net with
/// whole coordinates has 1.4, and any other mesh fewer; a byte that zlib makes a thousand of, or an
/// array that many pieces name, would fill any memory.
inline constexpr std::size_t kNumbersPerByte = 16;

/// The numbers of a DataArray, as doubles or as integers. Time and memory are linear in the size of
/// the file, whatever sizes it claims.
/// @throws MeshError naming the line of the array for one that is cut off, damaged, of an unknown
///         type or format, or, as integers, not of whole numbers, and for one by which the file
///         would hold more than kNumbersPerByte.
std::vector<double> vtk_numbers(const XmlElement& array, const VtkEncoding& encoding,
                                const std::string& name);
std::vector<std::int64_t> vtk_integers(const XmlElement& array, const VtkEncoding& encoding,
                                       const std::string& name);

}  // namespace plekton::geometry
