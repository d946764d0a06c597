// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/scenario.hpp"

#include <string>
#include <vector>

namespace plekton::apps {

/// About laws of [[contacts]] that do less than they say between the bodies of the scenario: bonds
/// between membranes carry shear while these touch, but do not pull them together. Empty if there
/// is nothing to say.
std::vector<std::string> contact_warnings(const Scenario& scenario);

}  // namespace plekton::apps
