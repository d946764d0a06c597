// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/toml_file.hpp"

#include "apps/scenario/byte_order_mark.hpp"
#include "apps/scenario/toml_depth.hpp"
#include "geometry/base/regular_file.hpp"
#include "geometry/mesh/io/mesh_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <tuple>

namespace plekton::apps {
namespace {

/// The parser has met a text that it takes for impossible.
struct ImpossibleToml : std::exception {};
[[noreturn]] void throw_impossible_toml() {
  throw ImpossibleToml();
}

}  // namespace
}  // namespace plekton::apps

// What the parser asserts of a text does not hold for every one: version 3.3 takes the ")" of "[)"
// for a key. It is told to stop there, whereas without its assertions it may do anything.
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(holds) ((holds) ? void() : plekton::apps::throw_impossible_toml())
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

Place place_of(const toml::source_region& region, const std::string& source) {
  return {source, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

/// Marks at the beginning of UTF-16, or bytes of 0, which ASCII in UTF-16 has and no text in UTF-8.
bool is_utf16(std::string_view text) noexcept {
  return text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF") ||
         text.find('\0') != std::string_view::npos;
}

/// From a place on.
std::string_view rest_from(std::string_view text, const KeyPlace& place) noexcept {
  for (int line = 1; line < place.line; ++line) text.remove_prefix(text.find('\n') + 1);
  return text.substr(static_cast<std::size_t>(place.column - 1));
}

/// What to do about a character beyond ASCII with which a text begins.
std::string_view advice_on(std::string_view text) noexcept {
  // U+2018 to U+201F, and the two of guillemets: what word processors and web pages make of quotes.
  const bool is_typographic = text.size() > 2 && text.starts_with("\xE2\x80") &&
                              static_cast<unsigned char>(text[2]) >= 0x98 &&
                              static_cast<unsigned char>(text[2]) <= 0x9F;
  if (is_typographic || text.starts_with("\xC2\xAB") || text.starts_with("\xC2\xBB"))
    return "a typographic quote, as word processors and web pages make of plain ones; write \" or "
           "'";
  constexpr std::string_view kHardBlank = "\xC2\xA0";
  if (text.starts_with(kHardBlank)) return "a no-break space; write a plain one";
  return "a character beyond ASCII outside of quotes and comments; put a name that has one in "
         "quotes";
}

/// @throws toml::parse_error, InputError for a key that is deeper than any
toml::table parsed(std::string_view text, const std::string& source) {
  if (is_utf16(text))
    throw InputError(
        fmt::format("{}: not TOML: is text in UTF-16, or no text; save it as UTF-8", source));
  if (const auto place = key_of_more_parts(text, kDeepest))
    refuse_depth({source, place->line, place->column});
  if (const auto place = first_beyond_ascii(text))
    throw InputError(fmt::format("{}: not TOML: {}",
                                 to_string(Place{source, place->line, place->column}),
                                 advice_on(rest_from(text, *place))));
  return toml::parse(text);
}

Value converted(const toml::node& node, const std::string& source, int depth);

Table converted_table(const toml::table& table, const std::string& source, int depth) {
  Table result;
  for (const auto& [key, node] : table) {
    result.entries.push_back(
        {std::string(key.str()), place_of(key.source(), source), converted(node, source, depth)});
  }
  const auto place = [](const Entry& e) { return std::tie(e.place.line, e.place.column); };
  std::stable_sort(result.entries.begin(), result.entries.end(),
                   [&](const Entry& a, const Entry& b) { return place(a) < place(b); });
  return result;
}

Array converted_array(const toml::array& array, const std::string& source, int depth) {
  Array result;
  for (const toml::node& node : array) result.push_back(converted(node, source, depth));
  return result;
}

/// @param depth  Levels above this value. @throws InputError beyond kDeepest
Value converted(const toml::node& node, const std::string& source, int depth) {
  Value value{place_of(node.source(), source), OtherKind{"a date or time of day"}};
  if (depth > kDeepest) refuse_depth(value.place);
  if (const auto* text = node.as_string()) value.data = text->get();
  if (const auto* integer = node.as_integer()) value.data = integer->get();
  if (const auto* number = node.as_floating_point()) value.data = number->get();
  if (const auto* truth = node.as_boolean()) value.data = truth->get();
  if (const auto* array = node.as_array()) value.data = converted_array(*array, source, depth + 1);
  if (const auto* table = node.as_table()) value.data = converted_table(*table, source, depth + 1);
  return value;
}

constexpr std::size_t kLongest = std::size_t{64} << 20U;  // bytes, a thousand long scenarios

InputError too_long(std::string_view name) {
  return InputError(
      fmt::format("{}: is longer than {} MiB; expected a scenario (.toml)", name, kLongest >> 20U));
}

/// All of it, to its end. @throws InputError
std::string text_of_standard_input() {
  std::string text;
  std::array<char, 65536> block;
  while (true) {
    const ::ssize_t count = ::read(STDIN_FILENO, block.data(), block.size());
    if (count == 0) return text;
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      throw InputError(fmt::format("{}: cannot be read: {}; expected a scenario (.toml)",
                                   kStandardInputName, std::generic_category().message(errno)));
    }
    text.append(block.data(), static_cast<std::size_t>(count));
    if (text.size() > kLongest) throw too_long(kStandardInputName);
  }
}

/// Every place of a value, and of what is in it, becomes this one.
void set_place(Value& value, const Place& place) {
  value.place = place;
  if (auto* array = std::get_if<Array>(&value.data)) {
    for (Value& item : *array) set_place(item, place);
  }
  if (auto* table = std::get_if<Table>(&value.data)) {
    for (Entry& entry : table->entries) {
      entry.place = place;
      set_place(entry.value, place);
    }
  }
}

bool is_mesh(const fs::path& path) {
  try {
    geometry::mesh_format_of(path);
    return true;
  } catch (const geometry::MeshError&) {
    return false;
  }
}

}  // namespace

