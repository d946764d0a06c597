// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/printable.hpp"

namespace plekton::geometry {

std::string printable(std::string_view text) {
  constexpr std::string_view kContinued = "\n  ";
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if ((byte >= 0x20 && byte != 0x7f) || text.substr(i).starts_with(kContinued)) {
      result += text[i];
    } else if (byte == '\n') {
      result += "\\n";
    } else {
      result += std::string("\\x") + kDigits[byte >> 4U] + kDigits[byte & 15U];
    }
  }
  return result;
}

}  // namespace plekton::geometry
