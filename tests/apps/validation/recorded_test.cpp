// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/validation/recorded.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace plekton::apps::recorded_test {
namespace {

TEST(RecordedCurve, IsOfTheRowsBelowCommentsAndHeads) {
  const auto [x, y] = read_recorded("# from where\n# more\na (s),b (m)\n0,1.5\n2e-3,-4\n");

  EXPECT_EQ(x, (std::vector<double>{0.0, 2e-3}));
  EXPECT_EQ(y, (std::vector<double>{1.5, -4.0}));
}

TEST(RecordedCurve, OfTextThatIsNoTableIsRefused) {
  EXPECT_THROW(read_recorded("a,b\n1;2\n"), std::logic_error);
  EXPECT_THROW(read_recorded("a,b\n1,two\n"), std::logic_error);
  EXPECT_THROW(recorded_curve("nothing"), std::logic_error);
}

// The acceleration of a sphere that rolls down 10 degrees is 5/7 g sin(10 deg) = 1.2168 m/s2.
TEST(RecordedCurve, HasWhatWasRecorded) {
  const Curve curve = recorded_curve("yade_rolling");

  ASSERT_GT(curve.x.size(), 20U);
  EXPECT_EQ(curve.x.size(), curve.y.size());
  EXPECT_NEAR(2.0 * curve.y.back() / (curve.x.back() * curve.x.back()), 1.2168, 1e-3);
}

}  // namespace
}  // namespace plekton::apps::recorded_test
