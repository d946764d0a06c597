// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/scenario.hpp"
#include "apps/scenario/section.hpp"

namespace plekton::apps {

/// From the keys `scale`, `rotate` and `translate`.
Placement read_placement(Section& section);

}  // namespace plekton::apps
