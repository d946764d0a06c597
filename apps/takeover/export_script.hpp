// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace plekton::apps::yade {

/// The text of apps/takeover/export_scene.py.
std::string_view export_script() noexcept;

}  // namespace plekton::apps::yade
