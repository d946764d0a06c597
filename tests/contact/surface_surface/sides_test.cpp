// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/surface_surface/sides.hpp"

#include <gtest/gtest.h>

#include <array>

namespace plekton::contact::structure::sides_test {
namespace {

const Sides kSame{}, kCrossed(true);

TEST(Sides, GoFirstWithFirstWhereNothingIsSaid) {
  int a = 1, b = 2;
  EXPECT_EQ(&kSame.first(a, b), &a);
  EXPECT_EQ(&kSame.second(a, b), &b);
  EXPECT_EQ(kSame.sign(), 1.0);
}

TEST(Sides, ThatAreCrossedGoFirstWithSecondAndPointBack) {
  int a = 1, b = 2;
  EXPECT_EQ(&kCrossed.first(a, b), &b);
  EXPECT_EQ(&kCrossed.second(a, b), &a);
  EXPECT_EQ(kCrossed.sign(), -1.0);
}

// The axioms of the group of two elements, over all there are.
TEST(Sides, FormAGroup) {
  for (const Sides p : {kSame, kCrossed}) {
    EXPECT_EQ(p.with(kSame), p);
    EXPECT_EQ(p.with(p), kSame);
    for (const Sides q : {kSame, kCrossed}) {
      EXPECT_EQ(p.with(q), q.with(p));
      EXPECT_EQ(p.with(q).sign(), p.sign() * q.sign());
      for (const Sides r : {kSame, kCrossed}) EXPECT_EQ(p.with(q).with(r), p.with(q.with(r)));
    }
  }
}

// Features of a term go with cells so, and these with a patch so.
TEST(Sides, OfOneThingWithAThirdAreFoundByWayOfTheSecond) {
  const std::array<char, 2> of_term{'x', 'y'};
  for (const Sides with_cells : {kSame, kCrossed}) {
    const std::array<char, 2> by_cells{with_cells.first(of_term[0], of_term[1]),
                                       with_cells.second(of_term[0], of_term[1])};
    for (const Sides of_cells : {kSame, kCrossed}) {
      const Sides direct = with_cells.with(of_cells);
      EXPECT_EQ(direct.first(of_term[0], of_term[1]), of_cells.first(by_cells[0], by_cells[1]));
      EXPECT_EQ(direct.second(of_term[0], of_term[1]), of_cells.second(by_cells[0], by_cells[1]));
    }
  }
}

}  // namespace
}  // namespace plekton::contact::structure::sides_test
