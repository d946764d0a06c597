// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/text.hpp"

#include <array>
#include <charconv>

namespace plekton::dynamics {

void append_number(std::string& text, double value) {
  std::array<char, 32> digits;  // the longest shortest form, -2.2250738585072014e-308, has 24
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  static_cast<void>(error);
  text.append(digits.data(), end);
}

std::string xml_escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      // A reader turns bare white space in an attribute into blanks.
      case '\t':
        escaped += "&#9;";
        break;
      case '\n':
        escaped += "&#10;";
        break;
      case '\r':
        escaped += "&#13;";
        break;
      default:
        escaped += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
    }
  }
  return escaped;
}

}  // namespace plekton::dynamics
