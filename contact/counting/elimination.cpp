// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/counting/elimination.hpp"

#include <algorithm>

namespace plekton::contact {
namespace {

constexpr std::uint32_t kLeft = 0xffffffffU;  ///< of a vertex without a row, or in no star

}  // namespace

void Elimination::plan(std::uint32_t vertex_count, std::span<const Link> links) {
  if (neighbours_.size() < vertex_count) neighbours_.resize(vertex_count);
  if (stars_.size() < vertex_count) stars_.resize(vertex_count);
  for (std::uint32_t vertex = 0; vertex < vertex_count; ++vertex) {
    neighbours_[vertex].clear();
    stars_[vertex].clear();
  }
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
  std::size_t joins = links.size();
  for (const Row& row : rows_) joins += std::size_t{row.count} * (row.count - 1) / 2;
  if (joins_.size() < joins) joins_.resize(joins);
}

void Elimination::order_vertices(std::uint32_t vertex_count) {
  row_of_.assign(vertex_count, kLeft);
  star_of_.assign(vertex_count, kLeft);
  rows_.clear();
  columns_.clear();
  beside_.clear();
  degree_.resize(vertex_count);
  for (auto& list : by_degree_) list.clear();
  for (std::uint32_t vertex = 0; vertex < vertex_count; ++vertex)
    queue(vertex, neighbours_[vertex].size());
  for (std::size_t degree = 0; degree < by_degree_.size();) {
    auto& list = by_degree_[degree];
    if (list.empty()) {
      ++degree;
      continue;
    }
    const std::uint32_t vertex = list.back();
    list.pop_back();
    if (row_of_[vertex] != kLeft || degree_[vertex] != degree) continue;  // an older entry
    add_row(vertex);
    degree = std::min(degree, update_degrees(rows_.back()));
  }
  for (const Row& row : rows_) {
    const auto columns = std::span(columns_).subspan(row.first, row.count);
    for (std::uint32_t& column : columns) column = row_of_[column];
    std::sort(columns.begin(), columns.end());
  }
}

void Elimination::queue(std::uint32_t vertex, std::size_t degree) {
  degree_[vertex] = degree;
  if (by_degree_.size() <= degree) by_degree_.resize(degree + 1);
  by_degree_[degree].push_back(vertex);
}

/// Its neighbours are those by links, and the others of the stars that it is in; these stars are in
/// its own from now on.
void Elimination::add_row(std::uint32_t vertex) {
  const auto row = static_cast<std::uint32_t>(rows_.size());
  const auto first = static_cast<std::uint32_t>(columns_.size());
  row_of_[vertex] = row;
  const auto add = [&](std::uint32_t other) {
    if (other == vertex || star_of_[other] == row) return;
    star_of_[other] = row;
    columns_.push_back(other);
  };
  for (const std::uint32_t other : neighbours_[vertex]) add(other);
  for (const std::uint32_t star : stars_[vertex]) {
    for (std::uint32_t i = 0; i < rows_[star].count; ++i) add(columns_[rows_[star].first + i]);
    beside_[star].is_gone = true;
  }
  rows_.push_back({vertex, first, static_cast<std::uint32_t>(columns_.size()) - first});
  beside_.push_back({row, 0, false});
}

/// Of the vertices of the last star.
/// @returns the least
std::size_t Elimination::update_degrees(const Row& last) {
  const auto star = static_cast<std::uint32_t>(rows_.size() - 1);
  const auto vertices = std::span(columns_).subspan(last.first, last.count);
  for (const std::uint32_t vertex : vertices) {
    for (const std::uint32_t other : stars_[vertex]) {
      Beside& beside = beside_[other];
      if (beside.is_gone) continue;
      if (beside.last != star) beside = {star, rows_[other].count, false};
      --beside.count;
    }
  }
  std::size_t least = rows_.size() + vertices.size();
  for (const std::uint32_t vertex : vertices) {
    std::size_t degree = vertices.size() - 1;
    std::erase_if(neighbours_[vertex], [&](std::uint32_t other) {
      return other == last.vertex || star_of_[other] == star;
    });
    std::erase_if(stars_[vertex], [&](std::uint32_t other) {
      const Beside& beside = beside_[other];
      if (beside.is_gone || beside.count == 0) return true;
      degree += beside.count;
      return false;
    });
    stars_[vertex].push_back(star);
    degree += neighbours_[vertex].size();
    queue(vertex, std::min(degree, row_of_.size() - rows_.size() - 1));
    least = std::min(least, degree_[vertex]);
  }
  return least;
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
  join_count_ = 0;
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
    eliminated_.push_back({first, static_cast<std::uint32_t>(couplings_.size()), join_count_});
    make_mesh(std::span(couplings_).subspan(first), pivot);
  }
}

