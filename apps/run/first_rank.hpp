// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/scenario.hpp"
#include "geometry/base/ranks.hpp"

#include <filesystem>
#include <functional>

namespace plekton::apps {

/// Of several ranks all but the first compute, and neither write nor speak: whether this process
/// does.
inline bool is_first_rank(const geometry::Ranks* ranks) noexcept {
  return ranks == nullptr || ranks->rank() == 0;
}

/// Runs a scenario, and all its stages, on these ranks from here on; on one process if there are
/// none.
void share_among(geometry::Ranks* ranks, Scenario& scenario);

/// Where a rank writes: into the folder, or, if it is not the first one, nowhere.
std::filesystem::path folder_of_rank(const geometry::Ranks* ranks,
                                     const std::filesystem::path& folder);

/// Something that the first rank alone does. Nobody goes on before it is done.
/// @throws what it has thrown on the first rank, and std::runtime_error on the others
void by_first_rank(geometry::Ranks* ranks, const std::function<void()>& action);

/// The same question on all ranks, each of which may see another answer, as of a clock or a signal.
/// @returns whether any rank answers yes
bool on_any_rank(geometry::Ranks* ranks, bool answer);

/// A question that is asked after every step: ranks compare their answers every few of them.
std::function<bool()> asked_now_and_then(geometry::Ranks* ranks, std::function<bool()> question);

}  // namespace plekton::apps
