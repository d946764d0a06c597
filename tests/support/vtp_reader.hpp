// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::test {

/// Reads back what an appended, zlib-compressed `.vtp` file says, independently of the writer.
class VtpReader {
 public:
  explicit VtpReader(std::string bytes) : bytes_(std::move(bytes)) {
    constexpr std::string_view kAppended = "<AppendedData encoding=\"raw\">";
    const std::size_t tag = bytes_.find(kAppended);
    if (tag == std::string::npos) throw std::runtime_error("no appended data");
    const std::size_t underscore = bytes_.find('_', tag + kAppended.size());
    appended_ = std::string_view(bytes_).substr(underscore + 1);
    xml_ = std::string_view(bytes_).substr(0, tag);
  }
  VtpReader(const VtpReader&) = delete;
  VtpReader& operator=(const VtpReader&) = delete;

  /// Everything before the appended data.
  std::string_view xml() const { return xml_; }

  /// Names of the arrays in a section such as PointData or Lines, as escaped in the file.
  std::vector<std::string> names(const std::string& section) const {
    std::vector<std::string> names;
    for (const std::string& tag : tags(section)) names.push_back(attribute(tag, "Name"));
    return names;
  }

  /// Attribute of an array, such as type or NumberOfComponents.
  std::string attribute_of(const std::string& section, const std::string& name,
                           const std::string& key) const {
    return attribute(tag(section, name), key);
  }

  /// Number such as NumberOfPoints in the Piece.
  std::size_t count(const std::string& key) const {
    return std::stoul(attribute(std::string(xml_.substr(xml_.find("<Piece"))), key));
  }

  /// Values of an array; T must have the size of the file's type.
  template <class T>
  std::vector<T> values(const std::string& section, const std::string& name) const {
    const std::string raw = decompressed(std::stoul(attribute(tag(section, name), "offset")));
    if (raw.size() % sizeof(T) != 0)
      throw std::runtime_error(name + ": not a whole number of values");
    std::vector<T> values(raw.size() / sizeof(T));
    if (!raw.empty()) std::memcpy(values.data(), raw.data(), raw.size());
    return values;
  }

 private:
  static std::string attribute(const std::string& tag, const std::string& key) {
    const std::size_t start = tag.find(" " + key + "=\"");
    if (start == std::string::npos) throw std::runtime_error("no attribute " + key + " in " + tag);
    const std::size_t first = start + key.size() + 3;
    return tag.substr(first, tag.find('"', first) - first);
  }

  std::vector<std::string> tags(const std::string& section) const {
    const std::size_t begin = xml_.find("<" + section + ">");
    const std::size_t end = xml_.find("</" + section + ">");
    if (begin == std::string_view::npos || end == std::string_view::npos) {
      throw std::runtime_error("no section " + section);
    }
    std::vector<std::string> tags;
    for (std::size_t at = xml_.find("<DataArray", begin); at < end;
         at = xml_.find("<DataArray", at + 1)) {
      tags.emplace_back(xml_.substr(at, xml_.find('>', at) - at));
    }
    return tags;
  }

  std::string tag(const std::string& section, const std::string& name) const {
    for (const std::string& tag : tags(section)) {
      if (attribute(tag, "Name") == name) return tag;
    }
    throw std::runtime_error("no array " + name + " in " + section);
  }

  std::uint64_t word(std::size_t offset) const {
    std::uint64_t value = 0;
    for (std::size_t byte = 8; byte-- > 0;) {
      value = value << 8 | static_cast<unsigned char>(appended_.at(offset + byte));
    }
    return value;
  }

  std::string decompressed(std::size_t offset) const {
    const std::uint64_t blocks = word(offset);
    const std::uint64_t full = word(offset + 8);
    const std::uint64_t partial = word(offset + 16);
    std::size_t data = offset + 8 * (3 + blocks);
    std::string raw;
    for (std::uint64_t block = 0; block < blocks; ++block) {
      const std::uint64_t compressed = word(offset + 8 * (3 + block));
      uLongf size = block + 1 == blocks && partial > 0 ? partial : full;
      std::string buffer(size, '\0');
      const std::string_view source = appended_.substr(data, compressed);
      if (uncompress(reinterpret_cast<Bytef*>(buffer.data()), &size,
                     reinterpret_cast<const Bytef*>(source.data()), source.size()) != Z_OK ||
          size != buffer.size()) {
        throw std::runtime_error("block " + std::to_string(block) + " is broken");
      }
      raw += buffer;
      data += compressed;
    }
    return raw;
  }

  std::string bytes_;
  std::string_view xml_;
  std::string_view appended_;
};

}  // namespace plekton::test
