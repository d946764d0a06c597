// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/spanning_weights.hpp"

#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace plekton::contact {
namespace {

using test::Random;

/// Number of trees a set of links makes of the basins; -1 if it holds a ring.
int tree_count(std::uint32_t vertex_count, const std::vector<Link>& links, unsigned chosen) {
  std::vector<std::uint32_t> root(vertex_count);
  std::iota(root.begin(), root.end(), 0U);
  const auto find = [&](std::uint32_t i) {
    while (root[i] != i) i = root[i];
    return i;
  };
  int count = static_cast<int>(vertex_count);
  for (std::size_t i = 0; i < links.size(); ++i) {
    if ((chosen >> i & 1U) == 0) continue;
    const auto a = find(links[i].a);
    const auto b = find(links[i].b);
    if (a == b) return -1;
    root[a] = b;
    --count;
  }
  return count;
}

/// Probability of each link to be in a spanning forest, by going through all forests in long
/// double.
std::vector<double> enumerated(std::uint32_t vertex_count, const std::vector<Link>& links) {
  int fewest = static_cast<int>(vertex_count);
  for (unsigned chosen = 0; chosen < 1U << links.size(); ++chosen) {
    const int trees = tree_count(vertex_count, links, chosen);
    if (trees > 0) fewest = std::min(fewest, trees);
  }
  std::vector<long double> with(links.size(), 0.0L);
  long double all = 0.0L;
  for (unsigned chosen = 0; chosen < 1U << links.size(); ++chosen) {
    if (tree_count(vertex_count, links, chosen) != fewest) continue;
    long double product = 1.0L;
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (chosen >> i & 1U) product *= 1.0L / static_cast<long double>(links[i].resistance);
    }
    all += product;
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (chosen >> i & 1U) with[i] += product;
    }
  }
  std::vector<double> weights;
  for (const long double w : with) weights.push_back(static_cast<double>(w / all));
  return weights;
}

/// Links with resistances from 1 to a power of 10.
std::vector<Link> random_links(Random& random, std::uint32_t vertex_count, int count,
                               double power) {
  std::vector<Link> links;
  for (int i = 0; i < count; ++i) {
    links.push_back({static_cast<std::uint32_t>(random.index(vertex_count)),
                     static_cast<std::uint32_t>(random.index(vertex_count)),
                     std::pow(10.0, random.uniform(0.0, power))});
  }
  return links;
}

TEST(SpanningWeights, AreTheProbabilitiesOfTheLinksInARandomSpanningForest) {
  Random random(1);
  SpanningWeights spanning;
  for (int trial = 0; trial < 400; ++trial) {
    const auto vertex_count = static_cast<std::uint32_t>(random.integer(1, 6));
    const auto links = random_links(random, vertex_count, random.integer(0, 11), 2.0);

    const auto weights = spanning.find(vertex_count, links);

    const auto expected = enumerated(vertex_count, links);
    for (std::size_t i = 0; i < links.size(); ++i) ASSERT_NEAR(weights[i], expected[i], 1e-13);
  }
}

TEST(SpanningWeights, StayAccurateForExtremeRatiosOfResistance) {
  Random random(2);
  SpanningWeights spanning;
  for (int trial = 0; trial < 400; ++trial) {
    const auto vertex_count = static_cast<std::uint32_t>(random.integer(2, 5));
    const auto links = random_links(random, vertex_count, random.integer(2, 10), 24.0);

    const auto weights = spanning.find(vertex_count, links);

    const auto expected = enumerated(vertex_count, links);
    for (std::size_t i = 0; i < links.size(); ++i) ASSERT_NEAR(weights[i], expected[i], 1e-13);
  }
}

TEST(SpanningWeights, AddUpToVerticesMinusComponents) {
  Random random(3);
  SpanningWeights spanning;
  for (int trial = 0; trial < 200; ++trial) {
    const auto vertex_count = static_cast<std::uint32_t>(random.integer(1, 60));
    const auto links = random_links(random, vertex_count, random.integer(0, 150), 12.0);

    const auto weights = spanning.find(vertex_count, links);

    std::vector<bool> is_root(vertex_count, false);
    for (std::uint32_t i = 0; i < vertex_count; ++i) is_root[spanning.root_of(i)] = true;
    const auto components = std::count(is_root.begin(), is_root.end(), true);
    EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0),
                static_cast<double>(vertex_count - components), 1e-12 * vertex_count);
    for (const double weight : weights) {
      EXPECT_GE(weight, 0.0);
      EXPECT_LE(weight, 1.0);
    }
  }
}

