// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/ranks.hpp"

#include <algorithm>
#include <numeric>

namespace plekton::geometry {

std::vector<int> Ranks::ranges_of_equal_work(std::span<const std::uint64_t> work, int count) {
  const std::uint64_t total = std::accumulate(work.begin(), work.end(), std::uint64_t{0});
  std::vector<int> owners;
  owners.reserve(work.size());
  std::uint64_t before = 0;
  for (const std::uint64_t piece : work) {
    const std::uint64_t middle = 2 * before + piece;  // in halves
    const std::uint64_t owner =
        total == 0 ? 0 : middle * static_cast<std::uint64_t>(count) / (2 * total);
    owners.push_back(std::min(static_cast<int>(owner), count - 1));
    before += piece;
  }
  return owners;
}

bool any_rank(Ranks& ranks, bool says) {
  return std::ranges::max(told_by_each(ranks, std::uint64_t{says})) != 0;
}

}  // namespace plekton::geometry
