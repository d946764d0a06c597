// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sphere_sphere/sphere_blocks.hpp"

#include "contact/tracking/rekey.hpp"
#include "geometry/neighbor/space_order.hpp"

#include <algorithm>
#include <numeric>

namespace plekton::contact {
namespace {

/// Motions and sums of the members of a usual block, a third more than the spheres that it owns,
/// fill a part of a cache of the second level (512 KiB and more), and half of its pairs stay
/// within it.
constexpr std::size_t kUsualSpheres = 640;
/// So that few threads get equal numbers of blocks.
constexpr std::size_t kBlocksAtOnce = 8;
/// To move a sphere and add up what acts on it takes about as long as this many pairs.
constexpr std::size_t kPairsPerSphere = 2;
/// Neighbours stay near each other in the order while many lists are made.
constexpr int kListsPerOrder = 16;

template <class Number>
void set_all(std::vector<Number>& list, std::size_t count, Number value) {
  make_room(list, count);
  list.assign(count, value);
}

}  // namespace

void SphereBlocks::assign(std::span<const geometry::IndexPair> pairs,
                          std::span<const SphereBody> spheres, std::span<const std::uint8_t> kinds,
                          geometry::ThreadPool& pool, Positions x) {
  order(spheres.first(spheres_in(pairs)), x);
  cut(find_cuts(pairs, {0, order_.size(), 0, pairs.size()}));
  fill_counted(pairs, spheres, kinds, {}, pool, x);
  place_ghosts([this](const auto& visit) { for_each_ghost_here(visit); });
}

void SphereBlocks::fill(std::span<const geometry::IndexPair> pairs,
                        std::span<const SphereBody> spheres, std::span<const std::uint8_t> kinds,
                        const BlockOwners& owners, geometry::ThreadPool& pool, Positions x) {
  count_pairs(pairs);
  fill_counted(pairs, spheres, kinds, owners, pool, x);
}

void SphereBlocks::fill_counted(std::span<const geometry::IndexPair> pairs,
                                std::span<const SphereBody> spheres,
                                std::span<const std::uint8_t> kinds, const BlockOwners& owners,
                                geometry::ThreadPool& pool, Positions x) {
  sort_counted(pairs, pool);
  find_touching(pairs, spheres, x, pool);
  const std::size_t count = first_places_.size() - 1;
  set_all(member_of_, order_.size(), 0U);
  set_all(slots_, pairs.size(), 0U);
  const std::size_t groups =
      2 * (kinds.empty() ? 1 : 1 + static_cast<std::size_t>(*std::ranges::max_element(kinds)));
  group_sizes_.resize(groups);
  group_ranges_.resize(groups);
  make_room(pairs_, pairs.size() + groups * kLanes * count);
  blocks_.clear();
  ranges_.clear();
  members_.clear();
  spheres_.clear();
  pairs_.clear();
  largest_member_count_ = 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (owners.has(k))
      fill_block(k, pairs, spheres, kinds);
    else
      add_no_block();
  }
  ghost_count_ = blocks_.empty() ? 0 : blocks_.back().first_ghost + blocks_.back().ghosts();
  find_other_nodes(x.size());
}

/// Whoever takes part in no pair of a new list may be in it and did in an older one: only a change
/// of their number, or age, asks for a new order.
void SphereBlocks::order(std::span<const SphereBody> spheres, Positions x) {
  nodes_.clear();
  for (const SphereBody& sphere : spheres) nodes_.push_back(sphere.node);
  if (order_.size() == spheres.size() && ++lists_in_order_ < kListsPerOrder) return;
  lists_in_order_ = 0;
  set_all(order_, spheres.size(), 0);
  std::iota(order_.begin(), order_.end(), 0);
  if (!x.empty()) geometry::order_along_curve(x, nodes_, order_);
  find_places();
}

void SphereBlocks::find_places() {
  set_all(places_, order_.size(), 0U);
  for (std::size_t place = 0; place < order_.size(); ++place)
    places_[static_cast<std::size_t>(order_[place])] = static_cast<std::uint32_t>(place);
}

void SphereBlocks::exchange_order(const geometry::StateArchive& archive) {
  archive("order", order_);
  archive("lists_in_order", lists_in_order_);
  archive.require(lists_in_order_ >= 0 && lists_in_order_ < kListsPerOrder, "lists_in_order");
  if (!archive.is_reading()) return;
  std::vector<bool> has_place(order_.size(), false);
  for (const std::int32_t sphere : order_) {
    const auto i = static_cast<std::size_t>(sphere);
    archive.require(sphere >= 0 && i < order_.size() && !has_place[i], "order");
    has_place[i] = true;
  }
  find_places();
  --lists_in_order_;  // the list that is assigned next has been counted
}

std::size_t SphereBlocks::block_count(std::size_t spheres) noexcept {
  if (spheres < 2 * kUsualSpheres) return 1;
  const std::size_t groups =
      (spheres + kUsualSpheres * kBlocksAtOnce - 1) / (kUsualSpheres * kBlocksAtOnce);
  return groups * kBlocksAtOnce;
}

