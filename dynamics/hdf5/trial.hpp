// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/function_ref.hpp"

#include <optional>
#include <string>

namespace plekton::dynamics::hdf5 {

/// How a function ended in a process of its own.
struct Trial {
  bool was_killed = false;
  std::optional<std::string> error;  ///< of the exception that it threw
};

/// Tries a function in a process of its own: what it does is lost, but for the text of what it
/// throws. The readers of the HDF5 library are not made for damaged files: on some they read memory
/// that is not theirs, others they cannot close. Where no process can be made nothing is tried.
/// @param seconds  of the processor, after which it is killed
Trial try_out(geometry::FunctionRef<void()> function, unsigned seconds);

}  // namespace plekton::dynamics::hdf5
