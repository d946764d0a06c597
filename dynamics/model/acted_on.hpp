// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/model/scene.hpp"

#include <cstdint>
#include <vector>

namespace plekton::dynamics {

/// On which nodes something may act besides contacts and weight: loads, bonds, sheets, ties, rigid
/// bodies. @returns by NodeId, 1 or 0
std::vector<std::uint8_t> acted_on(const Scene& scene);

/// Which planes a servo presses, which looks in each step at what is near them. @returns by plane, 1
/// or 0
std::vector<std::uint8_t> servo_planes(const Scene& scene);

}  // namespace plekton::dynamics