/// Into blocks that take equally long. Pairs belong to their first spheres, so the first blocks
/// would have some percent more of them than the last if all had the same number of spheres.
std::span<const SphereBlocks::Cut> SphereBlocks::find_cuts(
    std::span<const geometry::IndexPair> pairs, const PartOfOrder& part) {
  count_pairs(pairs);
  const std::size_t spheres = order_.size();
  const std::uint64_t count = block_count(spheres);
  const std::uint64_t work = kPairsPerSphere * spheres + part.pairs_of_all;
  const auto pairs_before = [&](std::size_t place) {
    return part.pairs_before + first_of_place_[place];
  };
  const auto work_before = [&](std::size_t place) {
    return kPairsPerSphere * place + pairs_before(place);
  };
  cuts_.clear();
  std::uint64_t next = work == 0 ? 1 : 1 + work_before(part.begin) * count / work;
  for (std::size_t place = part.begin; place <= part.end; ++place) {
    for (; next <= count && work_before(place) * count >= next * work; ++next)
      cuts_.push_back({place, pairs_before(place)});
  }
  return cuts_;
}

void SphereBlocks::cut(std::span<const Cut> cuts) {
  first_places_.assign(1, 0);
  work_.clear();
  Cut last{0, 0};
  for (const Cut& cut : cuts) {
    first_places_.push_back(static_cast<std::uint32_t>(cut.place));
    work_.push_back(kPairsPerSphere * (cut.place - last.place) + cut.pairs - last.pairs);
    last = cut;
  }
}

/// Of each place in the order, how many pairs come before it.
void SphereBlocks::count_pairs(std::span<const geometry::IndexPair> pairs) {
  std::vector<std::uint32_t>& first = first_of_place_;
  set_all(first, order_.size() + 1, 0U);
  for (const geometry::IndexPair& pair : pairs) ++first[first_place(pair)];
  std::exclusive_scan(first.begin(), first.end(), first.begin(), 0U);
}

/// By counting, then within the few pairs of each sphere.
void SphereBlocks::sort_counted(std::span<const geometry::IndexPair> pairs,
                                geometry::ThreadPool& pool) {
  const auto places = [&](std::uint32_t i) {
    return std::minmax(places_[static_cast<std::size_t>(pairs[i].a)],
                       places_[static_cast<std::size_t>(pairs[i].b)]);
  };
  std::vector<std::uint32_t>& first = first_of_place_;
  set_all(sorted_, pairs.size(), 0U);
  for (std::uint32_t i = 0; i < pairs.size(); ++i) sorted_[first[first_place(pairs[i])]++] = i;
  // Now each entry is where the next one's pairs begin.
  std::copy_backward(first.begin(), first.end() - 1, first.end());
  first[0] = 0;
  pool.for_each_range(order_.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t place = begin; place < end; ++place)
      std::sort(
          sorted_.begin() + first[place], sorted_.begin() + first[place + 1],
          [&](std::uint32_t i, std::uint32_t j) { return places(i).second < places(j).second; });
  });
}

void SphereBlocks::find_touching(std::span<const geometry::IndexPair> pairs,
                                 std::span<const SphereBody> spheres, Positions x,
                                 geometry::ThreadPool& pool) {
  set_all<std::uint8_t>(touches_, pairs.size(), 0);
  if (x.empty()) return;
  pool.for_each_range(pairs.size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      const SphereBody& a = spheres[static_cast<std::size_t>(pairs[i].a)];
      const SphereBody& b = spheres[static_cast<std::size_t>(pairs[i].b)];
      const double range = a.radius + b.radius;
      touches_[i] = (x[index_of(b.node)] - x[index_of(a.node)]).squaredNorm() < range * range;
    }
  });
}

void SphereBlocks::add_range(std::size_t group, std::size_t pair_count) {
  const std::size_t rows = (pair_count + kLanes - 1) / kLanes;
  ranges_.push_back({static_cast<std::uint32_t>(row_count()), static_cast<std::uint32_t>(rows),
                     static_cast<std::uint32_t>(pair_count), static_cast<std::uint8_t>(group / 2),
                     group % 2 == 1});
  pairs_.resize(pairs_.size() + rows * kLanes);
}

