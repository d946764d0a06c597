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
  link_place_.clear();
  for (const Link& link : links) {
    const auto [earlier, later] = std::minmax({row_of_[link.a], row_of_[link.b]});
    const Row& row = rows_[earlier];
    const auto columns = std::span(columns_).subspan(row.first, row.count);
    const auto found = std::lower_bound(columns.begin(), columns.end(), later);
    link_place_.push_back(row.first + static_cast<std::uint32_t>(found - columns.begin()));
  }
}

void Elimination::eliminate(std::uint32_t vertex_count, std::span<const double> conductances) {
  room_.assign(columns_.size(), 0.0);
  for (std::size_t i = 0; i < conductances.size(); ++i) room_[link_place_[i]] += conductances[i];
  eliminated_.clear();
  couplings_.clear();
  for (const Row& row : rows_) {
    if (row.vertex >= vertex_count) continue;
    const auto first = static_cast<std::uint32_t>(couplings_.size());
    double pivot = 0.0;
    for (std::uint32_t at = row.first; at < row.first + row.count; ++at) {
      if (room_[at] == 0.0) continue;
      couplings_.push_back({columns_[at], rows_[columns_[at]].vertex, room_[at]});
      pivot += room_[at];
    }
    eliminated_.push_back(
        {row.vertex, first, static_cast<std::uint32_t>(couplings_.size()), pivot});
    couple(std::span(couplings_).subspan(first), pivot);
  }
}

/// What coupled a vertex couples its neighbours instead.
void Elimination::couple(std::span<const Coupling> couplings, double pivot) {
  for (std::size_t i = 0; i + 1 < couplings.size(); ++i) {
    const double factor = couplings[i].conductance / pivot;
    std::uint32_t at = rows_[couplings[i].row].first;
    for (std::size_t k = i + 1; k < couplings.size(); ++k) {
      while (columns_[at] != couplings[k].row) ++at;
      room_[at] += factor * couplings[k].conductance;
    }
  }
}

void Elimination::solve(std::span<double> sources) const noexcept {
  for (const Eliminated& row : eliminated_) {
    if (row.pivot == 0.0 || sources[row.vertex] == 0.0) continue;
    const double factor = sources[row.vertex] / row.pivot;
    for (std::uint32_t at = row.first; at < row.end; ++at)
      sources[couplings_[at].vertex] += couplings_[at].conductance * factor;
  }
  for (auto row = eliminated_.rbegin(); row != eliminated_.rend(); ++row) {
    double source = sources[row->vertex];
    for (std::uint32_t at = row->first; at < row->end; ++at)
      source += couplings_[at].conductance * sources[couplings_[at].vertex];
    sources[row->vertex] = row->pivot == 0.0 ? 0.0 : source / row->pivot;
  }
}

}  // namespace plekton::contact
