// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/hollow_shares.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plekton::contact {
namespace {

using Matrix = Eigen::Map<Eigen::MatrixXd>;

/// A square matrix in room that only grows.
Matrix matrix_in(std::vector<double>& room, std::size_t size) {
  if (room.size() < size * size) room.resize(std::max(size * size, 2 * room.size()));
  const auto n = static_cast<Eigen::Index>(size);
  return {room.data(), n, n};
}

}  // namespace

std::size_t HollowShares::hollow_count(std::uint32_t vertex_count) const noexcept {
  const auto shells = shells_.shells();
  const auto end =
      std::partition_point(shells.begin(), shells.end(),
                           [&](const Shells::Shell& shell) { return shell.upper < vertex_count; });
  return static_cast<std::size_t>(end - shells.begin());
}

double HollowShares::weight_of(std::uint32_t facet,
                               std::span<const double> weights) const noexcept {
  const auto& corners = shells_.facets()[facet].corners;
  return weights[corners[0]] + weights[corners[1]] + weights[corners[2]];
}

std::span<const double> HollowShares::find(std::uint32_t vertex_count,
                                           std::span<const double> weights) {
  shares_.assign(weights.size(), 0.0);
  const std::size_t hollows = hollow_count(vertex_count);
  if (hollows == 0) return shares_;

  list_by_facet(hollows, weights);
  invert_products(hollows, weights);
  const Matrix inverse = matrix_in(inverse_, hollows);
  for (std::size_t facet = 0; facet + 1 < first_.size(); ++facet) {
    const auto takers =
        std::span(by_facet_).subspan(first_[facet], first_[facet + 1] - first_[facet]);
    if (takers.empty()) continue;  // its corners may be above
    double product = 0.0;
    for (const Shells::Entry& i : takers) {
      for (const Shells::Entry& k : takers) product += i.times * inverse(i.at, k.at) * k.times;
    }
    for (const std::uint32_t corner : shells_.facets()[facet].corners)
      shares_[corner] += product * weights[corner];
  }
  return shares_;
}

void HollowShares::list_by_facet(std::size_t hollows, std::span<const double> weights) {
  const auto shells = shells_.shells().first(hollows);
  scale_.clear();
  first_.assign(shells_.facets().size() + 2, 0);
  for (const Shells::Shell& shell : shells) {
    const auto entries = shells_.entries(shell);
    scale_.push_back(1.0 / std::sqrt(weight_of(entries.back().at, weights)));
    for (const Shells::Entry& entry : entries) ++first_[entry.at + 2];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  by_facet_.resize(first_.back());
  for (std::uint32_t k = 0; k < hollows; ++k) {
    for (const Shells::Entry& entry : shells_.entries(shells[k]))
      by_facet_[first_[entry.at + 1]++] = {k, entry.times * scale_[k]};
  }
  first_.pop_back();
}

void HollowShares::invert_products(std::size_t hollows, std::span<const double> weights) {
  Matrix products = matrix_in(products_, hollows);
  products.setZero();
  for (std::uint32_t facet = 0; facet + 1 < first_.size(); ++facet) {
    const auto takers =
        std::span(by_facet_).subspan(first_[facet], first_[facet + 1] - first_[facet]);
    if (takers.empty()) continue;  // its corners may be above
    const double weight = weight_of(facet, weights);
    for (const Shells::Entry& i : takers) {
      for (const Shells::Entry& k : takers) products(i.at, k.at) += weight * i.times * k.times;
    }
  }
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(products);  // in place
  Matrix inverse = matrix_in(inverse_, hollows);
  inverse.setIdentity();
  // Column by column: Eigen's solution for many at once allocates.
  for (Eigen::Index k = 0; k < inverse.cols(); ++k) {
    auto column = inverse.col(k);
    factor.solveInPlace(column);
  }
}

}  // namespace plekton::contact
