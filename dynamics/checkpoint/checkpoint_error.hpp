// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace plekton::dynamics {

/// A checkpoint cannot be read. The message names the file, what is wrong with it and what to do.
class CheckpointError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  CheckpointError(const std::filesystem::path& file, const std::string& problem);
};

}  // namespace plekton::dynamics
