// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace plekton::apps {

/// What the program was built from and with, as far as it was known when the build was configured.
struct BuildInfo {
  std::string_view revision;  ///< of the repository; "-modified" ends it where files were changed.
                              ///< Without a repository the version.
  std::string_view compiler;  ///< as in "GNU 12.2.0"
};

BuildInfo build_info() noexcept;

}  // namespace plekton::apps
