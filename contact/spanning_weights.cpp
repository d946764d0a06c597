// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/spanning_weights.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace plekton::contact {
namespace {

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
/// at least half as large. A ring without any resistance shares evenly.
double ratio_of(const Link& tree, const Link& closing) noexcept {
  return closing.resistance > 0.0 ? std::sqrt(tree.resistance / closing.resistance) : 1.0;
}

}  // namespace

std::span<const double> SpanningWeights::find(std::uint32_t vertex_count,
                                              std::span<const Link> links) {
  forest_.grow(vertex_count, links);
  weights_.assign(links.size(), 0.0);
  for (const std::uint32_t link : forest_.tree_links()) weights_[link] = 1.0;
  if (!forest_.closing_links().empty()) {
    forest_.hang(links);
    share_rings(links);
  }
  return weights_;
}

void SpanningWeights::fill_cycles(std::span<const Link> links) {
  const auto tree = forest_.tree_links();
  const auto closing_links = forest_.closing_links();
  tree_place_.assign(links.size(), SpanningForest::kNone);
  for (std::uint32_t i = 0; i < tree.size(); ++i) tree_place_[tree[i]] = i;
  Matrix cycles = matrix_in(cycles_, closing_links.size(), tree.size());
  cycles.setZero();
  for (std::size_t c = 0; c < closing_links.size(); ++c) {
    const Link& closing = links[closing_links[c]];
    // The tree path between the two ends; a step up from a counts +, a step up from b counts -.
    std::uint32_t a = closing.a;
    std::uint32_t b = closing.b;
    while (a != b) {
      const bool climb_a = forest_.parent(a).depth >= forest_.parent(b).depth;
      const SpanningForest::Parent& up = forest_.parent(climb_a ? a : b);
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
  const auto tree = forest_.tree_links();
  const auto closing_links = forest_.closing_links();
  const std::size_t rings = closing_links.size();
  const Matrix cycles = matrix_in(cycles_, rings, tree.size());
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
    weights_[closing_links[c]] = weight();
  }
  for (std::size_t i = 0; i < tree.size(); ++i) {
    column = cycles.col(as_index(i));
    weights_[tree[i]] = weight();
  }
}

}  // namespace plekton::contact
