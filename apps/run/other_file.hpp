// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

namespace plekton::apps {

/// Tells a kind of file by its first bytes, kHeadOfFile of them if it has so many.
using IsOfKind = bool (*)(std::string_view head);
inline constexpr std::size_t kHeadOfFile = 4096;

// What is made of a run once it is there, by default into its folder.
inline constexpr const char* kViewPage = "view.html";      ///< of plekton view
inline constexpr const char* kPlotDrawing = "plot.svg";    ///< of plekton plot
inline constexpr const char* kPlotPicture = "plot.png";    ///< likewise
inline constexpr const char* kFramePicture = "frame.png";  ///< of plekton render
inline constexpr const char* kOndemFile = "ondem.vtkhdf";  ///< of plekton export-ondem

bool is_page(std::string_view head);
bool is_plot(std::string_view head);
bool is_png(std::string_view head);
/// Of an ON-DEM file of ours: the name of the group of our additions stands in its first block.
bool is_ondem(std::string_view head);

/// Whether there is a file of a kind; what cannot be read is none.
bool is_file_of_kind(const std::filesystem::path& file, IsOfKind is_of_kind);

/// Removes these from the folder of a run that is replaced; of such names files of another kind stay.
void remove_pictures(const std::filesystem::path& folder);

/// Refuses a name that somebody's file has: only one of the kind that is to be written is replaced.
/// @param kind  as in "page of plekton view", for the message
/// @throws InputError
void refuse_other_file(const std::filesystem::path& file, std::string_view kind,
                       IsOfKind is_of_kind);

}  // namespace plekton::apps
