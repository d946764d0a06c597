// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/config_tree.hpp"

#include <optional>
#include <string>

namespace plekton::apps {

/// A value as TOML has it, on one line: for equal values the same text. Of a date what it is
/// called.
std::string toml_text(const Value& value);

/// A value as it stands behind the = of --set: texts without quotes where they need none.
std::string override_text(const Value& value);

/// "20 deg" is 20 in deg.
struct NumberWithUnit {
  double number = 0.0;
  std::string unit;  ///< empty of a number alone
};
/// Of a number, or a text that begins with one; nothing for anything else, and what is not finite.
std::optional<NumberWithUnit> number_with_unit(const Value& value);

/// As in "22.5 deg", with nine digits.
std::string text_of(const NumberWithUnit& quantity);

/// As in "4000000000", with all digits. @param quantity  of a whole number
std::string whole_text_of(const NumberWithUnit& quantity);

}  // namespace plekton::apps
