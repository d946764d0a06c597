// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/byte_order.hpp"
#include "geometry/mesh/xml_elements.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::geometry {

/// How a VTK XML file stores its arrays.
struct VtkEncoding {
  ByteOrder byte_order = ByteOrder::little;
  std::size_t header_size = 4;  ///< bytes of a length in front of an array, 4 or 8
  std::string_view compressor;  ///< as the file names it; only vtkZLibDataCompressor can be read
  bool appended_raw = false;    ///< appended arrays are bytes; base64 otherwise
  std::string_view appended;    ///< appended arrays, which offsets count from; may be empty
};

/// The numbers of a DataArray, as doubles or as integers. Time and memory are linear in the bytes
/// they are stored in, whatever sizes these claim.
/// @throws MeshError naming the line of the array for one that is cut off, damaged, of an unknown
///         type or format, or, as integers, not of whole numbers.
std::vector<double> vtk_numbers(const XmlElement& array, const VtkEncoding& encoding,
                                const std::string& name);
std::vector<std::int64_t> vtk_integers(const XmlElement& array, const VtkEncoding& encoding,
                                       const std::string& name);

}  // namespace plekton::geometry
