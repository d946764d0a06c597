// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/mean_node_masses.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace plekton::contact::structure::mean_node_masses_test {
namespace {

using geometry::Cylinder;
using geometry::id_at;
using geometry::NodeId;

constexpr double kHeld = std::numeric_limits<double>::infinity();

/// Bars between nodes 0 and 1, and between 2 and 3.
geometry::Surface two_bars() {
  const auto bar = [](std::size_t a, std::size_t b) {
    return Cylinder{{id_at<NodeId>(a), id_at<NodeId>(b)}, 0.1};
  };
  return geometry::Surface(std::vector{bar(0, 1), bar(2, 3)}, {}, 4);
}

TEST(MeanNodeMasses, AreThoseOfTheNodesThatMove) {
  const std::vector<double> masses = {2.0, 4.0, kHeld, 3.0};

  EXPECT_THAT(mean_node_masses(two_bars(), masses), testing::ElementsAre(3.0, 3.0));
}

TEST(MeanNodeMasses, AreInfiniteWhereNoNodeMoves) {
  const std::vector<double> masses = {2.0, 4.0, kHeld, kHeld};

  EXPECT_THAT(mean_node_masses(two_bars(), masses), testing::ElementsAre(3.0, kHeld));
  EXPECT_THAT(mean_node_masses(two_bars(), {}), testing::ElementsAre(kHeld, kHeld));
}

}  // namespace
}  // namespace plekton::contact::structure::mean_node_masses_test
