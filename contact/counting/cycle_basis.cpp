// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/counting/cycle_basis.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace plekton::contact {

void CycleBasis::build(std::uint32_t vertex_count, std::span<const Link> links,
                       std::span<const Filling> fillings) {
  find_closings(vertex_count, links);
  currents_.clear();
  row_.assign(closings_.size(), 0.0);
  maxima_.clear();
  for (const Filling& filling : fillings) reduce(filling);
  list_fillers();
  count_branches(vertex_count, links);
}

void CycleBasis::find_closings(std::uint32_t vertex_count, std::span<const Link> links) {
  root_.resize(vertex_count);
  std::iota(root_.begin(), root_.end(), 0U);
  const auto root_of = [this](std::uint32_t vertex) {
    while (root_[vertex] != vertex) vertex = root_[vertex] = root_[root_[vertex]];
    return vertex;
  };
  closings_.clear();
  place_.assign(links.size(), kNone);
  for (std::uint32_t i = 0; i < links.size(); ++i) {
    const auto [low, high] = std::minmax({root_of(links[i].a), root_of(links[i].b)});
    if (low != high) {
      root_[high] = low;
      continue;
    }
    place_[i] = static_cast<std::uint32_t>(closings_.size());
    closings_.push_back({i, links[i].a, kNone, 0, 0});
  }
}

/// Finds the youngest cycle that the filling, with older ones, is the first to close. (Pieces of a
/// surface in space have boundaries without torsion, so the currents stay -1, 0 and 1, or small
/// whole numbers.)
void CycleBasis::reduce(const Filling& filling) {
  std::size_t first = closings_.size();
  std::size_t end = 0;
  for (std::size_t k = 0; k < filling.count; ++k) {
    const std::uint32_t place = place_[filling.links[k]];
    if (place == kNone) continue;
    row_[place] += filling.signs[k];
    first = std::min<std::size_t>(first, place);
    end = std::max<std::size_t>(end, place + 1);
  }
  for (std::size_t last = end; last-- > first;) {
    const double current = row_[last];
    if (current == 0.0) continue;
    Closing& closing = closings_[last];
    if (closing.filled_at == kNone) {
      closing.filled_at = filling.upper;
      closing.first = static_cast<std::uint32_t>(currents_.size());
      for (auto i = static_cast<std::uint32_t>(first); i <= last; ++i) {
        if (row_[i] != 0.0) currents_.push_back({i, std::exchange(row_[i], 0.0)});
      }
      closing.count = static_cast<std::uint32_t>(currents_.size()) - closing.first;
      return;
    }
    const auto older = std::span(currents_).subspan(closing.first, closing.count);
    const double factor = current / older.back().current;
    for (const Current& entry : older) row_[entry.closing] -= factor * entry.current;
    first = std::min<std::size_t>(first, older.front().closing);
  }
  maxima_.push_back(filling.upper);
}

