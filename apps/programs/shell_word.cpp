// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/programs/shell_word.hpp"

#include <string_view>

namespace plekton::apps {

std::string shell_word(const std::string& path) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=+,:@%";
  const std::string text = path.starts_with('-') ? "./" + path : path;
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + '\'';
}

}  // namespace plekton::apps
