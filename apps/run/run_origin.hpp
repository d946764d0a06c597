// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace plekton::apps {

/// Date and time of day in UTC, as in "2026-05-01T12:00:00Z".
std::string date_of_now();

/// Name of the machine; empty if it has none.
std::string name_of_host();

}  // namespace plekton::apps
