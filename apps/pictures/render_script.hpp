// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace plekton::apps {

/// The text of apps/pictures/render_frame.py.
std::string_view render_script() noexcept;

}  // namespace plekton::apps
