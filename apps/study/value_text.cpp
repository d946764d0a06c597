// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/study/value_text.hpp"

#include "apps/scenario/toml_file.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace plekton::apps {
namespace {

/// A basic string of TOML.
std::string basic_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (code < 0x20 || code == 0x7f) {
      result += fmt::format("\\u{:04x}", code);
    } else {
      result += c;
    }
  }
  return result + '"';
}

/// With a point or an exponent, so that it stays a number of that kind.
std::string floating(double number) {
  std::string text = fmt::format("{}", number);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

struct Write {
  std::string operator()(const std::string& text) const { return basic_string(text); }
  std::string operator()(std::int64_t number) const { return fmt::format("{}", number); }
  std::string operator()(double number) const { return floating(number); }
  std::string operator()(bool truth) const { return truth ? "true" : "false"; }
  std::string operator()(const Array& array) const {
    std::string text = "[";
    for (const Value& item : array) text += (text.size() > 1 ? ", " : "") + toml_text(item);
    return text + ']';
  }
  std::string operator()(const Table& table) const {
    std::string text = "{";
    for (const Entry& entry : table.entries)
      text += fmt::format("{} {} = {}", text.size() > 1 ? "," : "", basic_string(entry.key),
                          toml_text(entry.value));
    return text + " }";
  }
  std::string operator()(const OtherKind& other) const { return other.text; }
};

std::string with_unit(const std::string& number, const std::string& unit) {
  return unit.empty() ? number : number + ' ' + unit;
}

bool is_plain_text(const std::string& text) {
  if (text.empty()) return false;
  const Value read = parse_toml_value(text, {});
  const auto* same = std::get_if<std::string>(&read.data);
  return same != nullptr && *same == text;
}

}  // namespace

std::string toml_text(const Value& value) {
  return std::visit(Write{}, value.data);
}

std::string override_text(const Value& value) {
  const auto* text = std::get_if<std::string>(&value.data);
  return text != nullptr && is_plain_text(*text) ? *text : toml_text(value);
}

std::optional<NumberWithUnit> number_with_unit(const Value& value) {
  NumberWithUnit result;
  if (const auto* integer = std::get_if<std::int64_t>(&value.data)) {
    result.number = static_cast<double>(*integer);
  } else if (const auto* number = std::get_if<double>(&value.data)) {
    result.number = *number;
  } else if (const auto* text = std::get_if<std::string>(&value.data)) {
    const char* const end = text->data() + text->size();
    const auto [rest, error] = std::from_chars(text->data(), end, result.number);
    if (error != std::errc()) return std::nullopt;
    result.unit.assign(rest, end);
    const std::size_t first = result.unit.find_first_not_of(' ');
    result.unit.erase(0, first == std::string::npos ? result.unit.size() : first);
  } else {
    return std::nullopt;
  }
  if (!std::isfinite(result.number)) return std::nullopt;
  return result;
}

std::string text_of(const NumberWithUnit& quantity) {
  return with_unit(fmt::format("{:.9g}", quantity.number), quantity.unit);
}

std::string whole_text_of(const NumberWithUnit& quantity) {
  return with_unit(fmt::format("{:.0f}", quantity.number), quantity.unit);
}

}  // namespace plekton::apps
