// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/counting/level_complex.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace plekton::contact {

void LevelComplex::start(std::span<const double> distances,
                         std::span<const std::uint32_t> vertices) {
  distances_.assign(distances.begin(), distances.end());
  vertices_.assign(vertices.begin(), vertices.end());
  links_.clear();
  keys_.clear();
  fillings_.clear();
}

void LevelComplex::add_link(std::uint32_t side, std::uint32_t cell) {
  const std::uint32_t of_side = vertices_[side];
  const std::uint32_t of_cell = vertices_[cell];
  if (of_side == of_cell) return;
  const bool is_upper = of_side > of_cell;  // but for rounding
  keys_.push_back(
      {side, cell, std::max(of_side, of_cell), std::min(of_side, of_cell), is_upper ? 1 : -1, 0});
}

void LevelComplex::sort_links() {
  std::sort(keys_.begin(), keys_.end(), [](const LinkKey& a, const LinkKey& b) {
    return std::tie(a.upper, a.lower, a.side, a.cell) < std::tie(b.upper, b.lower, b.side, b.cell);
  });
  for (LinkKey& key : keys_) {
    key.link = static_cast<std::uint32_t>(links_.size());
    links_.push_back({key.upper, key.lower});
  }
  multiplicities_.assign(links_.size(), 1.0);
}

void LevelComplex::index_links() {
  std::sort(keys_.begin(), keys_.end());
}

void LevelComplex::add_to(Filling& filling, std::uint32_t side, std::uint32_t cell,
                          int sign) const {
  if (vertices_[side] == vertices_[cell]) return;
  const auto found = std::lower_bound(keys_.begin(), keys_.end(), LinkKey{side, cell, 0, 0, 0, 0});
  if (found == keys_.end() || found->side != side || found->cell != cell) return;
  filling.links[filling.count] = found->link;
  filling.signs[filling.count++] = static_cast<std::int8_t>(sign * found->sign);
}

void LevelComplex::add_filling(std::uint32_t corner, std::uint32_t first_side, std::uint32_t cell,
                               std::uint32_t last_side) {
  const std::uint32_t upper =
      std::max({vertices_[corner], vertices_[first_side], vertices_[last_side], vertices_[cell]});
  Filling filling{upper, {}, {}, 0};
  add_to(filling, corner, first_side, 1);
  add_to(filling, first_side, cell, 1);
  add_to(filling, last_side, cell, -1);
  add_to(filling, corner, last_side, -1);
  if (filling.count > 0) fillings_.push_back(filling);
}

void LevelComplex::sort_fillings() {
  std::sort(fillings_.begin(), fillings_.end(), [](const Filling& a, const Filling& b) {
    return std::tie(a.upper, a.links) < std::tie(b.upper, b.links);
  });
}

void LevelComplex::merge_links() {
  root_.resize(links_.size());
  std::iota(root_.begin(), root_.end(), 0U);
  while (unite_links()) {
  }
  number_links();
  for (Filling& filling : fillings_) {
    filling = merged(filling);
    for (std::size_t k = 0; k < filling.count; ++k) filling.links[k] = places_[filling.links[k]];
  }
  std::erase_if(fillings_, [](const Filling& filling) { return filling.count == 0; });
  const auto content = [](const Filling& filling) {
    return std::tie(filling.upper, filling.links, filling.signs);
  };
  std::sort(fillings_.begin(), fillings_.end(),
            [&](const Filling& a, const Filling& b) { return content(a) < content(b); });
  const auto same = [&](const Filling& a, const Filling& b) { return content(a) == content(b); };
  fillings_.erase(std::unique(fillings_.begin(), fillings_.end(), same), fillings_.end());
}

/// Without what goes back the way it came; the lowest link first, and upwards.
Filling LevelComplex::merged(const Filling& filling) const noexcept {
  Filling result{filling.upper, {}, {}, 0};
  std::array<std::pair<std::uint32_t, int>, 4> terms;
  std::size_t count = 0;
  for (std::size_t k = 0; k < filling.count; ++k) {
    const std::uint32_t link = root_of(filling.links[k]);
    std::size_t at = 0;
    while (at < count && terms[at].first < link) ++at;
    if (at == count || terms[at].first != link) {
      std::move_backward(terms.begin() + at, terms.begin() + count, terms.begin() + count + 1);
      terms[at] = {link, 0};
      ++count;
    }
    terms[at].second += filling.signs[k];
  }
  int first = 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (terms[k].second == 0) continue;
    if (first == 0) first = terms[k].second > 0 ? 1 : -1;
    result.links[result.count] = terms[k].first;
    result.signs[result.count++] = static_cast<std::int8_t>(first * terms[k].second);
  }
  return result;
}

/// @returns whether there were any to unite
bool LevelComplex::unite_links() noexcept {
  bool any = false;
  for (const Filling& filling : fillings_) {
    const Filling cycle = merged(filling);
    if (cycle.count != 2 || links_[cycle.links[0]].a != cycle.upper) continue;
    root_[cycle.links[1]] = cycle.links[0];
    any = true;
  }
  return any;
}

void LevelComplex::number_links() {
  places_.resize(links_.size());
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < links_.size(); ++i) {
    const std::uint32_t root = root_of(i);
    if (root != i) {
      multiplicities_[places_[root]] += 1.0;
      continue;
    }
    places_[i] = count;
    links_[count] = links_[i];
    multiplicities_[count++] = 1.0;
  }
  links_.resize(count);
  multiplicities_.resize(count);
}

}  // namespace plekton::contact
