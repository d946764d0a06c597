// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/programs/scratch_folder.hpp"

#include "apps/scenario/problems.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace plekton::apps {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder(std::string_view purpose) {
  std::string name =
      (fs::temp_directory_path() / fmt::format("plekton-{}-XXXXXX", purpose)).string();
  if (::mkdtemp(name.data()) == nullptr)
    throw InputError(fmt::format("{}: cannot make a folder that is needed for a while: {}", name,
                                 std::generic_category().message(errno)));
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace plekton::apps
