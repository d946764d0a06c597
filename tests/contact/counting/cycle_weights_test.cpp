// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/counting/cycle_weights.hpp"

#include "contact/sphere_surface/near_complex.hpp"
#include "tests/support/contact_surfaces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace plekton::test::cycle_weights_test {
namespace {

constexpr double kRange = 1.0;
constexpr int kSharpness = 12;

/// An upper and a lower vertex.
using Links = std::vector<std::array<std::uint32_t, 2>>;

std::vector<std::uint32_t> numbers_to(std::size_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

/// Without filled cycles.
LevelComplex graph(const std::vector<double>& distances, const Links& links) {
  LevelComplex complex;
  complex.start(distances, numbers_to(distances.size()));
  for (const auto& [upper, lower] : links) complex.add_link(upper, lower);
  complex.sort_links();
  return complex;
}

/// Facets around a corner, the last vertex: as many cells, which come first, as sides. Side k is
/// between cells k and k + 1.
LevelComplex fan(const std::vector<double>& distances) {
  const auto count = static_cast<std::uint32_t>(distances.size() / 2);
  const std::uint32_t corner = 2 * count;
  LevelComplex complex;
  complex.start(distances, numbers_to(distances.size()));
  for (std::uint32_t k = 0; k < count; ++k) {
    complex.add_link(count + k, k);
    complex.add_link(count + k, (k + 1) % count);
    complex.add_link(corner, count + k);
  }
  complex.sort_links();
  complex.index_links();
  for (std::uint32_t k = 0; k < count; ++k)
    complex.add_filling(corner, count + (k + count - 1) % count, k, count + k);
  complex.sort_fillings();
  return complex;
}

struct Weights {
  std::vector<double> weights, slopes;  // by vertex
};

Weights weights_of(CycleWeights& cycles, const LevelComplex& complex,
                   const std::vector<double>& energies, double range = kRange) {
  Weights found{std::vector<double>(energies.size(), 0.0),
                std::vector<double>(energies.size(), 0.0)};
  std::uint32_t next = 0;
  for (const CycleWeights::Share& share : cycles.find(complex, range, energies)) {
    EXPECT_GE(share.vertex, next) << "nearest first, each once";
    EXPECT_TRUE(share.weight != 0.0 || share.slope != 0.0);
    next = share.vertex + 1;
    found.weights[share.vertex] = share.weight;
    found.slopes[share.vertex] = share.slope;
  }
  return found;
}

/// What a link resists that goes down from one distance to another, with a maximum at a third.
double resistance(double upper, double lower, double maximum) {
  const auto inverse = [&](double distance) {
    const double overlap = kRange - distance, of_maximum = kRange - maximum;
    return std::pow(overlap * overlap - of_maximum * of_maximum, -kSharpness);
  };
  return inverse(upper) - inverse(lower);
}

/// Weights of saddles that stand on two minima each and close one cycle: -1, and the share of their
/// links in what the cycle resists.
std::vector<double> expected_saddles(const std::vector<double>& minima,
                                     const std::vector<double>& saddles, double maximum) {
  std::vector<double> shares;
  double sum = 0.0;
  for (std::size_t k = 0; k < saddles.size(); ++k) {
    shares.push_back(resistance(saddles[k], minima[k], maximum) +
                     resistance(saddles[k], minima[(k + 1) % minima.size()], maximum));
    sum += shares.back();
  }
  for (double& share : shares) share = share / sum - 1.0;
  return shares;
}

std::vector<double> joined(std::vector<double> first, const std::vector<double>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

TEST(CycleWeights, OfTwoPiecesOnOneSaddleAreThoseOfOneContact) {
  CycleWeights cycles;
  const Weights found =
      weights_of(cycles, graph({0.1, 0.2, 0.5}, {{2, 0}, {2, 1}}), {3.0, 2.0, 1.0});

  EXPECT_EQ(found.weights, (std::vector<double>{1.0, 1.0, -1.0}));
  EXPECT_EQ(found.slopes, (std::vector<double>{0.0, 0.0, 0.0}));
}

TEST(CycleWeights, GiveAnOpenCycleBackByWhatItsSaddlesResist) {
  CycleWeights cycles;
  for (const auto& [minima, saddles] :
       {std::pair<std::vector<double>, std::vector<double>>{{0.1, 0.2}, {0.5, 0.52}},
        {{0.1, 0.2, 0.3}, {0.5, 0.5, 0.6}},
        {{0.0, 0.05, 0.1, 0.2}, {0.3, 0.32, 0.33, 0.9}}}) {
    const auto count = static_cast<std::uint32_t>(minima.size());
    Links links;
    for (std::uint32_t k = 0; k < count; ++k) {
      links.push_back({count + k, k});
      links.push_back({count + k, (k + 1) % count});
    }
    const std::vector<double> distances = joined(minima, saddles);

    const Weights found = weights_of(cycles, graph(distances, links), distances);

    // The hole lasts to the range, where nothing overlaps.
    const std::vector<double> expected =
        joined(std::vector<double>(count, 1.0), expected_saddles(minima, saddles, kRange));
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(found.weights[i], expected[i], 1e-12) << count << ", vertex " << i;
  }
}

TEST(CycleWeights, GiveACycleBackByTheOverlapsBeyondThatOfTheMaximumThatFillsIt) {
  CycleWeights cycles;
  const std::vector<double> cells{0.1, 0.15, 0.2}, sides{0.4, 0.45, 0.46};
  for (const double maximum : {0.5, 0.7, 0.95}) {
    const std::vector<double> distances = joined(joined(cells, sides), {maximum});

    const Weights found = weights_of(cycles, fan(distances), std::vector<double>(7, 1.0));

    const std::vector<double> expected =
        joined(joined(std::vector<double>(3, 1.0), expected_saddles(cells, sides, maximum)), {0.0});
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(found.weights[i], expected[i], 1e-12) << maximum << ", vertex " << i;
  }
}

/// J, of energies of contacts that do not change, at distances that do.
template <class Build>
double energy_at(CycleWeights& cycles, const Build& build, const std::vector<double>& distances,
                 const std::vector<double>& energies) {
  const Weights found = weights_of(cycles, build(distances), energies);
  return std::inner_product(energies.begin(), energies.end(), found.weights.begin(), 0.0);
}

template <class Build>
void expect_slopes_of_the_energy(const Build& build, const std::vector<double>& distances,
                                 Random& random) {
  CycleWeights cycles;
  std::vector<double> energies;
  for (std::size_t i = 0; i < distances.size(); ++i) energies.push_back(random.uniform(0.5, 1.5));
  const Weights found = weights_of(cycles, build(distances), energies);
  const double largest =
      std::abs(*std::max_element(found.slopes.begin(), found.slopes.end(),
                                 [](double p, double q) { return std::abs(p) < std::abs(q); }));
  for (std::size_t i = 0; i < distances.size(); ++i) {
    constexpr double kStep = 1e-6;
    const auto moved = [&](double overlap) {
      std::vector<double> other = distances;
      other[i] -= overlap;
      return energy_at(cycles, build, other, energies);
    };
    const double expected = (moved(kStep) - moved(-kStep)) / (2.0 * kStep);
    // By the square of the step times the third power of n over the least difference of overlaps
    // squared, 0.02; and by rounding over the step.
    const double error = std::pow(kStep * kSharpness / 0.02, 2);
    ASSERT_NEAR(found.slopes[i], expected, error * (1.0 + largest) + 1e-9) << "vertex " << i;
  }
}

TEST(CycleWeights, HaveTheSlopesOfTheEnergyByTheOverlaps) {
  Random random(1);
  for (int trial = 0; trial < 30; ++trial) {
    // Minima and saddles between them at random, in steps that keep their order.
    const int minima = random.integer(2, 6), saddles = random.integer(2, 8);
    std::vector<double> distances;
    Links links;
    for (int i = 0; i < minima + saddles; ++i)
      distances.push_back((i < minima ? 0.0 : 0.1) + 0.05 * i + random.uniform(0.0, 0.04));
    for (int k = 0; k < saddles; ++k) {
      const int first = random.integer(0, minima - 1);
      const int second = (first + random.integer(1, minima - 1)) % minima;
      for (const int minimum : {first, second})
        links.push_back(
            {static_cast<std::uint32_t>(minima + k), static_cast<std::uint32_t>(minimum)});
    }
    expect_slopes_of_the_energy([&](const auto& x) { return graph(x, links); }, distances, random);

    distances.clear();
    for (int i = 0; i < 9; ++i)
      distances.push_back((i < 4 ? 0.1 : 0.2) + 0.05 * i + random.uniform(0.0, 0.04));
    distances.back() += 0.1;
    expect_slopes_of_the_energy(fan, distances, random);
  }
}

TEST(CycleWeights, AddUpToThePiecesOfASurfaceInRange) {
  Random random(2);
  CycleWeights cycles;
  int with_holes = 0, apart = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const std::array<Complex, 4> kinds{roughened(net(4), 1.0, 0.3, random),
                                       roughened(sheet(4), 1.0, 0.4, random),
                                       plate_with_hole(7, 0.5, 2.0), random_complex(random, false)};
    const Complex& complex = kinds[static_cast<std::size_t>(trial % 4)];
    const Surface surface = complex.surface();
    const Vec3 point =
        trial % 4 < 2 ? Vec3(2.0, 2.0, 0.3) + random.in_cube(1.0) : Vec3(random.in_cube(0.5));
    NearComplex near;
    near.build(surface, point, 1.3, all_cells(surface), complex.x);
    const LevelComplex& levels = near.levels();
    std::vector<std::uint32_t> piece = numbers_to(levels.distances().size());
    for (std::size_t sweep = 0; sweep < piece.size(); ++sweep)
      for (const Link& link : levels.links())
        piece[link.a] = piece[link.b] = std::min(piece[link.a], piece[link.b]);
    std::size_t pieces = 0;
    for (std::uint32_t i = 0; i < piece.size(); ++i) pieces += piece[i] == i;

    const Weights found = weights_of(cycles, levels, std::vector<double>(piece.size(), 1.0), 1.3);

    // Each hole gets back one contact.
    EXPECT_NEAR(std::accumulate(found.weights.begin(), found.weights.end(), 0.0),
                static_cast<double>(pieces), 1e-9)
        << trial;
    for (std::uint32_t i = 0; i < piece.size(); ++i)
      EXPECT_EQ(cycles.root_of(i), piece[i]) << trial;
    with_holes += levels.links().size() + pieces > piece.size() + levels.fillings().size();
    apart += pieces > 1;
  }
  EXPECT_GT(with_holes, 20);
  EXPECT_GT(apart, 10);
}

TEST(CycleWeights, DoNotDependOnTheUnitOfLength) {
  CycleWeights cycles;
  const std::vector<double> distances{0.1, 0.15, 0.2, 0.4, 0.45, 0.46, 0.7};
  const std::vector<double> energies{5.0, 4.0, 3.0, 2.0, 1.9, 1.8, 0.5};
  const Weights expected = weights_of(cycles, fan(distances), energies);

  for (const double unit : {0x1p-30, 0x1p40}) {  // powers of 2: not a bit is rounded otherwise
    std::vector<double> other = distances;
    for (double& distance : other) distance *= unit;
    const Weights found = weights_of(cycles, fan(other), energies, unit * kRange);
    EXPECT_EQ(found.weights, expected.weights);
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(unit * found.slopes[i], expected.slopes[i]);
  }
}

}  // namespace
}  // namespace plekton::test::cycle_weights_test
