// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/ring_search.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace plekton::contact::structure {
namespace {

/// A ring needs three pairs of cells and three terms that join them.
constexpr std::size_t kFewest = 6;

/// By insertion, linear where few have moved, as long as that is not more work than a sort is.
template <class Item, class Before>
void sort_mostly_sorted(std::vector<Item>& items, const Before& before) {
  std::size_t moves_left = 8 * items.size();
  for (std::size_t i = 1; i < items.size(); ++i) {
    const Item item = items[i];
    std::size_t place = i;
    for (; place > 0 && before(item, items[place - 1]); --place) items[place] = items[place - 1];
    items[place] = item;
    if (i - place > moves_left) return std::sort(items.begin(), items.end(), before);
    moves_left -= i - place;
  }
}

}  // namespace

bool RingSearch::find(std::span<const std::uint32_t> acting, std::span<const PairTerm> terms,
                      std::span<const Holder> holders, std::size_t pair_count, double least_life) {
  pairs_.clear();
  found_ = false;
  if (acting.size() < kFewest) return false;
  root_.resize(pair_count);
  sums_.resize(pair_count);
  is_more_.resize(pair_count);
  const auto holders_of = [&](std::uint32_t term) {
    return holders.subspan(terms[term].first_holder, terms[term].holder_count);
  };
  for (const std::uint32_t term : acting) {
    if (!terms[term].is_of_cells) continue;
    const std::uint32_t pair = holders_of(term).front().pair;
    root_[pair] = pair;
    sums_[pair] = 0;
    is_more_[pair] = 0;
    pairs_.push_back(pair);
  }
  sort(acting, terms);
  changed_.clear();
  double last = 0.0;
  for (const auto& [overlap, term] : order_) {
    if (last - overlap > least_life) check_level();
    last = overlap;
    const std::uint32_t part = unite(holders_of(term));
    sums_[part] += terms[term].weight;
    changed_.push_back(part);
  }
  check_level();
  std::erase_if(pairs_, [this](std::uint32_t pair) { return !found_ || !is_more(part_of(pair)); });
  std::sort(pairs_.begin(), pairs_.end(), [this](std::uint32_t p, std::uint32_t q) {
    return std::tuple{part_of(p), p} < std::tuple{part_of(q), q};
  });
  return !pairs_.empty();
}

/// Deepest first. From one step to the next the order hardly changes: the terms of the last one
/// come first, so that little is left to sort.
void RingSearch::sort(std::span<const std::uint32_t> acting, std::span<const PairTerm> terms) {
  is_new_.resize(terms.size());
  for (const std::uint32_t term : acting) is_new_[term] = 1;
  std::size_t kept = 0;
  for (const Level& level : order_) {
    if (level.term >= terms.size() || is_new_[level.term] == 0) continue;
    is_new_[level.term] = 0;
    order_[kept++].term = level.term;
  }
  order_.resize(kept);
  for (const std::uint32_t term : acting) {
    if (is_new_[term] == 0) continue;
    is_new_[term] = 0;
    order_.push_back({0.0, term});
  }
  for (Level& level : order_) level.overlap = terms[level.term].overlap;
  sort_mostly_sorted(order_, [](const Level& p, const Level& q) {
    return p.overlap != q.overlap ? p.overlap > q.overlap : p.term < q.term;
  });
}

/// The pairs of cells that have a term are one part from now on. @returns it
std::uint32_t RingSearch::unite(std::span<const Holder> holders) noexcept {
  std::uint32_t part = part_of(holders.front().pair);
  for (const Holder& holder : holders.subspan(1)) {
    const std::uint32_t other = part_of(holder.pair);
    if (other == part) continue;
    const auto [low, high] = std::minmax(part, other);
    // Shorter ways for the next time.
    for (std::uint32_t pair : {holders.front().pair, holder.pair}) {
      while (root_[pair] != pair) pair = std::exchange(root_[pair], low);
    }
    root_[high] = low;
    sums_[low] += sums_[high];
    is_more_[low] = is_more_[low] != 0 || is_more_[high] != 0;
    part = low;
  }
  return part;
}

void RingSearch::check_level() noexcept {
  for (const std::uint32_t pair : changed_) {
    const std::uint32_t part = part_of(pair);
    if (sums_[part] == 1) continue;
    is_more_[part] = 1;
    found_ = true;
  }
  changed_.clear();
}

}  // namespace plekton::contact::structure
