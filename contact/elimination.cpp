// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/elimination.hpp"

#include <algorithm>
#include <functional>
#include <iterator>

namespace plekton::contact {

void Elimination::plan(std::uint32_t vertex_count, std::span<const Link> links) {
  if (neighbours_.size() < vertex_count) neighbours_.resize(vertex_count);
  for (std::uint32_t vertex = 0; vertex < vertex_count; ++vertex) neighbours_[vertex].clear();
  for (const Link& link : links) {
    neighbours_[link.a].push_back(link.b);
    neighbours_[link.b].push_back(link.a);
  }
  for (std::uint32_t vertex = 0; vertex < vertex_count; ++vertex) {
    auto& list = neighbours_[vertex];
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  order_vertices(vertex_count);
  place_links(links);
}

void Elimination::order_vertices(std::uint32_t vertex_count) {
  constexpr std::uint32_t kLeft = 0xffffffffU;
  row_of_.assign(vertex_count, kLeft);
  rows_.clear();
  columns_.clear();
  queue_.clear();
  const auto push = [&](std::uint32_t vertex) {
    queue_.emplace_back(static_cast<std::uint32_t>(neighbours_[vertex].size()), vertex);
    std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
  };
  for (std::uint32_t vertex = 0; vertex < vertex_count; ++vertex) push(vertex);
  while (!queue_.empty()) {
    std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
    const auto [count, vertex] = queue_.back();
    queue_.pop_back();
    const auto& list = neighbours_[vertex];
    if (row_of_[vertex] != kLeft || count != list.size()) continue;  // an older entry
    row_of_[vertex] = static_cast<std::uint32_t>(rows_.size());
    rows_.push_back({vertex, static_cast<std::uint32_t>(columns_.size()), count});
    columns_.insert(columns_.end(), list.begin(), list.end());
    join_neighbours(vertex);
    for (const std::uint32_t other : list) push(other);
  }
  for (const Row& row : rows_) {
    const auto columns = std::span(columns_).subspan(row.first, row.count);
    for (std::uint32_t& column : columns) column = row_of_[column];
    std::sort(columns.begin(), columns.end());
  }
}

void Elimination::join_neighbours(std::uint32_t vertex) {
  const auto& list = neighbours_[vertex];
  for (const std::uint32_t other : list) {
    auto& others = neighbours_[other];
    joined_.clear();
    std::set_union(others.begin(), others.end(), list.begin(), list.end(),
                   std::back_inserter(joined_));
    std::erase_if(joined_, [&](std::uint32_t i) { return i == vertex || i == other; });
    others.assign(joined_.begin(), joined_.end());
  }
}

void Elimination::place_links(std::span<const Link> links) {
  places_.clear();
  for (const Link& link : links) {
    const auto [earlier, later] = std::minmax({row_of_[link.a], row_of_[link.b]});
    const Row& row = rows_[earlier];
    const auto columns = std::span(columns_).subspan(row.first, row.count);
    const auto found = std::lower_bound(columns.begin(), columns.end(), later);
    places_.push_back({row.first + static_cast<std::uint32_t>(found - columns.begin()),
                       row_of_[link.a] == earlier ? 1.0 : -1.0});
  }
}

void Elimination::eliminate(std::uint32_t vertex_count, std::span<const double> conductances) {
  room_.assign(columns_.size(), 0.0);
  eliminated_.clear();
  couplings_.clear();
  joins_.clear();
  for (std::size_t i = 0; i < conductances.size(); ++i) join(places_[i].at, conductances[i]);
  for (const Row& row : rows_) {
    if (row.vertex >= vertex_count) continue;
    const auto first = static_cast<std::uint32_t>(couplings_.size());
    double pivot = 0.0;
    for (std::uint32_t at = row.first; at < row.first + row.count; ++at) {
      if (room_[at] > 0.0) couplings_.push_back({at, room_[at]});
      pivot += room_[at];
    }
    for (Coupling& coupling : std::span(couplings_).subspan(first)) coupling.share /= pivot;
    eliminated_.push_back({first, static_cast<std::uint32_t>(couplings_.size()), joins_.size()});
    make_mesh(std::span(couplings_).subspan(first), pivot);
  }
}

void Elimination::join(std::uint32_t at, double conductance) {
  const double old = room_[at];
  if (!(old > 0.0)) {  // also where what comes there is 0 by underflow
    room_[at] = conductance;
    joins_.push_back({at, 0.0, 1.0, 0.0});
    return;
  }
  room_[at] += conductance;
  const double new_share = conductance / room_[at];
  joins_.push_back({at, old / room_[at], new_share, old * new_share});
}

void Elimination::make_mesh(std::span<const Coupling> star, double pivot) {
  for (std::size_t i = 0; i + 1 < star.size(); ++i) {
    std::uint32_t at = rows_[columns_[star[i].at]].first;
    for (std::size_t k = i + 1; k < star.size(); ++k) {
      while (columns_[at] != columns_[star[k].at]) ++at;
      join(at, star[i].share * star[k].share * pivot);
    }
  }
}

/// Puts the drop of a link beside that of its place.
void Elimination::put(const Join& join, double drop, double& difference) noexcept {
  difference = join.old_share > 0.0 ? drop - room_[join.at] : 0.0;
  room_[join.at] = join.old_share > 0.0 ? room_[join.at] + join.new_share * difference : drop;
}

/// Takes the last link off its place again. @returns what is left of its drop; what is left of the
/// others' stays
double Elimination::take(const Join& join, double difference) noexcept {
  const double left = room_[join.at] + join.old_share * difference;
  room_[join.at] -= join.new_share * difference;
  return left;
}

void Elimination::relax(std::span<double> drops, std::span<double> differences) {
  for (std::size_t i = 0; i < drops.size(); ++i)
    put(joins_[i], places_[i].sign * drops[i], differences[i]);
  for (const Eliminated& row : eliminated_) {
    std::size_t join = row.first_join;
    for (std::uint32_t i = row.first; i < row.end; ++i) {
      for (std::uint32_t k = i + 1; k < row.end; ++k, ++join)
        put(joins_[join], room_[couplings_[k].at] - room_[couplings_[i].at], differences[join]);
    }
  }
  for (auto row = eliminated_.rbegin(); row != eliminated_.rend(); ++row)
    find_star(*row, differences);
  for (std::size_t i = drops.size(); i-- > 0;)
    drops[i] = places_[i].sign * take(joins_[i], differences[i]);
}

/// What is left along the links of a vertex, from what is left along those of its mesh: the drops
/// of two links of the star differ by that of the link between their ends, and the currents add up
/// to 0.
void Elimination::find_star(const Eliminated& row, std::span<const double> differences) noexcept {
  const auto star = std::span(couplings_).subspan(row.first, row.end - row.first);
  std::size_t join = row.first_join + star.size() * (star.size() - (star.empty() ? 0 : 1)) / 2;
  for (const Coupling& coupling : star) room_[coupling.at] = 0.0;
  for (std::size_t i = star.size(); i-- > 0;) {
    for (std::size_t k = star.size(); k-- > i + 1;) {
      --join;
      const double left = take(joins_[join], differences[join]);
      room_[star[i].at] -= star[k].share * left;
      room_[star[k].at] += star[i].share * left;
    }
  }
}

}  // namespace plekton::contact
