// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/printable.hpp"

#include <gtest/gtest.h>

namespace plekton::geometry::printable_test {
namespace {

TEST(Printable, ShowsControlCharactersAndLeavesTheRestAsItIs) {
  EXPECT_EQ(printable("1 s\n\x1b[2J \x7f µm"), "1 s\\n\\x1b[2J \\x7f µm");
  EXPECT_EQ(printable(std::string(1, '\0')), "\\x00");
}

TEST(Printable, KeepsTheIndentedLinesOfOneMessage) {
  EXPECT_EQ(printable("mesh.off: refused\n  one\n  two"), "mesh.off: refused\n  one\n  two");
}

TEST(Printable, ChangesNothingTheSecondTime) {
  const std::string once = printable("a\tb\rc\n");

  EXPECT_EQ(printable(once), once);
}

}  // namespace
}  // namespace plekton::geometry::printable_test
