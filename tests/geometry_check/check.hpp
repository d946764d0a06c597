// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/geometry_check/pair_check.hpp"
#include "tests/geometry_check/tally.hpp"

#include <cstdint>
#include <functional>
#include <string>

namespace plekton::geometry_check {

struct CheckOptions {
  std::uint64_t queries = 1000000;
  std::uint64_t seed = 7;
  int threads = 1;
  std::function<void(double)> progress;  ///< gets the share that is done, from any thread
  std::string only = {};                 ///< rows with this in their names; all if it is empty
  std::uint64_t trials = 0;              ///< of each of these rows, whatever queries says; 0: by it
};

/// Four fifths of the queries go to the pairs, the same number to each row of the table; a fortieth
/// to each of the invariants, fewer trials where one takes long. The same report for any number of
/// threads; of a row alone the same cases as among all.
/// @throws std::invalid_argument  if no row is asked for, with the names of all
Report check(const CheckOptions& options, const Kernel& kernel);

}  // namespace plekton::geometry_check
