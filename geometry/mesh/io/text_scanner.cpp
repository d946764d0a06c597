// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/io/text_scanner.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <utility>

namespace plekton::geometry {
namespace {

constexpr std::string_view kBlanks = " \t\v\f\r\n";

bool is_blank(char c) {
  return kBlanks.find(c) != std::string_view::npos;
}

/// Of a number without sign that is not 0: what it is multiplied by, as a power of ten.
std::int64_t exponent_of(std::string_view digits) {
  const std::size_t e = digits.find_first_of("eE");
  if (e == std::string_view::npos) return 0;
  std::string_view text = digits.substr(e + 1);
  if (text.starts_with('+')) text.remove_prefix(1);
  std::int64_t exponent = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), exponent);
  constexpr std::int64_t kMost = std::int64_t{1} << 62;  // of more digits than there is memory for
  if (error == std::errc::result_out_of_range) return text.starts_with('-') ? -kMost : kMost;
  return std::clamp(exponent, -kMost, kMost);
}

/// The power of ten of the first digit of a number without sign that is not 0.
std::int64_t magnitude_of(std::string_view digits) {
  const std::string_view mantissa = digits.substr(0, digits.find_first_of("eE"));
  const auto point = static_cast<std::int64_t>(std::min(mantissa.find('.'), mantissa.size()));
  const auto first = static_cast<std::int64_t>(mantissa.find_first_of("123456789"));
  return exponent_of(digits) + point - first - (first < point ? 1 : 0);
}

// from_chars leaves the value alone when it does not fit; tell too large from too small.
double out_of_range_value(std::string_view digits, bool negative) {
  if (magnitude_of(digits) < 0) return 0.0;
  const double infinity = std::numeric_limits<double>::infinity();
  return negative ? -infinity : infinity;
}

}  // namespace

std::string quoted(std::string_view word, bool is_mesh) {
  if (!is_mesh) return std::string(kAnotherKind);
  constexpr std::size_t kLongestQuote = 20;  // more than any keyword of the formats
  const std::string text = "'" + std::string(word.substr(0, kLongestQuote));
  return text + (word.size() > kLongestQuote ? "...'" : "'");
}

std::optional<double> parse_number(std::string_view word) noexcept {
  const bool negative = word.starts_with('-');
  if (negative || word.starts_with('+')) word.remove_prefix(1);
  if (word.empty() || word.front() == '-' || word.front() == '+') return std::nullopt;

  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) return out_of_range_value(word, negative);
  if (error != std::errc()) return std::nullopt;
  return negative ? -value : value;
}

std::optional<std::int64_t> parse_integer(std::string_view word) noexcept {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

TextScanner::TextScanner(std::string_view text, std::string name, char comment,
                         std::size_t first_line)
    : text_(text),
      name_(std::move(name)),
      comment_(comment),
      line_(first_line),
      word_line_(first_line) {}

void TextScanner::pass_line_end() {
  if (position_ < text_.size() && text_[position_] == '\r') ++position_;
  if (position_ < text_.size() && text_[position_] == '\n') ++position_;
  ++line_;
}

void TextScanner::skip_blanks() {
  while (position_ < text_.size()) {
    const char c = text_[position_];
    if (c == '\n' || c == '\r') {
      pass_line_end();
    } else if (is_blank(c)) {
      ++position_;
    } else if (comment_ != '\0' && c == comment_) {
      rest_of_line();
    } else {
      return;
    }
  }
}

bool TextScanner::at_end() {
  skip_blanks();
  return position_ == text_.size();
}

std::string_view TextScanner::word(std::string_view expected) {
  if (at_end()) {
    word_line_ = line_;
    fail(expected, "the end of the file");
  }
  word_line_ = line_;
  const std::size_t begin = position_;
  while (position_ < text_.size() && !is_blank(text_[position_])) ++position_;
  return text_.substr(begin, position_ - begin);
}

double TextScanner::number(std::string_view expected) {
  const std::string_view text = word(expected);
  const auto value = parse_number(text);
  if (!value) fail(expected, quoted(text));
  return *value;
}

std::int64_t TextScanner::integer(std::string_view expected) {
  const std::string_view text = word(expected);
  const auto value = parse_integer(text);
  if (!value) fail(expected, quoted(text));
  return *value;
}

std::string_view TextScanner::rest_of_line() {
  word_line_ = line_;
  const std::size_t begin = position_;
  const std::size_t end = std::min(text_.find_first_of("\r\n", begin), text_.size());
  position_ = end;
  if (position_ < text_.size()) pass_line_end();
  return text_.substr(begin, end - begin);
}

void TextScanner::fail(std::string_view expected, std::string_view got) const {
  throw MeshError(name_ + ": line " + std::to_string(word_line_) + ": expected " +
                  std::string(expected) + ", got " + std::string(got) +
                  "; correct the line or export the mesh again");
}

}  // namespace plekton::geometry
