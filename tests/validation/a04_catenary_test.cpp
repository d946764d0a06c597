// SPDX-License-Identifier: GPL-3.0-or-later
// A4: a chain of 40 bars that may turn against each other hangs as a catenary: length 1.2 m over a
// span of 1 m.
#include "apps/validation/hanging_chain.hpp"

#include <gtest/gtest.h>

namespace plekton::test::a04_catenary_test {
namespace {

TEST(A04Catenary, AChainOf40LinksHangsAsOne) {
  const apps::HangingChain exact = apps::catenary(apps::kChainWeight);
  EXPECT_NEAR(exact.sag, 0.292344, 1e-6);
  EXPECT_NEAR(exact.pull, 0.231533, 1e-6);

  const apps::HangingChain chain = apps::hang_chain(40);

  std::printf("catenary: sag %.6f m, exact %.6f; pull %.6f N, exact %.6f\n", chain.sag, exact.sag,
              chain.pull, exact.pull);
  EXPECT_NEAR(chain.sag / exact.sag, 1.0, 1e-3);
  EXPECT_NEAR(chain.pull / exact.pull, 1.0, 1e-3);
}

}  // namespace
}  // namespace plekton::test::a04_catenary_test
