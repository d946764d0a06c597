// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/structure/beam_bond.hpp"
#include "geometry/base/vector_width.hpp"
#include "tests/support/beam_structure.hpp"
#include "tests/support/seeded_random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

// Bonds side by side against the same formulas for one bond: the same bits.
namespace plekton::test::beam_kernel_test {
namespace {

using dynamics::BeamRow;
using dynamics::BeamSum;

const BeamSection kSection = dynamics::circular_section(0.2, 7.0, 0.25);

/// A row of bonds between nodes at random; some of the bonds share nodes.
class RandomRow {
 public:
  explicit RandomRow(unsigned seed) : random_(seed) {
    for (std::size_t i = 0; i < kNodes; ++i) scene_.add_node(random_.in_cube(3.0));
    for (std::size_t lane = 0; lane < BeamRow::kLanes; ++lane) {
      const std::size_t a = random_.index(kNodes);
      const std::size_t b = (a + 1 + random_.index(kNodes - 1)) % kNodes;
      scene_.add_beam(geometry::id_at<NodeId>(a), geometry::id_at<NodeId>(b), kSection, 1e3);
      set(lane);
    }
    for (std::size_t i = 0; i < kNodes; ++i) {
      scene_.state.position[i] += random_.in_cube(0.5);
      scene_.state.orientation[i] = Quat(random_.rotation());
    }
  }

  NodeState& state() { return scene_.state; }
  std::size_t node(std::size_t side, std::size_t lane) const { return row_.node(side, lane); }

  /// The sums of all nodes and the row after a step, W bonds at a time.
  template <int W>
  std::pair<std::vector<BeamSum>, BeamRow> stepped() const {
    std::pair<std::vector<BeamSum>, BeamRow> result{std::vector<BeamSum>(kNodes), row_};
    dynamics::advance_row<W>(result.second, scene_.state, result.first.data());
    return result;
  }
  std::pair<std::vector<BeamSum>, BeamRow> stepped_one_by_one() const {
    std::pair<std::vector<BeamSum>, BeamRow> result{std::vector<BeamSum>(kNodes), row_};
    for (std::size_t lane = 0; lane < BeamRow::kLanes; ++lane)
      dynamics::advance_one(result.second, lane, scene_.state, result.first.data());
    return result;
  }

 private:
  static constexpr std::size_t kNodes = 12;

  void set(std::size_t lane) {
    const BeamBond& bond = scene_.bonds[lane];
    row_.spring.set(lane, dynamics::spring_of(bond));
    for (std::size_t side = 0; side < 2; ++side) {
      row_.nodes[side][lane] = bond.nodes[side];
      row_.members[side][lane] = static_cast<std::uint32_t>(bond.nodes[side]);
    }
  }

  Random random_;
  Scene scene_;
  BeamRow row_{};
};

template <class Width>
class BeamLanes : public testing::Test {};
using Widths = testing::Types<geometry::Width<2>, geometry::Width<4>, geometry::Width<8>>;
TYPED_TEST_SUITE(BeamLanes, Widths);

template <class Result>
void expect_same_bits(const Result& lanes, const Result& one_by_one) {
  for (std::size_t i = 0; i < lanes.first.size(); ++i) {
    EXPECT_EQ(lanes.first[i].force, one_by_one.first[i].force);
    EXPECT_EQ(lanes.first[i].torque, one_by_one.first[i].torque);
  }
  for (std::size_t lane = 0; lane < BeamRow::kLanes; ++lane) {
    EXPECT_EQ(lanes.second.tension.number(lane), one_by_one.second.tension.number(lane));
    EXPECT_EQ(lanes.second.energy.number(lane), one_by_one.second.energy.number(lane));
  }
}

TYPED_TEST(BeamLanes, GiveTheBitsOfOneBondAfterTheOther) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const RandomRow row(seed);

    expect_same_bits(row.stepped<TypeParam::value>(), row.stepped_one_by_one());
  }
}

TYPED_TEST(BeamLanes, GiveTheBitsOfOneBondAfterTheOtherWhereNodesCoincide) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    RandomRow row(seed);
    const std::size_t lane = seed % BeamRow::kLanes;
    row.state().position[row.node(0, lane)] = row.state().position[row.node(1, lane)];

    const auto answer = row.stepped<TypeParam::value>();

    expect_same_bits(answer, row.stepped_one_by_one());
    EXPECT_TRUE(std::isfinite(answer.second.energy.number(lane)));
  }
}

}  // namespace
}  // namespace plekton::test::beam_kernel_test
