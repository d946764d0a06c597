// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/output_folder.hpp"

#include "dynamics/output/file.hpp"

#include <system_error>

namespace plekton::apps {

void make_output_folder(const std::filesystem::path& folder) {
  const std::filesystem::path parent =
      (folder.has_filename() ? folder : folder.parent_path()).parent_path();
  if (!parent.empty()) {
    std::error_code error;
    std::filesystem::create_directories(parent, error);
    if (error) throw dynamics::OutputError(parent, "create the folder", error.value());
  }
  dynamics::ensure_output_folder(folder);
}

}  // namespace plekton::apps
