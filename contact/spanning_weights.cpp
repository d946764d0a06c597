// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/spanning_weights.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace plekton::contact {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

Eigen::Index as_index(std::size_t i) {
  return static_cast<Eigen::Index>(i);
}

using Matrix = Eigen::Map<Eigen::MatrixXd>;

/// Room for a number of entries, and for twice what there was if that was less.
void grow(std::vector<double>& room, std::size_t count) {
  if (room.size() < count) room.resize(std::max(count, 2 * room.size()));
}

/// A matrix in room that only grows.
Matrix matrix_in(std::vector<double>& room, std::size_t rows, std::size_t columns) {
  grow(room, rows * columns);
  return {room.data(), as_index(rows), as_index(columns)};
}

/// Root of the resistance of a tree link over that of a link that closes a ring with it, which is
/// at least as large. A ring without any resistance shares evenly.
double ratio_of(const Link& tree, const Link& closing) noexcept {
  return closing.resistance > 0.0 ? std::sqrt(tree.resistance / closing.resistance) : 1.0;
}

}  // namespace

std::span<const double> SpanningWeights::find(std::uint32_t vertex_count,
                                              std::span<const Link> links) {
  grow_forest(vertex_count, links);
  weights_.assign(links.size(), 0.0);
  for (const std::uint32_t link : tree_links_) weights_[link] = 1.0;
  if (!closing_links_.empty()) {
    hang_trees(vertex_count, links);
    share_rings(links);
  }
  return weights_;
}

std::uint32_t SpanningWeights::root_of(std::uint32_t vertex) const noexcept {
  while (root_[vertex] != vertex) vertex = root_[vertex];
  return vertex;
}

void SpanningWeights::grow_forest(std::uint32_t vertex_count, std::span<const Link> links) {
  root_.resize(vertex_count);
  std::iota(root_.begin(), root_.end(), 0U);
  tree_links_.clear();
  closing_links_.clear();
  order_.resize(links.size());
  std::iota(order_.begin(), order_.end(), 0U);
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t i, std::uint32_t j) {
    return links[i].resistance != links[j].resistance ? links[i].resistance < links[j].resistance
                                                      : i < j;
  });
  for (const std::uint32_t i : order_) {
    if (links[i].a == links[i].b) continue;
    const auto [low, high] = std::minmax({root_of(links[i].a), root_of(links[i].b)});
    if (low == high) {
      closing_links_.push_back(i);
    } else {
      root_[high] = low;
      tree_links_.push_back(i);
    }
  }
}

void SpanningWeights::hang_trees(std::uint32_t vertex_count, std::span<const Link> links) {
  parent_.assign(vertex_count, Parent{kNone, kNone, kNone});
  for (std::uint32_t vertex = 0; vertex < vertex_count; ++vertex) {
    if (root_[vertex] == vertex) parent_[vertex].depth = 0;
  }
  // Each round hangs at least one more generation; the graphs are small.
  for (bool grew = true; grew;) {
    grew = false;
    for (const std::uint32_t link : tree_links_) {
      std::uint32_t upper = links[link].a;
      std::uint32_t lower = links[link].b;
      if (parent_[upper].depth == kNone) std::swap(upper, lower);
      if (parent_[upper].depth == kNone || parent_[lower].depth != kNone) continue;
      parent_[lower] = {upper, link, parent_[upper].depth + 1};
      grew = true;
    }
  }
}

void SpanningWeights::fill_cycles(std::span<const Link> links) {
  tree_place_.assign(links.size(), kNone);
  for (std::uint32_t i = 0; i < tree_links_.size(); ++i) tree_place_[tree_links_[i]] = i;
  Matrix cycles = matrix_in(cycles_, closing_links_.size(), tree_links_.size());
  cycles.setZero();
  for (std::size_t c = 0; c < closing_links_.size(); ++c) {
    const Link& closing = links[closing_links_[c]];
    // The tree path between the two ends; a step up from a counts +, a step up from b counts -.
    std::uint32_t a = closing.a;
    std::uint32_t b = closing.b;
    while (a != b) {
      const bool climb_a = parent_[a].depth >= parent_[b].depth;
      const Parent& up = climb_a ? parent_[a] : parent_[b];
      // Towards the parent the tree link is taken as oriented child -> parent for every cycle
      // alike.
      cycles(as_index(c), as_index(tree_place_[up.link])) =
          (climb_a ? 1.0 : -1.0) * ratio_of(links[up.link], closing);
      (climb_a ? a : b) = up.vertex;
    }
  }
}

void SpanningWeights::share_rings(std::span<const Link> links) {
  fill_cycles(links);
  const std::size_t rings = closing_links_.size();
  const Matrix cycles = matrix_in(cycles_, rings, tree_links_.size());
  Matrix gram = matrix_in(gram_, rings, rings);
  // Coefficient by coefficient: Eigen's product of large matrices allocates.
  gram = cycles.lazyProduct(cycles.transpose());
  gram.diagonal().array() += 1.0;
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(gram);  // in place

  // With L L^T = 1 + C C^T, the probability c^T (L L^T)^-1 c to be left out is |L^-1 c|^2; of a
  // closing link, c is a unit vector.
  grow(column_, rings);
  Eigen::Map<Eigen::VectorXd> column(column_.data(), as_index(rings));
  const auto weight = [&] {
    factor.matrixL().solveInPlace(column);
    return std::clamp(1.0 - column.squaredNorm(), 0.0, 1.0);
  };
  for (std::size_t c = 0; c < rings; ++c) {
    column = Eigen::VectorXd::Unit(as_index(rings), as_index(c));
    weights_[closing_links_[c]] = weight();
  }
  for (std::size_t i = 0; i < tree_links_.size(); ++i) {
    column = cycles.col(as_index(i));
    weights_[tree_links_[i]] = weight();
  }
}

}  // namespace plekton::contact
