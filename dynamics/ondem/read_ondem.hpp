// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/ondem/ondem_scene.hpp"

#include <filesystem>
#include <stdexcept>
#include <string>

namespace plekton::dynamics {

/// A file is not what ON-DEM calls one. The message names it, where in it, what was got and what
/// was expected.
class OndemError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The scene of a VTKHDF file of any program that follows the draft. Of Plekton's additions
/// membranes, planes and the state are read, where they are there. Bodies of shapes that the draft
/// does not have yet are `other`.
/// @throws OndemError also where a number that says how something moves or is large is not finite,
///         and where a contact refers to a body that is not there
OndemScene read_ondem(const std::filesystem::path& file);

/// The same from memory. @param name  what messages call it
OndemScene parse_ondem(std::string bytes, const std::filesystem::path& name);

}  // namespace plekton::dynamics
