// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/error_text.hpp"

#include "geometry/base/printable.hpp"

#include <fmt/format.h>

#include <iostream>
#include <new>
#include <sstream>

namespace plekton::apps {

const char* text_of(const std::exception& error) {
  const bool is_memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
  return is_memory ? "out of memory; ask for fewer grains or a coarser mesh" : error.what();
}

void print_error(const std::string& text) {
  std::istringstream lines(text);
  std::string shown;
  int problems = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(' ')) ++problems;
    shown += geometry::printable(line) + '\n';
  }
  std::cerr << "plekton: " << (problems > 1 ? fmt::format("{} problems\n", problems) : "") << shown;
}

}  // namespace plekton::apps
