// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/io/byte_order.hpp"
#include "geometry/base/types.hpp"

#include <zlib.h>

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace plekton::test {

/// One way to store the arrays of a `.vtp` file.
struct VtpStyle {
  enum class Where { text, in_place, appended_base64, appended_raw } where = Where::text;
  bool compressed = false;
  bool long_header = false;
  bool big_endian = false;
  bool single_precision = false;  ///< Float32 and Int32 instead of Float64 and Int64
};

/// What a piece of a `.vtp` file holds.
struct VtpPiece {
  std::vector<double> coordinates;
  std::vector<std::int64_t> polys, poly_offsets, strips, strip_offsets;
  std::size_t lines = 0;
};

/// Writes `.vtp` files in every style of VTK, independently of the reader and of the writer of the
/// program.
class VtpText {
 public:
  explicit VtpText(VtpStyle style) : style_(style) {}

  std::string file(const std::vector<VtpPiece>& pieces) {
    std::string xml = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\"";
    xml += style_.big_endian ? " byte_order=\"BigEndian\"" : " byte_order=\"LittleEndian\"";
    xml += style_.long_header ? " header_type=\"UInt64\"" : " header_type='UInt32'";
    xml += style_.compressed ? " compressor=\"vtkZLibDataCompressor\">\n" : ">\n";
    xml += "<PolyData>\n";
    for (const VtpPiece& piece : pieces) xml += text_of(piece);
    xml += "</PolyData>\n";
    if (!appended_.empty()) {
      const bool raw = style_.where == VtpStyle::Where::appended_raw;
      xml += std::string("<AppendedData encoding=\"") + (raw ? "raw" : "base64") + "\">\n   _" +
             appended_ + "\n</AppendedData>\n";
    }
    return xml + "</VTKFile>\n";
  }

 private:
  std::string text_of(const VtpPiece& piece) {
    std::string xml = "<Piece NumberOfPoints=\"" + std::to_string(piece.coordinates.size() / 3) +
                      "\" NumberOfVerts=\"0\" NumberOfLines=\"" + std::to_string(piece.lines) +
                      "\" NumberOfStrips=\"" + std::to_string(piece.strip_offsets.size()) +
                      "\" NumberOfPolys=\"" + std::to_string(piece.poly_offsets.size()) + "\">\n";
    xml +=
        "<!-- results come first --><PointData><DataArray type=\"Int8\" Name=\"a&gt;b\" "
        "format=\"ascii\">1</DataArray></PointData>\n";
    xml += "<Points>\n" + array<double, float>("Points", piece.coordinates) + "</Points>\n";
    xml += "<Polys>\n" + array<std::int64_t, std::int32_t>("connectivity", piece.polys) +
           array<std::int64_t, std::int32_t>("offsets", piece.poly_offsets) + "</Polys>\n";
    xml += "<Strips>\n" + array<std::int64_t, std::int32_t>("connectivity", piece.strips) +
           array<std::int64_t, std::int32_t>("offsets", piece.strip_offsets) + "</Strips>\n";
    return xml + "</Piece>\n";
  }

  template <class Long, class Short>
  std::string array(const std::string& name, const std::vector<Long>& values) {
    const std::string kind = std::is_floating_point_v<Long> ? "Float" : "Int";
    std::string tag = "<DataArray type=\"" + kind + (style_.single_precision ? "32" : "64") +
                      "\" Name=\"" + name + "\" NumberOfComponents=\"3\" format=\"";
    std::string bytes;
    for (const Long value : values) {
      if (style_.single_precision)
        append(bytes, static_cast<Short>(value));
      else
        append(bytes, value);
    }
    switch (style_.where) {
      case VtpStyle::Where::text:
        tag += "ascii\">\n";
        for (const Long value : values) tag += std::to_string(value) + ' ';
        return tag + "\n</DataArray>\n";
      case VtpStyle::Where::in_place:
        return tag + "binary\">\n  " + stored(bytes, true) + "\n</DataArray>\n";
      default:
        tag += "appended\" offset=\"" + std::to_string(appended_.size()) + "\"/>\n";
        appended_ += stored(bytes, style_.where == VtpStyle::Where::appended_base64);
        return tag;
    }
  }

  /// Length or block table, then the bytes. As VTK does it, base64 starts anew after a block table
  /// but not after a length.
  std::string stored(const std::string& bytes, bool as_base64) const {
    std::string head, body;
    if (style_.compressed) {
      constexpr std::size_t kBlock = 40;  // Several blocks, the last one partial.
      const std::size_t blocks = (bytes.size() + kBlock - 1) / kBlock;
      append_header(head, blocks);
      append_header(head, kBlock);
      append_header(head, bytes.size() % kBlock);
      for (std::size_t at = 0; at < bytes.size(); at += kBlock) {
        const std::string block = deflated(bytes.substr(at, kBlock));
        append_header(head, block.size());
        body += block;
      }
      return as_base64 ? base64(head) + base64(body) : head + body;
    }
    append_header(head, bytes.size());
    return as_base64 ? base64(head + bytes) : head + bytes;
  }

  static std::string deflated(const std::string& block) {
    uLongf size = compressBound(block.size());
    std::string packed(size, '\0');
    compress(reinterpret_cast<Bytef*>(packed.data()), &size,
             reinterpret_cast<const Bytef*>(block.data()), block.size());
    packed.resize(size);
    return packed;
  }

  static std::string base64(const std::string& bytes) {
    constexpr const char* kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
      std::uint32_t bits = 0;
      for (std::size_t k = 0; k < 3; ++k)
        bits = bits << 8 | (at + k < bytes.size() ? static_cast<unsigned char>(bytes[at + k]) : 0u);
      for (std::size_t k = 0; k < 4; ++k)
        text += at + k > bytes.size() ? '=' : kDigits[bits >> (18 - 6 * k) & 63];
    }
    return text;
  }

  void append_header(std::string& bytes, std::size_t number) const {
    if (style_.long_header)
      append(bytes, static_cast<std::uint64_t>(number));
    else
      append(bytes, static_cast<std::uint32_t>(number));
  }

  template <class Number>
  void append(std::string& bytes, Number number) const {
    std::string one;
    geometry::append_little(one, number);
    if (style_.big_endian)
      bytes.append(one.rbegin(), one.rend());
    else
      bytes += one;
  }

  VtpStyle style_;
  std::string appended_;
};

}  // namespace plekton::test
