// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/run_origin.hpp"

#include <fmt/chrono.h>
#include <unistd.h>

#include <array>
#include <ctime>

namespace plekton::apps {

std::string date_of_now() {
  return fmt::format("{:%FT%TZ}", fmt::gmtime(std::time(nullptr)));
}

std::string name_of_host() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace plekton::apps
