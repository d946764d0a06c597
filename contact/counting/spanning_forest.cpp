// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/counting/spanning_forest.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

namespace plekton::contact {

/// Rough order by the binary exponent, in linear time; 0 comes first.
void SpanningForest::sort_by_resistance(std::span<const Link> links) {
  const auto key_of = [](const Link& link) {
    const auto bits = std::bit_cast<std::uint64_t>(link.resistance);
    return link.resistance > 0.0 ? 1 + static_cast<std::uint32_t>(bits >> 52U) : 0U;
  };
  std::uint32_t least = kNone;
  std::uint32_t largest = 0;
  for (const Link& link : links) {
    least = std::min(least, key_of(link));
    largest = std::max(largest, key_of(link));
  }
  order_.resize(links.size());
  if (links.empty()) return;
  constexpr std::size_t kExponents = 2048;  // of doubles: no call needs more room than the first
  first_.reserve(kExponents + 2);
  first_.assign(largest - least + 2, 0);
  for (const Link& link : links) ++first_[key_of(link) - least + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  for (std::uint32_t i = 0; i < links.size(); ++i) order_[first_[key_of(links[i]) - least]++] = i;
}

void SpanningForest::grow(std::uint32_t vertex_count, std::span<const Link> links) {
  root_.resize(vertex_count);
  std::iota(root_.begin(), root_.end(), 0U);
  tree_links_.clear();
  closing_links_.clear();
  sort_by_resistance(links);
  const auto halved_root_of = [this](std::uint32_t vertex) {
    while (root_[vertex] != vertex) vertex = root_[vertex] = root_[root_[vertex]];
    return vertex;
  };
  for (const std::uint32_t i : order_) {
    if (links[i].a == links[i].b) continue;
    const auto [low, high] = std::minmax({halved_root_of(links[i].a), halved_root_of(links[i].b)});
    if (low == high) {
      closing_links_.push_back(i);
    } else {
      root_[high] = low;
      tree_links_.push_back(i);
    }
  }
}

void SpanningForest::hang(std::span<const Link> links) {
  const std::size_t n = root_.size();
  first_.assign(n + 2, 0);
  for (const std::uint32_t i : tree_links_) {
    ++first_[links[i].a + 2];
    ++first_[links[i].b + 2];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  at_.resize(2 * tree_links_.size());
  for (const std::uint32_t i : tree_links_) {
    at_[first_[links[i].a + 1]++] = i;
    at_[first_[links[i].b + 1]++] = i;
  }

  parent_.assign(n, Parent{kNone, kNone});
  downwards_.clear();
  for (std::uint32_t vertex = 0; vertex < n; ++vertex) {
    if (root_[vertex] == vertex) downwards_.push_back(vertex);
  }
  for (std::size_t next = 0; next < downwards_.size(); ++next) {
    const std::uint32_t vertex = downwards_[next];
    for (std::uint32_t k = first_[vertex]; k < first_[vertex + 1]; ++k) {
      const std::uint32_t link = at_[k];
      if (link == parent_[vertex].link) continue;
      const std::uint32_t lower = links[link].a == vertex ? links[link].b : links[link].a;
      parent_[lower] = {vertex, link};
      downwards_.push_back(lower);
    }
  }
}

}  // namespace plekton::contact
