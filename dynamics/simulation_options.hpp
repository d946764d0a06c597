// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/contact_model.hpp"
#include "dynamics/integrators/leapfrog.hpp"

namespace plekton::dynamics {

struct SimulationOptions {
  double time_step = 0.0;  ///< s; 0 chooses one as it goes: kSafety times the critical step with
                           ///< the contacts of now and those that are near,
                           ///< shorter while something is fast (dynamics/time_step/motion_step.hpp)
  MotionOptions motion = {};
  double skin =
      0.0;  ///< m, how far apart a pair may be when it is listed; 0 begins with a fifth of
  ///< the smallest radius, then follows how fast spheres move
  int threads = 1;           ///< >= 1; results do not depend on it
  bool self_contact = true;  ///< whether a structure may touch itself where it folds
};

/// @throws std::invalid_argument listing every problem of the options, a model that is none, or
///         about the width of vectors (geometry/base/vector_width.hpp)
void check(const SimulationOptions& options, const contact::ContactModel& model);

}  // namespace plekton::dynamics
