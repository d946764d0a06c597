// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/time_step/step_limits.hpp"

#include <cstddef>

namespace plekton::dynamics {

/// A mean of magnitudes; 0 of none.
class MeanMagnitude {
 public:
  void add(double magnitude) noexcept {
    sum_ += magnitude;
    ++count_;
  }
  double value() const noexcept { return count_ > 0 ? sum_ / static_cast<double>(count_) : 0.0; }

 private:
  double sum_ = 0.0;
  std::size_t count_ = 0;
};

/// N, mean magnitude of the forces between bodies and within structures: of contacts, bonds and
/// ties, and of sheet facets on their corners. What is broken or not there does not count.
/// @param then  the nodes when the forces of the last step were found
double mean_carried(const Resistance& of, const NodeState& then);

}  // namespace plekton::dynamics
