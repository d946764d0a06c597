// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <cstdlib>

namespace plekton::fuzz {

/// Ends the program, which the fuzzer takes for a finding, unless the condition holds.
/// @param what  What the code under test gave instead.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "got %s\n", what);
  std::abort();
}

}  // namespace plekton::fuzz
