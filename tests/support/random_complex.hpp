// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/counting/cycle_basis.hpp"
#include "tests/support/linear_algebra.hpp"
#include "tests/support/seeded_random.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

/// Vertices, links and filled rings at random, and what their definition says about them.
namespace plekton::test {

using contact::Filling;
using contact::Link;

/// Links between vertices 0 .. n - 1, ascending by upper vertex, with resistances from 1 to a power
/// of 10.
inline std::vector<Link> random_links(Random& random, std::uint32_t n, int count, double power) {
  std::vector<Link> links;
  for (int i = 0; i < count; ++i) {
    const auto a = static_cast<std::uint32_t>(1 + random.index(n - 1));
    links.push_back({a, static_cast<std::uint32_t>(random.index(a)),
                     std::pow(10.0, random.uniform(0.0, power))});
  }
  std::sort(links.begin(), links.end(), [](const Link& i, const Link& k) { return i.a < k.a; });
  return links;
}

/// Some triangles and quadrangles of links, found by trying.
inline std::vector<Filling> random_fillings(Random& random, const std::vector<Link>& links,
                                            int tries) {
  std::vector<Filling> fillings;
  for (int t = 0; t < tries; ++t) {
    Filling filling{0, {}, {}, 0};
    auto at = static_cast<std::uint32_t>(links[random.index(links.size())].a);
    const std::uint32_t start = at;
    do {
      const auto link = static_cast<std::uint32_t>(random.index(links.size()));
      if (links[link].a != at && links[link].b != at) continue;
      const bool along = links[link].a == at;
      at = along ? links[link].b : links[link].a;
      filling.upper = std::max(filling.upper, links[link].a);
      filling.links[filling.count] = link;
      filling.signs[filling.count++] = along ? 1 : -1;
    } while (filling.count == 0 || (filling.count < 4 && at != start));
    if (at == start) fillings.push_back(filling);
  }
  std::sort(fillings.begin(), fillings.end(),
            [](const Filling& i, const Filling& k) { return i.upper < k.upper; });
  return fillings;
}

/// The links, or fillings, whose upper vertex is below one.
inline std::span<const Link> links_below(const std::vector<Link>& links, std::uint32_t vertex) {
  const auto end =
      std::find_if(links.begin(), links.end(), [&](const Link& link) { return link.a >= vertex; });
  return {links.begin(), end};
}
inline std::span<const Filling> fillings_below(const std::vector<Filling>& fillings,
                                               std::uint32_t vertex) {
  const auto end = std::find_if(fillings.begin(), fillings.end(),
                                [&](const Filling& filling) { return filling.upper >= vertex; });
  return {fillings.begin(), end};
}

/// An orthonormal basis, in root(resistance) * current, of the currents without sources that are
/// orthogonal to all filled rings: as many as there are holes.
inline Eigen::MatrixXd flows_of(std::uint32_t n, std::span<const Link> links,
                                std::span<const Filling> fillings) {
  const auto count = static_cast<Eigen::Index>(links.size());
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(
      static_cast<Eigen::Index>(n) + static_cast<Eigen::Index>(fillings.size()), count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Link& link = links[static_cast<std::size_t>(i)];
    rows(link.a, i) += 1.0 / std::sqrt(link.resistance);
    rows(link.b, i) -= 1.0 / std::sqrt(link.resistance);
  }
  for (std::size_t f = 0; f < fillings.size(); ++f) {
    for (std::size_t k = 0; k < fillings[f].count; ++k) {
      const std::uint32_t link = fillings[f].links[k];
      rows(static_cast<Eigen::Index>(n + f), link) +=
          fillings[f].signs[k] * std::sqrt(links[link].resistance);
    }
  }
  return kernel_of(rows, count);
}

}  // namespace plekton::test
