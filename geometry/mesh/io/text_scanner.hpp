// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/mesh/mesh.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace plekton::geometry {

/// A decimal number that fills a whole word, independent of the locale. "nan" and "inf" are
/// numbers; a value too large for a double is infinite, one too small is zero. No value if the word
/// is anything else.
std::optional<double> parse_number(std::string_view word) noexcept;
std::optional<std::int64_t> parse_integer(std::string_view word) noexcept;

inline constexpr std::string_view kAnotherKind = "another kind of file";

/// A word of a file as messages show it: its beginning in quotes. A file may be any that somebody
/// names, also one that is not for everybody to see, so a message shows no more of it than the word
/// at fault, and kAnotherKind instead where the file has not shown that it is a mesh.
std::string quoted(std::string_view word, bool is_mesh = true);

/// Words of a text, separated by white space, with the line each stands in. Line ends may be LF, CR
/// LF or CR.
class TextScanner {
 public:
  /// @param comment     Starts a comment that runs to the end of its line; '\0' for none.
  /// @param first_line  Line of the file in which the text starts.
  TextScanner(std::string_view text, std::string name, char comment = '\0',
              std::size_t first_line = 1);

  /// True when nothing but white space and comments is left.
  bool at_end();
  /// The next word. The texts "expected ..." of messages are built from what was expected.
  /// @throws MeshError at the end of the text.
  std::string_view word(std::string_view expected);
  double number(std::string_view expected);
  std::int64_t integer(std::string_view expected);
  /// The rest of the current line without the line end, which is passed.
  std::string_view rest_of_line();

  /// Line of the last word, as the file counts from 1.
  std::size_t line() const noexcept { return word_line_; }
  /// Position in the text after the last word or line.
  std::size_t position() const noexcept { return position_; }

  /// @throws MeshError "name: line n: expected ..., got ...".
  [[noreturn]] void fail(std::string_view expected, std::string_view got) const;

 private:
  void pass_line_end();
  void skip_blanks();

  std::string_view text_;
  std::string name_;
  char comment_;
  std::size_t position_ = 0;
  std::size_t line_;
  std::size_t word_line_;
};

}  // namespace plekton::geometry
