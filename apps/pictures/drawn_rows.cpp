// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/pictures/drawn_rows.hpp"

#include <algorithm>
#include <cmath>

namespace plekton::apps {
namespace {

/// The rows from one up to another, without the latter, that bound the curve there.
void add_bounds(const std::vector<double>& x, const std::vector<double>& y, std::size_t begin,
                std::size_t end, std::vector<std::size_t>& rows) {
  std::vector<std::size_t> finite;
  for (std::size_t row = begin; row < end; ++row)
    if (std::isfinite(x[row]) && std::isfinite(y[row])) finite.push_back(row);
  if (finite.empty()) {
    rows.push_back(begin);
    return;
  }
  for (const std::vector<double>* values : {&x, &y}) {
    const auto [low, high] = std::minmax_element(
        finite.begin(), finite.end(),
        [&](std::size_t a, std::size_t b) { return (*values)[a] < (*values)[b]; });
    rows.push_back(*low);
    rows.push_back(*high);
  }
}

}  // namespace

std::vector<std::size_t> drawn_rows(const std::vector<double>& x, const std::vector<double>& y,
                                    std::size_t most) {
  std::vector<std::size_t> rows;
  if (y.empty()) return rows;
  const std::size_t few = y.size() <= most ? 1 : (4 * y.size() + most - 1) / most;
  rows.push_back(0);
  for (std::size_t begin = 0; begin < y.size(); begin += few)
    add_bounds(x, y, begin, std::min(begin + few, y.size()), rows);
  rows.push_back(y.size() - 1);
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

}  // namespace plekton::apps
