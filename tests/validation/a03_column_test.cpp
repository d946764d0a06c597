// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/column.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace plekton::test {
namespace {

// Euler: P = pi² E I / L².
TEST(A03Column, BucklesAtTheForceOfEuler) {
  const BeamSection section = dynamics::circular_section(0.02, 1e9, 0.25);
  const Scene column = chain(20, 1.0, section);
  const double euler =
      std::numbers::pi * std::numbers::pi * section.young_modulus * section.second_moment;

  EXPECT_TRUE(is_stable(column, 0.985 * euler));
  EXPECT_FALSE(is_stable(column, 1.015 * euler));
}

}  // namespace
}  // namespace plekton::test