TEST(SpanningWeights, AreExactlyOneWhereNoRingCloses) {
  SpanningWeights spanning;
  const std::vector<Link> tree{{2, 5, 1e30}, {0, 1, 0.9}, {1, 2, 1e6}, {3, 4, 0.0}};

  const auto weights = spanning.find(6, tree);

  EXPECT_EQ(std::vector<double>(weights.begin(), weights.end()), std::vector<double>(4, 1.0));
  EXPECT_EQ(spanning.root_of(5), 0U);
  EXPECT_EQ(spanning.root_of(4), 3U);
}

TEST(SpanningWeights, GiveABridgeBesideARingExactlyOne) {
  SpanningWeights spanning;
  const std::vector<Link> links{{0, 1, 1.0}, {1, 2, 0.9}, {2, 0, 0.8}, {2, 3, 100.0}};

  const auto weights = spanning.find(4, links);

  EXPECT_EQ(weights[3], 1.0);
}

TEST(SpanningWeights, ShareASymmetricRingEvenly) {
  SpanningWeights spanning;
  for (const std::uint32_t n : {2U, 3U, 12U, 96U}) {
    std::vector<Link> ring;
    for (std::uint32_t i = 0; i < n; ++i) ring.push_back({i, (i + 1) % n, 0.01});

    const auto weights = spanning.find(n, ring);

    for (const double weight : weights) EXPECT_NEAR(weight, 1.0 - 1.0 / n, 1e-14);
  }
}

TEST(SpanningWeights, LeaveOutAPassThatIsAboutToLeaveTheRange) {
  SpanningWeights spanning;
  const std::vector<Link> ring{{0, 1, 1.0}, {1, 2, 4.0}, {2, 0, 1e18}};

  const auto weights = spanning.find(3, ring);

  EXPECT_NEAR(weights[0], 1.0, 2e-18 + 1e-16);
  EXPECT_NEAR(weights[1], 1.0, 4e-18 + 1e-16);
  EXPECT_NEAR(weights[2], 0.0, 1e-16);
}

TEST(SpanningWeights, GiveALoopNothing) {
  SpanningWeights spanning;
  const std::vector<Link> links{{0, 0, 1.0}, {0, 1, 2.0}};

  const auto weights = spanning.find(2, links);

  EXPECT_EQ(weights[0], 0.0);
  EXPECT_EQ(weights[1], 1.0);
}

TEST(SpanningWeights, TreatTheBranchesOfAPassAlike) {
  // A pass (3) above three minima, and another way round between two of them.
  SpanningWeights spanning;
  for (std::uint32_t first = 0; first < 3; ++first) {
    std::vector<Link> links{{first, (first + 1) % 3, 0.8}, {0, 3, 2.0}, {1, 3, 2.0}, {2, 3, 2.0}};

    const auto weights = spanning.find(4, links);

    const auto expected = enumerated(4, links);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(weights[i], expected[i], 1e-15);
    EXPECT_EQ(weights[1 + (first + 2) % 3], 1.0);
    EXPECT_NEAR(weights[1 + first], weights[1 + (first + 1) % 3], 1e-15);
  }
}

TEST(SpanningWeights, NeverCutALinkWithoutResistanceOfARingThatHasSome) {
  SpanningWeights spanning;
  const std::vector<Link> ring{{0, 1, 0.0}, {1, 2, 0.0}, {2, 0, 3.0}};

  const auto weights = spanning.find(3, ring);

  EXPECT_EQ(weights[0], 1.0);
  EXPECT_EQ(weights[1], 1.0);
  EXPECT_EQ(weights[2], 0.0);
}

TEST(SpanningWeights, ShareEvenlyWhereNoLinkOfARingHasAnyResistance) {
  SpanningWeights spanning;
  const std::vector<Link> ring{{0, 1, 0.0}, {1, 2, 0.0}, {2, 0, 0.0}};

  for (const double weight : spanning.find(3, ring)) EXPECT_NEAR(weight, 2.0 / 3.0, 1e-15);
}

TEST(LinkResistance, AddsUpAlongTheWayDown) {
  const double upper = 0.01;
  const double whole = link_resistance(upper, 0.05);

  EXPECT_NEAR(link_resistance(upper, 0.02) + link_resistance(upper + 0.02, 0.03), whole,
              1e-15 * whole);
  EXPECT_DOUBLE_EQ(whole, 1.0 / (0.01 * 0.01) - 1.0 / (0.06 * 0.06));
  EXPECT_EQ(link_resistance(upper, 0.0), 0.0);
}

}  // namespace
}  // namespace plekton::contact
