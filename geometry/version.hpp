// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace plekton {

/// Version of this library by semantic versioning: "major.minor.patch". Before 1.0 a new minor
/// version may change the interface.
inline constexpr std::string_view kVersion = "0.1.0";

}  // namespace plekton
