// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/base/vector_width.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

namespace plekton::geometry::vector_width_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(VectorWidth, IsTheWidestUnlessAskedFor) {
  EXPECT_EQ(chosen_vector_width(std::nullopt, 8), 8);
  EXPECT_EQ(chosen_vector_width("", 4), 4);
}

TEST(VectorWidth, IsAsAskedForUpToTheWidest) {
  EXPECT_EQ(chosen_vector_width("2", 8), 2);
  EXPECT_EQ(chosen_vector_width("4", 8), 4);
  EXPECT_EQ(chosen_vector_width("8", 8), 8);
}

TEST(VectorWidth, ThatTheProcessorLacksIsRefusedByName) {
  EXPECT_THAT([] { chosen_vector_width("8", 4); },
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("PLEKTON_VECTOR_WIDTH"),
                                                         HasSubstr("no vectors of 8 numbers"),
                                                         HasSubstr("the widest here are of 4"))));
}

TEST(VectorWidth, ThatIsNotKnownIsRefusedByName) {
  for (const char* const asked : {"3", "16", "avx2", "-2", "2 ", "02"}) {
    EXPECT_THAT([&] { chosen_vector_width(asked, 8); },
                ThrowsMessage<std::invalid_argument>(
                    AllOf(HasSubstr("PLEKTON_VECTOR_WIDTH: \"" + std::string(asked) + '"'),
                          HasSubstr("2, 4 or 8"))));
  }
}

TEST(VectorWidth, OfTheProgramIsOneOfThose) {
  EXPECT_THAT(vector_width(), testing::AnyOf(2, 4, 8));
  EXPECT_LE(vector_width(), widest_vectors());
}

}  // namespace
}  // namespace plekton::geometry::vector_width_test
