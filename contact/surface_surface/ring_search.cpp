// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/ring_search.hpp"

#include <algorithm>
#include <tuple>

namespace plekton::contact::structure {
namespace {

/// Of the overlap of the deepest term: others that differ by less are on one level. Rounding makes
/// the order of features that stand at one place, and what a hole of such a life would get back is
/// no more than that.
constexpr double kTie = 1e-12;

/// A ring needs three pairs of cells and three terms that join them.
constexpr std::size_t kFewest = 6;

}  // namespace

bool RingSearch::find(std::span<const std::uint32_t> acting, std::span<const PairTerm> terms,
                      std::span<const Holder> holders, std::size_t pair_count) {
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
  for (const std::uint32_t term : order_) {
    if (last - terms[term].overlap > kTie * terms[order_.front()].overlap) check_level();
    last = terms[term].overlap;
    const auto with = holders_of(term);
    for (const Holder& holder : with.subspan(1)) unite(with.front().pair, holder.pair);
    sums_[part_of(with.front().pair)] += terms[term].weight;
    changed_.push_back(with.front().pair);
  }
  check_level();
  std::erase_if(pairs_, [this](std::uint32_t pair) { return !found_ || !is_more(part_of(pair)); });
  std::sort(pairs_.begin(), pairs_.end(), [this](std::uint32_t p, std::uint32_t q) {
    return std::tuple{part_of(p), p} < std::tuple{part_of(q), q};
  });
  return !pairs_.empty();
}

/// Deepest first.
void RingSearch::sort(std::span<const std::uint32_t> acting, std::span<const PairTerm> terms) {
  const auto is_deeper = [&](std::uint32_t p, std::uint32_t q) {
    return terms[p].overlap != terms[q].overlap ? terms[p].overlap > terms[q].overlap : p < q;
  };
  order_.assign(acting.begin(), acting.end());
  std::sort(order_.begin(), order_.end(), is_deeper);
}

void RingSearch::unite(std::uint32_t a, std::uint32_t b) noexcept {
  const auto [low, high] = std::minmax({part_of(a), part_of(b)});
  // Shorter ways for the next time.
  for (std::uint32_t pair : {a, b}) {
    while (root_[pair] != pair) pair = std::exchange(root_[pair], low);
  }
  root_[a] = root_[b] = low;
  if (low == high) return;
  root_[high] = low;
  sums_[low] += sums_[high];
  is_more_[low] = is_more_[low] != 0 || is_more_[high] != 0;
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
