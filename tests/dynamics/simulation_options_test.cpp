// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/simulation_options.hpp"

#include "contact/models.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

namespace plekton::dynamics::simulation_options_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string problems_of(const SimulationOptions& options, const contact::ContactModel& model) {
  try {
    check(options, model);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(SimulationOptions, AreSoundAsTheyAreMade) {
  EXPECT_EQ(problems_of({}, contact::linear_frictional()), "");
}

TEST(SimulationOptions, AreToldOffForAllProblemsAtOnce) {
  SimulationOptions options;
  options.time_step = -1.0;
  options.motion.damping = 1.0;
  options.motion.gravity.z() = std::numeric_limits<double>::infinity();
  options.skin = std::numeric_limits<double>::quiet_NaN();
  options.threads = 0;
  EXPECT_THAT(problems_of(options, {}),
              AllOf(HasSubstr("time step -1 s: must be 0 (choose) or more"),
                    HasSubstr("numerical damping 1: must be at least 0 and below 1"),
                    HasSubstr("skin nan m"), HasSubstr("gravity is not finite"),
                    HasSubstr("contact model: is none"), HasSubstr("threads 0")));
}

}  // namespace
}  // namespace plekton::dynamics::simulation_options_test
