// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace plekton::test {

/// Frequency (1/s) of a mode that swings along z, from seven zeros of its part in the motion.
/// @param simulation  just begun, with velocities near those of the mode
/// @param shape       kg, by node, near the mode times the mass: sorts out what other modes do
template <class AnySimulation>
double frequency_of_swing(AnySimulation& simulation, const std::vector<double>& shape) {
  double before = 0.0, first = 0.0;
  for (int zeros = 0;;) {
    simulation.step();
    double now = 0.0;
    for (std::size_t i = 0; i < shape.size(); ++i)
      now += shape[i] * simulation.state().position[i].z();
    if (before != 0.0 && (now > 0.0) != (before > 0.0)) {
      const double time = simulation.time() - simulation.time_step() * now / (now - before);
      if (zeros == 0) first = time;
      if (++zeros == 7) return 3.0 / (time - first);
    }
    before = now;
  }
}

}  // namespace plekton::test
