// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/cycle_search.hpp"

#include <algorithm>
#include <utility>

namespace plekton::contact::structure {
namespace {

/// A cycle needs two pairs of cells that are joined twice: of a closed chain of four bars that
/// folds onto itself, so that its opposite corners meet.
constexpr std::size_t kFewest = 4;

/// By insertion, linear where few have moved, as long as that is not more work than a sort is.
template <class Item, class Before>
void sort_mostly_sorted(std::span<Item> items, const Before& before) {
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

std::span<const std::uint32_t> CycleSearch::find(const TermsInRange& terms, const TermParts& parts,
                                                 bool are_new, double least_life,
                                                 geometry::ThreadPool& pool) {
  if (are_new) put_in_parts(terms, parts);
  root_.resize(parts.pair_count());
  sums_.resize(parts.pair_count());
  are_more_.resize(parts.count());
  changed_.resize(order_.size());
  pool.for_each_shared(parts.count(), [&](std::size_t part, int) {
    const std::size_t first = parts.first(part);
    const std::span levels(order_.data() + first, parts.places(part).size());
    are_more_[part] =
        levels.size() >= kFewest && is_more(terms, levels, least_life, changed_.data() + first);
  });
  found_.clear();
  for (std::uint32_t part = 0; part < parts.count(); ++part)
    if (are_more_[part] != 0) found_.push_back(part);
  return found_;
}

/// From one step to the next the order by overlap hardly changes: the terms of the last one come
/// first, so that little is left to sort.
void CycleSearch::put_in_parts(const TermsInRange& terms, const TermParts& parts) {
  parts_of_terms_.resize(terms.all.size(), TermParts::kNone);
  next_.clear();
  for (std::size_t part = 0; part < parts.count(); ++part) {
    next_.push_back(parts.first(part));
    for (const std::uint32_t place : parts.places(part))
      parts_of_terms_[terms.acting[place]] = static_cast<std::int32_t>(part);
  }
  last_.swap(order_);
  order_.resize(terms.acting.size());
  const auto put = [&](std::uint32_t term) {
    const std::int32_t part = std::exchange(parts_of_terms_[term], TermParts::kNone);
    if (part != TermParts::kNone) order_[next_[static_cast<std::size_t>(part)]++].term = term;
  };
  for (const Level& level : last_)
    if (level.term < terms.all.size()) put(level.term);
  std::ranges::for_each(terms.acting, put);
}

/// @param levels   of one part; sorted here, deepest first
/// @param changed  room for as many
bool CycleSearch::is_more(const TermsInRange& terms, std::span<Level> levels, double least_life,
                          std::uint32_t* changed) {
  for (Level& level : levels) {
    level.overlap = terms.all[level.term].overlap;
    if (!terms.all[level.term].is_of_cells) continue;
    const std::uint32_t pair = terms.holders_of(level.term).front().pair;
    root_[pair] = pair;
    sums_[pair] = 0;
  }
  sort_mostly_sorted(levels, [](const Level& p, const Level& q) {
    return p.overlap != q.overlap ? p.overlap > q.overlap : p.term < q.term;
  });
  std::size_t count = 0;
  double last = 0.0;
  for (const auto& [overlap, term] : levels) {
    if (last - overlap > least_life) {
      if (!are_pieces({changed, count})) return true;
      count = 0;
    }
    last = overlap;
    const std::uint32_t part = unite(terms.holders_of(term));
    sums_[part] += terms.all[term].weight;
    changed[count++] = part;
  }
  return !are_pieces({changed, count});
}

/// The pairs of cells that have a term hang together from now on. @returns the lowest of all these
std::uint32_t CycleSearch::unite(std::span<const Holder> holders) noexcept {
  std::uint32_t part = part_at_level(holders.front().pair);
  for (const Holder& holder : holders.subspan(1)) {
    const std::uint32_t other = part_at_level(holder.pair);
    if (other == part) continue;
    const auto [low, high] = std::minmax(part, other);
    // Shorter ways for the next time.
    for (std::uint32_t pair : {holders.front().pair, holder.pair}) {
      while (root_[pair] != pair) pair = std::exchange(root_[pair], low);
    }
    root_[high] = low;
    sums_[low] += sums_[high];
    part = low;
  }
  return part;
}

/// At a level. @param changed  since the last one
bool CycleSearch::are_pieces(std::span<const std::uint32_t> changed) const noexcept {
  return std::ranges::all_of(
      changed, [this](std::uint32_t pair) { return sums_[part_at_level(pair)] == 1; });
}

}  // namespace plekton::contact::structure