Table parse_toml(std::string_view text, const std::string& source) {
  try {
    return converted_table(parsed(without_byte_order_mark(text), source), source, 0);
  } catch (const toml::parse_error& error) {
    Problems problems;
    // What it says of a text whose quote is not closed before the end of its line.
    const bool may_be_open =
        error.description().find("control characters other than TAB") != std::string_view::npos;
    problems.add(place_of(error.source(), source),
                 fmt::format("not TOML: {}{}", error.description(),
                             may_be_open ? "; is the quote at the end of a text missing?" : ""));
    problems.throw_if_any();
    throw;
  } catch (const ImpossibleToml&) {
    throw InputError(
        fmt::format("{}: not TOML: brackets of a table, as in [name] or [[name]], hold no name or "
                    "another character that is in no name",
                    source));
  }
}

std::string read_toml_text(const fs::path& path) {
  if (path == kStandardInput) return std::string(without_byte_order_mark(text_of_standard_input()));
  if (is_mesh(path) && fs::is_regular_file(path))
    throw InputError(
        fmt::format("{0}: a mesh; expected a scenario (.toml), which names it as mesh = \"{0}\"; "
                    "\"plekton import {0}\" says what is in it",
                    path.string()));
  std::error_code ignored;
  if (const auto size = fs::file_size(path, ignored); !ignored && size > kLongest)
    throw too_long(path.string());
  try {
    // What is put before it in a copy would make the mark a character beyond ASCII.
    return std::string(
        without_byte_order_mark(geometry::read_regular_file(path, "a scenario (.toml)")));
  } catch (const geometry::UnreadableFile& error) {
    throw InputError(error.what());
  }
}

Value parse_toml_value(std::string_view text, const Place& place) {
  Value value{place, std::string(text)};
  if (first_beyond_ascii(text) || is_utf16(text)) return value;  // without quotes no TOML
  try {
    const toml::table table = parsed("value = " + std::string(text), place.source);
    // A line break in the text could add keys; then it is no single value.
    if (table.size() == 1) value = converted(table.begin()->second, place.source, 0);
  } catch (const toml::parse_error&) {
    // Not TOML, so it is the text itself.
  } catch (const ImpossibleToml&) {
    // Likewise.
  }
  set_place(value, place);
  return value;
}

}  // namespace plekton::apps
