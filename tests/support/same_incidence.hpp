// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/primitives/elements.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace plekton::test {

/// That two surfaces have the same features and cells, and the same features and cells around each
/// of them. Numbers of structures may differ.
inline void expect_same_incidence(const geometry::Surface& a, const geometry::Surface& b) {
  using namespace geometry;
  ASSERT_EQ(a.node_count(), b.node_count());
  ASSERT_EQ(a.face_count(), b.face_count());
  ASSERT_EQ(a.edge_count(), b.edge_count());
  ASSERT_EQ(a.cell_count(), b.cell_count());
  for (std::size_t e = 0; e < a.edge_count(); ++e) {
    const auto edge = id_at<EdgeId>(e);
    EXPECT_EQ(a.nodes_of(edge), b.nodes_of(edge));
    EXPECT_TRUE(std::ranges::equal(a.faces_of(edge), b.faces_of(edge)));
    EXPECT_EQ(a.owner_of(edge), b.owner_of(edge));
  }
  for (std::size_t f = 0; f < a.face_count(); ++f) {
    EXPECT_EQ(a.nodes_of(id_at<FaceId>(f)), b.nodes_of(id_at<FaceId>(f)));
    EXPECT_EQ(a.edges_of(id_at<FaceId>(f)), b.edges_of(id_at<FaceId>(f)));
  }
  for (std::size_t c = 0; c < a.cell_count(); ++c)
    EXPECT_EQ(a.feature_of(id_at<CellId>(c)), b.feature_of(id_at<CellId>(c)));
  for (std::size_t n = 0; n < a.node_count(); ++n) {
    const auto node = id_at<NodeId>(n);
    EXPECT_TRUE(std::ranges::equal(a.edges_of(node), b.edges_of(node)));
    EXPECT_TRUE(std::ranges::equal(a.faces_of(node), b.faces_of(node)));
    EXPECT_EQ(a.structure_of(node) == StructureId{-1}, b.structure_of(node) == StructureId{-1});
    if (a.edges_of(node).empty() || b.edges_of(node).empty()) continue;
    EXPECT_EQ(a.owner_of(node), b.owner_of(node));
    EXPECT_EQ(a.radius(a.structure_of(node)), b.radius(b.structure_of(node)));
  }
}

}  // namespace plekton::test
