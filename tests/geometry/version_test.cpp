// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/version.hpp"

#include <gtest/gtest.h>

namespace {

TEST(Version, IsThatOfTheBuild) {
  EXPECT_EQ(plekton::kVersion, PLEKTON_PROJECT_VERSION);
}

}  // namespace
