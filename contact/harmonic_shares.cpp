// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/harmonic_shares.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace plekton::contact {
namespace {

using Row = Eigen::Map<Eigen::VectorXd>;

Row row_of(std::vector<double>& matrix, std::size_t row, std::size_t columns) {
  return {matrix.data() + row * columns, static_cast<Eigen::Index>(columns)};
}

/// Room for a number of entries, all zero; it only grows.
void clear(std::vector<double>& room, std::size_t count) {
  if (room.size() < count) room.resize(std::max(count, 2 * room.size()));
  std::fill_n(room.begin(), count, 0.0);
}

/// Two vertices at one distance have a link without resistance; this share of the largest is as
/// good as none, and finite.
constexpr double kLeastResistance = 1e-20;

}  // namespace

void HarmonicShares::build(std::uint32_t vertex_count, std::span<const Link> links,
                           std::span<const Filling> fillings) {
  vertex_count_ = vertex_count;
  is_planned_ = false;
  find_closings(vertex_count, links);
  currents_.clear();
  clear(row_, closings_.size());
  for (const Filling& filling : fillings) reduce(filling);
}

void HarmonicShares::find_closings(std::uint32_t vertex_count, std::span<const Link> links) {
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

/// Finds the youngest ring that the filling, with older ones, is the first to close. (Pieces of a
/// surface in space have boundaries without torsion, so the currents stay -1, 0 and 1, or small
/// whole numbers.)
void HarmonicShares::reduce(const Filling& filling) {
  for (std::size_t k = 0; k < filling.count; ++k) {
    const std::uint32_t place = place_[filling.links[k]];
    if (place != kNone) row_[place] += filling.signs[k];
  }
  for (std::size_t last = closings_.size(); last-- > 0;) {
    const double current = row_[last];
    if (current == 0.0) continue;
    Closing& closing = closings_[last];
    if (closing.filled_at == kNone) {
      closing.filled_at = filling.upper;
      closing.first = static_cast<std::uint32_t>(currents_.size());
      for (std::uint32_t i = 0; i <= last; ++i) {
        if (row_[i] != 0.0) currents_.push_back({i, std::exchange(row_[i], 0.0)});
      }
      closing.count = static_cast<std::uint32_t>(currents_.size()) - closing.first;
      return;
    }
    const auto older = std::span(currents_).subspan(closing.first, closing.count);
    const double factor = current / older.back().current;
    for (const Current& entry : older) row_[entry.closing] -= factor * entry.current;
  }
}

std::size_t HarmonicShares::hole_count(std::uint32_t vertex_count) const noexcept {
  return static_cast<std::size_t>(
      std::count_if(closings_.begin(), closings_.end(),
                    [&](const Closing& closing) { return closing.is_open(vertex_count); }));
}

std::span<const double> HarmonicShares::find(std::uint32_t vertex_count,
                                             std::span<const Link> all_links) {
  const auto end = std::partition_point(all_links.begin(), all_links.end(),
                                        [&](const Link& link) { return link.a < vertex_count; });
  const auto links = all_links.first(static_cast<std::size_t>(end - all_links.begin()));
  shares_.assign(links.size(), 0.0);
  const std::size_t holes = hole_count(vertex_count);
  if (holes == 0) return shares_;

  forest_.grow(vertex_count, links);
  forest_.hang(links);
  if (!is_planned_) elimination_.plan(vertex_count_, all_links);
  is_planned_ = true;
  set_conductances(links);
  elimination_.eliminate(vertex_count, conductance_);
  clear(flows_, holes * links.size());
  std::size_t hole = 0;
  for (std::size_t k = 0; k < closings_.size(); ++k) {
    if (!closings_[k].is_open(vertex_count)) continue;
    set_circulation(k, vertex_count, links);
    set_on_no_tree(links);
    take_off_potential(links);
    for (std::size_t i = 0; i < links.size(); ++i)
      flows_[hole * links.size() + i] = shares_[i] * root_conductance_[i];
    ++hole;
  }
  orthonormalise(holes, links.size());
  std::fill(shares_.begin(), shares_.end(), 0.0);
  for (std::size_t k = 0; k < holes; ++k) {
    for (std::size_t i = 0; i < links.size(); ++i) {
      const double flow = flows_[k * links.size() + i];
      shares_[i] += flow * flow;
    }
  }
  return shares_;
}

void HarmonicShares::set_conductances(std::span<const Link> links) {
  double largest = 0.0;
  for (const Link& link : links) largest = std::max(largest, link.resistance);
  conductance_.clear();
  root_conductance_.clear();
  for (const Link& link : links) {
    conductance_.push_back(1.0 / std::max(link.resistance, kLeastResistance * largest));
    root_conductance_.push_back(std::sqrt(conductance_.back()));
  }
}

/// Drops along the links (in shares_) whose sum is 1 round one open ring, and 0 round every other
/// and round every filled one.
void HarmonicShares::set_circulation(std::size_t open, std::uint32_t vertex_count,
                                     std::span<const Link> links) {
  row_[open] = 1.0;
  for (std::size_t k = open + 1; k < closings_.size(); ++k) {
    const Closing& closing = closings_[k];
    if (closing.filled_at >= vertex_count) continue;
    const auto entries = std::span(currents_).subspan(closing.first, closing.count);
    double sum = 0.0;
    for (const Current& entry : entries.first(entries.size() - 1))
      sum += entry.current * row_[entry.closing];
    row_[k] = -sum / entries.back().current;
  }
  for (std::size_t i = 0; i < links.size(); ++i)
    shares_[i] = place_[i] == kNone ? 0.0 : row_[place_[i]];
  std::fill_n(row_.begin() + static_cast<std::ptrdiff_t>(open), closings_.size() - open, 0.0);
}

/// Takes off the gradient of a potential, so that the drops are 0 along the links of a forest of
/// little resistance. The drops are small whole numbers, so this is exact. What is left is on links
/// that resist at least half as much as any on the way round them: a drop of 1 along a link of
/// hardly any resistance, in a ring of others, would be a source so strong that all else drowned in
/// its rounding errors.
void HarmonicShares::set_on_no_tree(std::span<const Link> links) {
  potential_.assign(forest_.downwards().size(), 0.0);
  for (const std::uint32_t vertex : forest_.downwards()) {
    const SpanningForest::Parent& up = forest_.parent(vertex);
    if (up.link == SpanningForest::kNone) continue;
    const double drop = shares_[up.link];
    potential_[vertex] = potential_[up.vertex] + (links[up.link].a == vertex ? drop : -drop);
  }
  for (std::size_t i = 0; i < links.size(); ++i)
    shares_[i] -= potential_[links[i].a] - potential_[links[i].b];
}

/// Of all drops with these sums the ones without sources: what is left when the gradient of a
/// potential is taken off.
void HarmonicShares::take_off_potential(std::span<const Link> links) {
  source_.assign(potential_.size(), 0.0);
  for (std::size_t i = 0; i < links.size(); ++i) {
    source_[links[i].a] += conductance_[i] * shares_[i];
    source_[links[i].b] -= conductance_[i] * shares_[i];
  }
  elimination_.solve(source_);
  for (std::size_t i = 0; i < links.size(); ++i)
    shares_[i] -= source_[links[i].a] - source_[links[i].b];
}

/// Gram and Schmidt; again where little is left, because once leaves the rounding errors of what it
/// took away.
void HarmonicShares::orthonormalise(std::size_t hole_count, std::size_t link_count) {
  for (std::size_t i = 0; i < hole_count; ++i) {
    Row flow = row_of(flows_, i, link_count);
    double norm = flow.norm();
    double norm_before = 3.0 * norm;
    for (int pass = 0; pass < 2 && norm < 0.5 * norm_before; ++pass) {
      norm_before = norm;
      for (std::size_t k = 0; k < i; ++k) {
        const Row before = row_of(flows_, k, link_count);
        flow -= flow.dot(before) * before;
      }
      norm = flow.norm();
    }
    flow /= norm;
  }
}

}  // namespace plekton::contact
