// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

namespace plekton::apps {

/// A folder or file that cannot be viewed. The message names it, what is wrong, and what to do.
struct ViewError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace plekton::apps
