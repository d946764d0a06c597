// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace plekton::dynamics {

/// Appends the shortest decimal text that reads back as the same number, independent of the locale;
/// "nan", "inf",
/// "-inf" otherwise.
void append_number(std::string& text, double value);

/// A text as the value of an XML attribute in double quotes. Control characters that XML 1.0 cannot
/// express become '?'.
/// @param text  UTF-8.
std::string xml_escaped(std::string_view text);

}  // namespace plekton::dynamics
