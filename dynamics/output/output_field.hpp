// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace plekton::dynamics {

/// A column or array of a file, as it is written and as it is listed.
struct OutputField {
  std::string_view name;
  std::string_view unit;  ///< empty of a number without one
  std::string_view what;
};

}  // namespace plekton::dynamics
