// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/geometry_check/pair_check.hpp"
#include "tests/geometry_check/tally.hpp"

#include <cstdint>
#include <functional>

namespace plekton::geometry_check {

struct CheckOptions {
  std::uint64_t queries = 1000000;
  std::uint64_t seed = 7;
  int threads = 1;
  std::function<void(double)> progress;  ///< gets the share that is done, from any thread
};

/// Four fifths of the queries go to the pairs, the same number to each row of the table; a fortieth
/// to each of the invariants, fewer trials where one takes long. The same report for any number of
/// threads.
Report check(const CheckOptions& options, const Kernel& kernel);

}  // namespace plekton::geometry_check
