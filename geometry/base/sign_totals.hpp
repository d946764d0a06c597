// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/predicates.hpp"

namespace plekton::geometry {

/// The counters of all threads of the program together, also of those that have ended, since it
/// began. May be called while others count; between loops of a thread pool it has all of theirs.
SignCounters sign_totals() noexcept;

/// Counts one more sign of the calling thread.
/// @param counter  of sign_counters()
void count_sign(std::uint64_t& counter) noexcept;

}  // namespace plekton::geometry
