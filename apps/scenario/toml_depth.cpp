// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/toml_depth.hpp"

#include <algorithm>

namespace plekton::apps {
namespace {

/// Goes through a text by what may be a key: words, dots and texts in quotes, with blanks between.
class KeyScanner {
 public:
  /// Looks for a key of more parts, or else for a character beyond ASCII that is in no quotes.
  KeyScanner(std::string_view text, std::optional<int> most) : text_(text), most_(most) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
  }

  std::optional<KeyPlace> find() noexcept {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (!most_ && static_cast<unsigned char>(c) >= 0x80) return here();
      if (c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (c == '"' || c == '\'') {
        begin_key();
        pass_quoted(c);
      } else {
        if (is_of_a_key(c)) begin_key();
        if (c == '.' && most_ && ++parts_ > *most_) return key_;
        if (!is_of_a_key(c) && c != ' ' && c != '\t') parts_ = 0;
        pass();
      }
    }
    return std::nullopt;
  }

 private:
  static bool is_of_a_key(char c) noexcept {
    const bool is_letter =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
    return is_letter || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
  }

  void begin_key() noexcept {
    if (parts_ > 0) return;
    parts_ = 1;
    key_ = here();
  }

  KeyPlace here() const noexcept { return {line_, static_cast<int>(at_ - line_begin_) + 1}; }

  void pass() noexcept {
    if (text_[at_++] != '\n') return;
    ++line_;
    line_begin_ = at_;
  }

  /// A text in one or three quotes; one that does not end, or not on its line, is no TOML.
  void pass_quoted(char quote) noexcept {
    const auto is_quote = [&] { return at_ < text_.size() && text_[at_] == quote; };
    int opening = 0;
    for (; opening < 3 && is_quote(); ++opening) pass();
    if (opening == 2) return;  // an empty text
    int closing = 0;
    while (at_ < text_.size() && closing < opening) {
      if (opening == 1 && text_[at_] == '\n') return;
      const bool is_escape = quote == '"' && text_[at_] == '\\' && at_ + 1 < text_.size();
      if (is_escape) pass();
      closing = !is_escape && is_quote() ? closing + 1 : 0;
      pass();
    }
    // Up to two quotes may stand before the three that end a text.
    for (int extra = 0; opening == 3 && extra < 2 && is_quote(); ++extra) pass();
  }

  std::string_view text_;
  std::optional<int> most_;
  std::size_t at_ = 0;
  int line_ = 1;
  std::size_t line_begin_ = 0;
  int parts_ = 0;  // of the key that is being passed; 0 outside
  KeyPlace key_{1, 1};
};

}  // namespace

std::optional<KeyPlace> key_of_more_parts(std::string_view text, int most) noexcept {
  return KeyScanner(text, most).find();
}

std::optional<KeyPlace> first_beyond_ascii(std::string_view text) noexcept {
  return KeyScanner(text, std::nullopt).find();
}

}  // namespace plekton::apps
