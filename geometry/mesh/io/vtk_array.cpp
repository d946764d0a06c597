// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/io/vtk_array.hpp"

#include "geometry/mesh/io/text_scanner.hpp"
#include "geometry/mesh/io/vtk_bytes.hpp"
#include "geometry/mesh/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace plekton::geometry {
namespace {

[[noreturn]] void fail(const XmlElement& array, const std::string& name, const std::string& what) {
  throw MeshError(name + ": line " + std::to_string(array.line) + ": the array " +
                  quoted(array.attribute("Name")) + " " + what +
                  "; the file is damaged or of another kind; save the mesh again");
}

/// The bytes of an array that is stored in place or appended.
class ArrayBytes {
 public:
  /// @param number_size  Bytes of each number of the array.
  ArrayBytes(const XmlElement& array, const VtkEncoding& encoding, const std::string& name,
             std::size_t number_size)
      : array_(array),
        encoding_(encoding),
        name_(name),
        most_bytes_(numbers_left(encoding) * number_size),
        bytes_(source()) {}

  std::string read() {
    if (encoding_.compressor.empty()) return take(checked(length()));
    if (encoding_.compressor != "vtkZLibDataCompressor")
      throw MeshError(name_ + ": the arrays are packed by " + quoted(encoding_.compressor) +
                      "; expected vtkZLibDataCompressor or none; save the mesh again with one of "
                      "them");
    return read_compressed();
  }

 private:
  static std::size_t numbers_left(const VtkEncoding& encoding) {
    const std::size_t most = kNumbersPerByte * encoding.file_size;
    return most - std::min(most, encoding.numbers_read);
  }

  /// The size of an array that is not too large. @throws MeshError
  std::size_t checked(std::size_t size) const {
    if (size <= most_bytes_) return size;
    fail(array_, name_,
         "unpacks to more numbers than a mesh of this file has (" +
             std::to_string(kNumbersPerByte) + " for each of its " +
             std::to_string(encoding_.file_size) + " bytes)");
  }

  VtkBytes source() const {
    if (array_.attribute("format") == "binary") return {array_.text, true};
    const auto offset = parse_integer(array_.attribute("offset"));
    if (!offset || *offset < 0 || static_cast<std::uint64_t>(*offset) >= encoding_.appended.size())
      fail(array_, name_, "has no offset into the appended data");
    return {encoding_.appended.substr(static_cast<std::size_t>(*offset)), !encoding_.appended_raw};
  }

  std::string take(std::size_t size) {
    auto bytes = bytes_.take(size);
    if (!bytes) fail(array_, name_, "ends before its " + std::to_string(size) + " bytes");
    return *std::move(bytes);
  }

  std::size_t length() {
    const std::string bytes = take(encoding_.header_size);
    return encoding_.header_size == 8 ? load<std::uint64_t>(bytes, 0, encoding_.byte_order)
                                      : load<std::uint32_t>(bytes, 0, encoding_.byte_order);
  }

  /// Number of blocks, size of a full block, size of a last partial one (0: it is full), then the
  /// compressed sizes, then the blocks.
  std::string read_compressed() {
    const std::size_t blocks = length();
    if (blocks == 0) return {};
    const std::size_t full = length();
    const std::size_t partial = length();
    std::vector<std::size_t> sizes;
    for (std::size_t block = 0; block < blocks; ++block) sizes.push_back(length());
    std::string all;
    for (std::size_t block = 0; block < blocks; ++block) {
      const bool is_partial = block + 1 == blocks && partial > 0;
      const std::size_t size = checked(is_partial ? partial : full);
      checked(all.size() + size);
      const auto bytes = inflated(take(sizes[block]), size);
      if (!bytes) fail(array_, name_, "has a block that zlib cannot unpack");
      all += *bytes;
    }
    return all;
  }

  const XmlElement& array_;
  const VtkEncoding& encoding_;
  const std::string& name_;
  std::size_t most_bytes_;
  VtkBytes bytes_;
};

/// A number of the file as one of ours.
template <class Value, class Stored>
Value converted(Stored number, const XmlElement& array, const std::string& name) {
  if constexpr (std::is_same_v<Value, double>) {
    return static_cast<double>(number);
  } else {
    if constexpr (std::is_floating_point_v<Stored>)
      fail(array, name, "holds fractions; expected whole numbers");
    // A number above the largest int64 becomes negative, which no corner and no offset may be.
    return static_cast<Value>(number);
  }
}

template <class Value, class Stored>
std::vector<Value> unpacked(const XmlElement& array, const VtkEncoding& encoding,
                            const std::string& name) {
  const std::string bytes = ArrayBytes(array, encoding, name, sizeof(Stored)).read();
  if (bytes.size() % sizeof(Stored) != 0) fail(array, name, "is no whole number of values");
  std::vector<Value> values;
  values.reserve(bytes.size() / sizeof(Stored));
  for (std::size_t at = 0; at < bytes.size(); at += sizeof(Stored))
    values.push_back(converted<Value>(load<Stored>(bytes, at, encoding.byte_order), array, name));
  return values;
}

template <class Value>
std::vector<Value> from_bytes(const XmlElement& array, const VtkEncoding& encoding,
                              const std::string& name) {
  const std::string_view type = array.attribute("type");
  if (type == "Float32") return unpacked<Value, float>(array, encoding, name);
  if (type == "Float64") return unpacked<Value, double>(array, encoding, name);
  if (type == "Int8") return unpacked<Value, std::int8_t>(array, encoding, name);
  if (type == "UInt8") return unpacked<Value, std::uint8_t>(array, encoding, name);
  if (type == "Int16") return unpacked<Value, std::int16_t>(array, encoding, name);
  if (type == "UInt16") return unpacked<Value, std::uint16_t>(array, encoding, name);
  if (type == "Int32") return unpacked<Value, std::int32_t>(array, encoding, name);
  if (type == "UInt32") return unpacked<Value, std::uint32_t>(array, encoding, name);
  if (type == "Int64") return unpacked<Value, std::int64_t>(array, encoding, name);
  if (type == "UInt64") return unpacked<Value, std::uint64_t>(array, encoding, name);
  fail(array, name, "has the unknown type " + quoted(type));
}

template <class Value>
std::vector<Value> from_text(const XmlElement& array, const std::string& name) {
  TextScanner text(array.text, name, '\0', array.text_line);
  std::vector<Value> values;
  while (!text.at_end()) {
    if constexpr (std::is_same_v<Value, double>)
      values.push_back(text.number("a number"));
    else
      values.push_back(text.integer("a whole number"));
  }
  return values;
}

template <class Value>
std::vector<Value> values_of(const XmlElement& array, const VtkEncoding& encoding,
                             const std::string& name) {
  const std::string_view format = array.attribute("format");
  if (format == "ascii" || format.empty()) return from_text<Value>(array, name);
  if (format == "binary" || format == "appended") return from_bytes<Value>(array, encoding, name);
  fail(array, name, "has the unknown format " + quoted(format));
}

}  // namespace

std::vector<double> vtk_numbers(const XmlElement& array, const VtkEncoding& encoding,
                                const std::string& name) {
  return values_of<double>(array, encoding, name);
}

std::vector<std::int64_t> vtk_integers(const XmlElement& array, const VtkEncoding& encoding,
                                       const std::string& name) {
  return values_of<std::int64_t>(array, encoding, name);
}

}  // namespace plekton::geometry
