// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/measures/region_measure.hpp"
#include "dynamics/simulation.hpp"

#include <vector>

namespace plekton::dynamics {

/// The grains of a simulation and their contacts in its last step, to be measured in any number of
/// regions (measures/region_measure.hpp):
///
///     const Sample sample(simulation);
///     const RegionMeasure inside = sample.measure(BallRegion{centre, radius});
///
/// Spheres of rigid bodies are walls. It keeps a copy of places and contacts, and refers to the
/// spheres of the simulation.
class Sample {
 public:
  explicit Sample(const Simulation& simulation);

  RegionMeasure measure(const geometry::Region& region) const {
    return measure_region(region, view_);
  }
  /// m, around the grains.
  geometry::Box box() const noexcept { return box_around(view_); }

  Sample(const Sample&) = delete;
  Sample& operator=(const Sample&) = delete;

 private:
  std::vector<Vec3> positions_;
  std::vector<contact::ContactRecord> contacts_;
  SampleView view_;
};

}  // namespace plekton::dynamics
