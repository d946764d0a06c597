// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

namespace plekton::apps {

/// Where a key begins in a text.
struct KeyPlace {
  int line;    ///< from 1
  int column;  ///< from 1
};

/// The first key of a TOML text that has more parts than this, as "a.b.c" has three. The parser
/// follows a key part by part with its stack, so this must be known before it reads one. Linear in
/// the text, whether that is TOML or not.
std::optional<KeyPlace> key_of_more_parts(std::string_view text, int most) noexcept;

/// The first character beyond ASCII that is in neither quotes nor a comment, where TOML has none:
/// what version 3.3 of the parser makes of one is not defined. Linear in the text.
std::optional<KeyPlace> first_beyond_ascii(std::string_view text) noexcept;

}  // namespace plekton::apps