void CycleBasis::list_fillers() {
  fillers_.clear();
  for (const Closing& closing : closings_) {
    if (closing.filled_at != kNone && closing.filled_at != closing.upper)
      fillers_.push_back(closing.filled_at);
  }
  maxima_.insert(maxima_.end(), fillers_.begin(), fillers_.end());
  for (auto* const list : {&fillers_, &maxima_}) {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
}

void CycleBasis::count_branches(std::uint32_t vertex_count, std::span<const Link> links) {
  branches_.assign(vertex_count, 0);
  for (const Link& link : links) ++branches_[link.a];
  for (const Closing& closing : closings_)
    branches_[closing.upper] -= closing.filled_at == closing.upper;
}

std::size_t CycleBasis::hole_count(const ComplexPart& part) const noexcept {
  return static_cast<std::size_t>(
      std::count_if(closings_.begin(), closings_.end(),
                    [&](const Closing& closing) { return closing.is_open(part); }));
}

std::size_t CycleBasis::shut_count(const ComplexPart& part, std::uint32_t end) const noexcept {
  return static_cast<std::size_t>(
      std::count_if(closings_.begin(), closings_.end(),
                    [&](const Closing& closing) { return closing.is_shut(part, end); }));
}

std::size_t CycleBasis::shut_count(std::uint32_t first, std::uint32_t end) const noexcept {
  return static_cast<std::size_t>(
      std::count_if(closings_.begin(), closings_.end(), [&](const Closing& closing) {
        return closing.filled_at != closing.upper && first <= closing.filled_at &&
               closing.filled_at < end;
      }));
}

void CycleBasis::find_drops(const ComplexPart& part, std::uint32_t end, std::span<const Link> links,
                            std::span<double> drops, std::span<double> shut) {
  forest_.grow(part.vertex_count, links);
  forest_.hang(links);
  const std::size_t shut_each = shut_count(part, end);
  std::size_t hole = 0;
  for (std::size_t k = 0; k < closings_.size(); ++k) {
    if (!closings_[k].is_open(part)) continue;
    const std::span<double> row = drops.subspan(hole * links.size(), links.size());
    set_circulation(k, part);
    set_shut(part, end, shut.subspan(hole * shut_each, shut_each));
    for (std::size_t i = 0; i < row.size(); ++i)
      row[i] = place_[i] == kNone ? 0.0 : row_[place_[i]];
    std::fill_n(row_.begin() + static_cast<std::ptrdiff_t>(k), closings_.size() - k, 0.0);
    set_on_no_tree(links, row);
    ++hole;
  }
  if (hole > 1) set_apart(hole, drops, shut);
}

/// Gauss-Jordan elimination: of the links in rising order of their resistance each that is left in
/// a row without one becomes that row's own.
void CycleBasis::set_apart(std::size_t rows, std::span<double> drops,
                           std::span<double> shut) const {
  const std::size_t links = drops.size() / rows;
  const std::size_t cycles = shut.size() / rows;
  const auto closing = forest_.closing_links();
  std::size_t done = 0;
  for (std::size_t at = 0; at < closing.size() && done < rows; ++at) {
    const std::uint32_t own = closing[at];
    std::size_t row = done;
    while (row < rows && drops[row * links + own] == 0.0) ++row;
    if (row == rows) continue;
    for (const std::uint32_t link : closing)
      std::swap(drops[row * links + link], drops[done * links + link]);
    for (std::size_t k = 0; k < cycles; ++k)
      std::swap(shut[row * cycles + k], shut[done * cycles + k]);
    for (std::size_t other = 0; other < rows; ++other) {
      const double factor = drops[other * links + own] / drops[done * links + own];
      if (other == done || factor == 0.0) continue;
      for (const std::uint32_t link : closing)
        drops[other * links + link] -= factor * drops[done * links + link];
      for (std::size_t k = 0; k < cycles; ++k)
        shut[other * cycles + k] -= factor * shut[done * cycles + k];
    }
    ++done;
  }
}

/// The drops along the closing links of a part whose sum is 1 round one hole and 0 round all other
/// cycles; left in row_.
void CycleBasis::set_circulation(std::size_t open, const ComplexPart& part) {
  row_[open] = 1.0;
  for (std::size_t k = open + 1; k < closings_.size(); ++k) {
    const Closing& closing = closings_[k];
    if (closing.filled_at >= part.filling_count) continue;
    const auto entries = std::span(currents_).subspan(closing.first, closing.count);
    double sum = 0.0;
    for (const Current& entry : entries.first(entries.size() - 1))
      sum += entry.current * row_[entry.closing];
    row_[k] = -sum / entries.back().current;
  }
}

void CycleBasis::set_shut(const ComplexPart& part, std::uint32_t end,
                          std::span<double> shut) const {
  std::size_t cycle = 0;
  for (const Closing& closing : closings_) {
    if (!closing.is_shut(part, end)) continue;
    double sum = 0.0;
    for (const Current& entry : std::span(currents_).subspan(closing.first, closing.count))
      sum += entry.current * row_[entry.closing];
    shut[cycle++] = sum;
  }
}

/// Takes off the gradient of a potential, so that the drops are 0 along the links of a forest of
/// little resistance. The drops are small whole numbers, so this is exact. What is left is on links
/// that resist at least half as much as any on the way round them: a drop of 1 along a link of
/// hardly any resistance, in a cycle of others, would be so strong that all else drowned in its
/// rounding errors.
void CycleBasis::set_on_no_tree(std::span<const Link> links, std::span<double> drops) {
  potential_.assign(forest_.downwards().size(), 0.0);
  for (const std::uint32_t vertex : forest_.downwards()) {
    const SpanningForest::Parent& up = forest_.parent(vertex);
    if (up.link == SpanningForest::kNone) continue;
    const double drop = drops[up.link];
    potential_[vertex] = potential_[up.vertex] + (links[up.link].a == vertex ? drop : -drop);
  }
  for (std::size_t i = 0; i < links.size(); ++i)
    drops[i] -= potential_[links[i].a] - potential_[links[i].b];
}

}  // namespace plekton::contact
