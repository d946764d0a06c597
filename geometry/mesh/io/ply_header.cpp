// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/io/ply_header.hpp"

#include "geometry/mesh/io/text_scanner.hpp"

#include <array>
#include <optional>
#include <utility>

namespace plekton::geometry {
namespace {

using Words = std::vector<std::string_view>;

Words split(std::string_view line) {
  Words words;
  constexpr const char* kBlanks = " \t\v\f";
  for (std::size_t end = 0;;) {
    const std::size_t begin = line.find_first_not_of(kBlanks, end);
    if (begin == std::string_view::npos) return words;
    end = std::min(line.find_first_of(kBlanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
  }
}

std::optional<PlyType> type_named(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes = {{
      {"char", PlyType::int8},
      {"int8", PlyType::int8},
      {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},
      {"short", PlyType::int16},
      {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},
      {"uint16", PlyType::uint16},
      {"int", PlyType::int32},
      {"int32", PlyType::int32},
      {"uint", PlyType::uint32},
      {"uint32", PlyType::uint32},
      {"float", PlyType::float32},
      {"float32", PlyType::float32},
      {"double", PlyType::float64},
      {"float64", PlyType::float64},
  }};
  for (const auto& [name, type] : kTypes)
    if (name == word) return type;
  return std::nullopt;
}

std::optional<PlyEncoding> encoding_of(const Words& words) {
  if (words.size() != 3 || words[2] != "1.0") return std::nullopt;
  if (words[1] == "ascii") return PlyEncoding::ascii;
  if (words[1] == "binary_little_endian") return PlyEncoding::little_endian;
  if (words[1] == "binary_big_endian") return PlyEncoding::big_endian;
  return std::nullopt;
}

std::optional<PlyElement> element_of(const Words& words) {
  if (words.size() != 3) return std::nullopt;
  const auto count = parse_integer(words[2]);
  if (!count || *count < 0) return std::nullopt;
  return PlyElement{std::string(words[1]), static_cast<std::uint64_t>(*count), {}};
}

std::optional<PlyProperty> property_of(const Words& words) {
  if (words.size() == 3) {
    const auto type = type_named(words[1]);
    if (!type) return std::nullopt;
    return PlyProperty{std::string(words[2]), *type, false, PlyType::uint8};
  }
  if (words.size() == 5 && words[1] == "list") {
    const auto length = type_named(words[2]);
    const auto type = type_named(words[3]);
    if (!length || !type || !is_integer(*length)) return std::nullopt;
    return PlyProperty{std::string(words[4]), *type, true, *length};
  }
  return std::nullopt;
}

template <class Value>
Value required(std::optional<Value> value, const TextScanner& text, const char* expected,
               std::string_view line) {
  if (!value) text.fail(expected, quoted(line));
  return *std::move(value);
}

}  // namespace

std::size_t size_of(PlyType type) noexcept {
  constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

PlyHeader read_ply_header(std::string_view bytes, const std::string& name) {
  constexpr const char* kLine = "a header line (format, element, property, comment, end_header)";
  TextScanner text(bytes, name);
  if (text.rest_of_line() != "ply") text.fail("the word ply alone on the first line", kAnotherKind);

  PlyHeader header{};
  std::optional<PlyEncoding> encoding;
  for (;;) {
    if (text.position() == bytes.size()) text.fail(kLine, "the end of the file");
    const std::string_view line = text.rest_of_line();
    const Words words = split(line);
    const std::string_view keyword = words.empty() ? "comment" : words.front();
    if (keyword == "end_header") break;
    if (keyword == "format") {
      encoding = required(encoding_of(words), text,
                          "format ascii, binary_little_endian or binary_big_endian 1.0", line);
    } else if (keyword == "element") {
      header.elements.push_back(required(element_of(words), text, "element NAME COUNT", line));
    } else if (keyword == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(
          required(property_of(words), text, "property [list TYPE] TYPE NAME", line));
    } else if (keyword != "comment" && keyword != "obj_info") {
      text.fail(kLine, quoted(keyword));
    }
  }
  header.encoding = required(encoding, text, "a format line before end_header", "none");
  header.body = text.position();
  header.body_line = text.line() + 1;
  return header;
}

}  // namespace plekton::geometry
