// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>

/// What web/build.mjs made, as it was when the program was compiled, in pieces. The source of these
/// is written by embed.cmake.
namespace plekton::apps {

std::span<const std::string_view> viewer_html();  ///< the page, with <!--plekton:run--> in it
std::span<const std::string_view> viewer_code();  ///< its JavaScript

}  // namespace plekton::apps
