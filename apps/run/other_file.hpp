// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

namespace plekton::apps {

/// Tells a kind of file by its first bytes, kHeadOfFile of them if it has so many.
using IsOfKind = bool (*)(std::string_view head);
inline constexpr std::size_t kHeadOfFile = 4096;

/// Refuses a name that somebody's file has: only one of the kind that is to be written is replaced.
/// @param kind  as in "page of plekton view", for the message
/// @throws InputError
void refuse_other_file(const std::filesystem::path& file, std::string_view kind,
                       IsOfKind is_of_kind);

}  // namespace plekton::apps