void SphereBlocks::fill_block(std::size_t k, std::span<const geometry::IndexPair> pairs,
                              std::span<const SphereBody> spheres,
                              std::span<const std::uint8_t> kinds) {
  const std::span<const std::uint32_t> own(sorted_.begin() + first_of_place_[first_places_[k]],
                                           sorted_.begin() + first_of_place_[first_places_[k + 1]]);
  Block block{};
  block.first_member = static_cast<std::uint32_t>(members_.size());
  block.owned = first_places_[k + 1] - first_places_[k];
  if (!blocks_.empty()) block.first_ghost = blocks_.back().first_ghost + blocks_.back().ghosts();
  block.first_range = static_cast<std::uint32_t>(ranges_.size());
  std::ranges::fill(group_sizes_, 0U);
  for (const std::uint32_t i : own) ++group_sizes_[group_of(i, kinds)];
  for (std::size_t group = 0; group < group_sizes_.size(); ++group) {
    group_ranges_[group] = static_cast<std::uint32_t>(ranges_.size());
    if (group_sizes_[group] > 0) add_range(group, group_sizes_[group]);
  }
  block.range_count = static_cast<std::uint32_t>(ranges_.size()) - block.first_range;
  for (std::size_t place = first_places_[k]; place < first_places_[k + 1]; ++place)
    add_member(order_[place], spheres);
  group_filled_.assign(group_sizes_.size(), 0U);
  for (const std::uint32_t i : own) {
    const std::size_t group = group_of(i, kinds);
    const Range& range = ranges_[group_ranges_[group]];
    slots_[i] = static_cast<std::uint32_t>(range.slot(group_filled_[group]++));
    pairs_[slots_[i]] = {member(block, pairs[i].a, spheres), member(block, pairs[i].b, spheres)};
  }
  const auto none = static_cast<std::uint32_t>(members_.size() - block.first_member);
  members_.push_back({NodeId{-1}, 0.0});
  spheres_.push_back(-1);
  block.member_count = none + 1;
  for (const Range& range : ranges(block)) {
    for (std::size_t n = range.pair_count; n < range.slot_count(); ++n)
      pairs_[range.slot(n)] = {none, none};
  }
  largest_member_count_ = std::max<std::size_t>(largest_member_count_, block.member_count);
  blocks_.push_back(block);
}

/// Of a block that another rank computes.
void SphereBlocks::add_no_block() {
  Block block{};
  block.first_member = static_cast<std::uint32_t>(members_.size());
  block.member_count = 1;
  if (!blocks_.empty()) block.first_ghost = blocks_.back().first_ghost + blocks_.back().ghosts();
  block.first_range = static_cast<std::uint32_t>(ranges_.size());
  blocks_.push_back(block);
}

void SphereBlocks::add_member(std::int32_t sphere, std::span<const SphereBody> spheres) {
  const auto b = static_cast<std::size_t>(sphere);
  member_of_[b] = static_cast<std::uint32_t>(members_.size());
  members_.push_back({spheres[b].node, spheres[b].radius});
  spheres_.push_back(sphere);
}

std::uint32_t SphereBlocks::member(const Block& block, std::int32_t sphere,
                                   std::span<const SphereBody> spheres) {
  const std::uint32_t& member = member_of_[static_cast<std::size_t>(sphere)];
  const bool is_known =
      member >= block.first_member && member < spheres_.size() && spheres_[member] == sphere;
  if (!is_known) add_member(sphere, spheres);
  return member - block.first_member;
}

std::size_t SphereBlocks::block_at(std::uint32_t place) const noexcept {
  const auto after = std::upper_bound(first_places_.begin(), first_places_.end(), place);
  return static_cast<std::size_t>(after - first_places_.begin()) - 1;
}

void SphereBlocks::take_ghosts(std::span<const std::pair<GhostOf, std::uint32_t>> ghosts,
                               std::size_t of_others) {
  place_ghosts([&](const auto& visit) {
    for (const auto& [of, ghost] : ghosts) visit(of, ghost);
  });
  ghost_count_ += of_others;
}

/// By counting; ghosts of a sphere in the order of the blocks.
template <class ForEachGhost>
void SphereBlocks::place_ghosts(const ForEachGhost& for_each_ghost) {
  set_all(first_ghosts_, blocks_.size() + 1, 0U);
  std::uint32_t count = 0;
  for_each_ghost([&](const GhostOf& of, std::uint32_t) {
    ++first_ghosts_[block_of(of.sphere)];
    ++count;
  });
  std::exclusive_scan(first_ghosts_.begin(), first_ghosts_.end(), first_ghosts_.begin(), 0U);
  make_room(ghosts_, count);
  ghosts_.resize(count);
  for_each_ghost([&](const GhostOf& of, std::uint32_t ghost) {
    ghosts_[first_ghosts_[block_of(of.sphere)]++] = {node_of(of.sphere), ghost};
  });
  std::rotate(first_ghosts_.begin(), first_ghosts_.end() - 1, first_ghosts_.end());
  first_ghosts_[0] = 0;
}

/// @param node_count  or fewer, if all after those belong to spheres
void SphereBlocks::find_other_nodes(std::size_t node_count) {
  for (const NodeId node : nodes_) node_count = std::max(node_count, index_of(node) + 1);
  set_all<std::uint8_t>(is_owned_, node_count, 0);
  for (const NodeId node : nodes_) is_owned_[index_of(node)] = 1;
  other_nodes_.clear();
  for (std::size_t node = 0; node < node_count; ++node) {
    if (is_owned_[node] != 0) continue;
    if (node == 0 || is_owned_[node - 1] != 0) other_nodes_.push_back({node, node});
    other_nodes_.back().end = node + 1;
  }
}

}  // namespace plekton::contact
