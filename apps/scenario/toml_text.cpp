// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/toml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

namespace plekton::apps {
namespace {

std::string in_quotes(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      result += {'\\', c};
    else if (code < 0x20 || code == 0x7f)
      result += fmt::format("\\u{:04x}", code);
    else
      result += c;
  }
  return result + '"';
}

std::string key_text(const std::string& key) {
  constexpr std::string_view kBare =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  const bool is_bare = !key.empty() && key.find_first_not_of(kBare) == std::string::npos;
  return is_bare ? key : in_quotes(key);
}

/// The fewest digits that read back as the same number; a point keeps it from being a whole one.
std::string number_text(double number) {
  std::string text = fmt::format("{}", number);
  const bool is_whole = text.find_first_not_of("-0123456789") == std::string::npos;
  return is_whole ? text + ".0" : text;
}

std::string value_text(const Value& value) {
  struct Write {
    std::string operator()(const std::string& text) const { return in_quotes(text); }
    std::string operator()(std::int64_t number) const { return fmt::format("{}", number); }
    std::string operator()(double number) const { return number_text(number); }
    std::string operator()(bool truth) const { return truth ? "true" : "false"; }
    std::string operator()(const Array& array) const {
      std::string text;
      for (const Value& item : array) text += (text.empty() ? "" : ", ") + value_text(item);
      return '[' + text + ']';
    }
    std::string operator()(const Table& table) const {
      std::string text;
      for (const Entry& entry : table.entries)
        text += (text.empty() ? "" : ", ") + key_text(entry.key) + " = " + value_text(entry.value);
      return text.empty() ? "{}" : "{ " + text + " }";
    }
    // No scenario that can be used has one.
    std::string operator()(const OtherKind& other) const { return in_quotes(other.text); }
  };
  return std::visit(Write{}, value.data);
}

void write_entries(const Table& table, std::string& text) {
  for (const Entry& entry : table.entries)
    text += key_text(entry.key) + " = " + value_text(entry.value) + '\n';
}

bool is_table(const Value& value) {
  return std::holds_alternative<Table>(value.data);
}

bool is_list_of_tables(const Value& value) {
  const auto* array = std::get_if<Array>(&value.data);
  return array && !array->empty() && std::all_of(array->begin(), array->end(), is_table);
}

}  // namespace

std::string to_toml(const Table& table) {
  Table plain;
  std::copy_if(table.entries.begin(), table.entries.end(), std::back_inserter(plain.entries),
               [](const Entry& e) { return !is_table(e.value) && !is_list_of_tables(e.value); });
  std::string text;
  write_entries(plain, text);
  for (const auto& [key, place, value] : table.entries) {
    if (const auto* inner = std::get_if<Table>(&value.data)) {
      text += '[' + key_text(key) + "]\n";
      write_entries(*inner, text);
    }
    if (!is_list_of_tables(value)) continue;
    for (const Value& item : std::get<Array>(value.data)) {
      text += "[[" + key_text(key) + "]]\n";
      write_entries(std::get<Table>(item.data), text);
    }
  }
  return text;
}

}  // namespace plekton::apps
