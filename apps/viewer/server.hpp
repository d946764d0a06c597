// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

namespace plekton::apps {

/// How to serve a run.
struct ServeSettings {
  std::filesystem::path folder;
  int port = 0;           ///< 0: any that is free
  std::size_t limit = 0;  ///< bytes of all frames that are kept in memory
  std::function<bool()> is_interrupted;
  std::function<void(const std::string& address)> hear;  ///< told the address when it answers
};

/// Whether this program was compiled with the library that serving needs.
bool can_serve() noexcept;

/// Shows a run to browsers of this machine, and nobody else, until it is interrupted: new frames as
/// they come. Where they become more than the limit only every second is kept, and so on.
/// @throws ViewError if the folder is no run, the port is taken, or the program cannot serve
void serve_run(const ServeSettings& settings);

}  // namespace plekton::apps
