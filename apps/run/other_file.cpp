// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/other_file.hpp"

#include "apps/scenario/problems.hpp"
#include "dynamics/output/file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <string>
#include <system_error>

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

void refuse_other_file(const fs::path& file, std::string_view kind, IsOfKind is_of_kind) {
  std::error_code ignored;
  // Also a link to nowhere is somebody's.
  if (dynamics::goes_nowhere(file) || !fs::exists(fs::symlink_status(file, ignored))) return;
  if (fs::is_regular_file(file, ignored) && is_of_kind(head_of(file))) return;
  throw InputError(fmt::format("{}: is there already and no {}; choose another name, or remove it",
                               file.string(), kind));
}

}  // namespace plekton::apps
