// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/simulation_options.hpp"

#include "geometry/base/problems.hpp"
#include "geometry/base/vector_width.hpp"

#include <sstream>

namespace plekton::dynamics {

void check(const SimulationOptions& options, const contact::ContactModel& model) {
  geometry::vector_width();  // asked for in a way that cannot be: said here, not within a kernel
  std::ostringstream problems;
  if (!(options.time_step >= 0.0))
    problems << "time step " << options.time_step << " s: must be 0 (choose) or more\n";
  if (!(options.motion.damping >= 0.0 && options.motion.damping < 1.0)) {
    problems << "numerical damping " << options.motion.damping
             << ": must be at least 0 and below 1\n";
  }
  if (!(options.skin >= 0.0))
    problems << "skin " << options.skin << " m: must be 0 (choose) or more\n";
  if (!options.motion.gravity.allFinite()) problems << "gravity is not finite\n";
  if (!model) problems << "contact model: is none; models.hpp makes them\n";
  if (options.threads < 1) problems << "threads " << options.threads << ": must be at least 1\n";
  geometry::throw_if_any(problems);
}

}  // namespace plekton::dynamics
