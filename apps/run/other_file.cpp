// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/other_file.hpp"

#include "apps/scenario/problems.hpp"
#include "dynamics/output/file.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

namespace plekton::apps {
namespace {

namespace fs = std::filesystem;

std::string head_of(const fs::path& file) {
  std::string head(kHeadOfFile, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  return head;
}

}  // namespace

bool is_file_of_kind(const fs::path& file, IsOfKind is_of_kind) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) && is_of_kind(head_of(file));
}

bool is_page(std::string_view head) {
  return head.starts_with("<!DOCTYPE html>") &&
         head.find("This page contains Plekton") != std::string_view::npos;
}

bool is_plot(std::string_view head) {
  return head.starts_with("<?xml") && head.find("Produced by GNUPLOT") != std::string_view::npos;
}

bool is_png(std::string_view head) {
  return head.starts_with("\x89PNG\r\n\x1a\n");
}

bool is_ondem(std::string_view head) {
  return head.starts_with("\x89HDF\r\n\x1a\n") && head.find("Plekton") != std::string_view::npos;
}

void remove_pictures(const fs::path& folder) {
  constexpr std::array<std::pair<const char*, IsOfKind>, 5> kPictures = {{{kViewPage, is_page},
                                                                          {kPlotDrawing, is_plot},
                                                                          {kPlotPicture, is_png},
                                                                          {kFramePicture, is_png},
                                                                          {kOndemFile, is_ondem}}};
  std::error_code ignored;
  for (const auto& [name, is_of_kind] : kPictures)
    if (is_file_of_kind(folder / name, is_of_kind)) fs::remove(folder / name, ignored);
}

void refuse_other_file(const fs::path& file, std::string_view kind, IsOfKind is_of_kind) {
  std::error_code ignored;
  // Also a link to nowhere is somebody's.
  if (dynamics::goes_nowhere(file) || !fs::exists(fs::symlink_status(file, ignored))) return;
  if (is_file_of_kind(file, is_of_kind)) return;
  throw InputError(fmt::format("{}: is there already and no {}; choose another name, or remove it",
                               file.string(), kind));
}

}  // namespace plekton::apps
