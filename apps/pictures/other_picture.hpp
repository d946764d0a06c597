// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace plekton::apps {

/// Refuses the name of a picture, .svg or .png, that another file has: only a PNG is replaced by
/// one, and only an SVG that gnuplot has drawn. @throws InputError
void refuse_other_picture(const std::filesystem::path& file);

}  // namespace plekton::apps