void Elimination::join(std::uint32_t at, double conductance) {
  const double old = room_[at];
  if (!(old > 0.0)) {  // also where what comes there is 0 by underflow
    room_[at] = conductance;
    joins_[join_count_++] = {at, 0.0, conductance > 0.0 ? 1.0 : 0.0, 0.0};
    return;
  }
  room_[at] += conductance;
  const double new_share = conductance / room_[at];
  joins_[join_count_++] = {at, old / room_[at], new_share, old * new_share};
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

void Elimination::leave_out(std::span<const double> values, std::span<double> chances,
                            std::span<double> rates) {
  rate_places(values);
  chances_.assign(columns_.size(), Chance{{0.0, 0.0}, {1.0, 0.0}});
  for (auto row = eliminated_.rbegin(); row != eliminated_.rend(); ++row) find_star_chances(*row);
  for (std::size_t i = values.size(); i-- > 0;) {
    const Rated out = take_out(joins_[i], differences_[i]).out;
    chances[i] = std::max(0.0, out.value);  // sums that cancel may round below
    rates[i] = out.rate;
  }
}

/// Forward: the rates of what comes side by side, and of what each star becomes.
void Elimination::rate_places(std::span<const double> values) {
  rates_.assign(columns_.size(), 0.0);
  differences_.resize(joins_.size());
  star_rates_.resize(couplings_.size());
  const auto put_rate = [this](std::size_t join, double rate) {
    const Join& here = joins_[join];
    double& place = rates_[here.at];
    differences_[join] = here.old_share > 0.0 ? rate - place : 0.0;
    place = here.old_share > 0.0 ? place + here.new_share * differences_[join] : rate;
  };
  for (std::size_t i = 0; i < values.size(); ++i) put_rate(i, values[i]);
  for (const Eliminated& row : eliminated_) {
    double pivot = 0.0;
    for (std::uint32_t i = row.first; i < row.end; ++i) {
      star_rates_[i] = rates_[couplings_[i].at];
      pivot += couplings_[i].share * star_rates_[i];
    }
    std::size_t join = row.first_join;
    for (std::uint32_t i = row.first; i < row.end; ++i) {
      for (std::uint32_t k = i + 1; k < row.end; ++k, ++join)
        put_rate(join, star_rates_[i] + star_rates_[k] - pivot);
    }
  }
}

/// Takes the last link off its place again. Of two links side by side a forest holds one at most.
Elimination::Chance Elimination::take_out(const Join& join, double difference) noexcept {
  Chance& place = chances_[join.at];
  if (!(join.old_share > 0.0)) return join.new_share > 0.0 ? place : Chance{{}, {1.0, 0.0}};
  const double rate = join.old_share * join.new_share * difference;
  const Rated share{join.new_share, rate};
  const Rated other{join.old_share, -rate};
  const Chance taken{share * place.in, other + share * place.out};
  place = {other * place.in, share + other * place.out};
  return taken;
}

/// The shares of the links of a star, and what all others have.
void Elimination::rate_star(std::span<const Coupling> star) {
  const auto first = static_cast<std::size_t>(star.data() - couplings_.data());
  const auto rates = std::span(star_rates_).subspan(first, star.size());
  star_.assign(star.size(), {});
  others_.assign(star.size(), {});
  for (std::size_t i = 0; i < star.size(); ++i) {
    double rate = 0.0;
    for (std::size_t k = 0; k < star.size(); ++k) rate += star[k].share * (rates[i] - rates[k]);
    star_[i] = {star[i].share, star[i].share * rate};
  }
  Rated before, after;
  for (std::size_t i = 0, k = star.size(); i < star.size(); ++i) {
    others_[i] = others_[i] + before;
    before = before + star_[i];
    --k;
    others_[k] = others_[k] + after;
    after = after + star_[k];
  }
}

/// A forest holds one link of a star more than of its mesh: a link of the mesh stands for two of
/// the star, and one more is in it by its share. What is likely for the links of the mesh beside
/// one of the star is added up from those on either side of it in the order, and across it.
void Elimination::find_star_chances(const Eliminated& row) {
  const auto star = std::span(couplings_).subspan(row.first, row.end - row.first);
  const std::size_t n = star.size();
  rate_star(star);
  with_.assign(n, {});
  below_.assign(n + 1, {});
  across_.assign(n, {});
  Rated above;  // of the pairs that lie above a link
  std::size_t join = row.first_join + n * (n - (n == 0 ? 0 : 1)) / 2;
  for (std::size_t i = n; i-- > 0;) {
    Rated after;  // of the pairs of i with links after k
    across_[i] = across_[i] + above;
    for (std::size_t k = n; k-- > i + 1;) {
      --join;
      const Rated in = take_out(joins_[join], differences_[join]).in;
      with_[i] = with_[i] + in;
      with_[k] = with_[k] + in;
      below_[k] = below_[k] + in;
      across_[k] = across_[k] + after;
      after = after + in;
    }
    above = above + after;
  }
  const Rated alone{1.0 - above.value, -above.rate};
  Rated below;  // of the pairs that lie below a link
  for (std::size_t i = 0; i < n; ++i) {
    chances_[star[i].at] = {star_[i] * alone + with_[i], others_[i] * alone + across_[i] + below};
    below = below + below_[i];
  }
}

}  // namespace plekton::contact
