// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/ranks.hpp"
#include "geometry/neighbor/broad_phase.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <queue>
#include <span>
#include <vector>

namespace plekton::contact {

/// A pair of spheres, and what the rank that has it tells of it.
template <class Told>
struct ToldPair {
  geometry::IndexPair pair;
  Told told;
};

/// Calls visit(ToldPair, rank) for things of several ranks in the order of their pairs.
/// @param of_ranks  those of a rank are in order
template <class Told, class Visit>
void visit_in_order(const geometry::ThingsOfRanks<ToldPair<Told>>& of_ranks, const Visit& visit) {
  struct Cursor {
    const ToldPair<Told>* next;
    const ToldPair<Told>* end;
    int rank;
  };
  const auto is_later = [](const Cursor& a, const Cursor& b) {
    return a.next->pair > b.next->pair;
  };
  std::priority_queue<Cursor, std::vector<Cursor>, decltype(is_later)> ahead(is_later);
  const ToldPair<Told>* begin = of_ranks.things.data();
  for (std::size_t rank = 0; rank < of_ranks.counts.size(); ++rank) {
    const ToldPair<Told>* const end = begin + of_ranks.counts[rank];
    if (begin != end) ahead.push({begin, end, static_cast<int>(rank)});
    begin = end;
  }
  while (!ahead.empty()) {
    Cursor first = ahead.top();
    ahead.pop();
    do {
      visit(*first.next++, first.rank);
    } while (first.next != first.end && (ahead.empty() || !is_later(first, ahead.top())));
    if (first.next != first.end) ahead.push(first);
  }
}

/// Ranks tell each other of the pairs that each has, so that all go through all of them in order;
/// those of some spheres at a time, as a message is not to be as large as the scene.
/// @param spheres  how many there are
/// @param tell     (end, told): appends what this rank has of pairs whose first sphere is before
///                 end, and was not in the call before
/// @param visit    (ToldPair, rank)
template <class Told, class Tell, class Visit>
void for_each_of_ranks(geometry::Ranks& ranks, std::size_t spheres, const Tell& tell,
                       const Visit& visit) {
  constexpr std::size_t kPairsPerSphere = 8;  // that touch or are near, in a dense bed
  constexpr std::size_t kAtATime = std::max<std::size_t>(
      1, geometry::Ranks::kUsualRoom / (kPairsPerSphere * sizeof(ToldPair<Told>)));
  std::vector<ToldPair<Told>> own;
  for (std::size_t begin = 0; begin < spheres; begin += kAtATime) {
    own.clear();
    tell(begin + kAtATime, own);
    visit_in_order(geometry::told_to_all(ranks, std::span<const ToldPair<Told>>(own)), visit);
  }
}

}  // namespace plekton::contact
