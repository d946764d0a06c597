// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/base/motion.hpp"
#include "dynamics/state/node_state.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

namespace plekton::dynamics {

/// More energy than this many times what there ever was is no error of integration any more.
///
/// With the largest time step that may be given, kLargestStep = 0.8 of the critical one, the sum of
/// kinetic and elastic energy of a stable oscillator changes by a factor of 1 / (1 - 0.8²) = 2.8 in
/// the course of an oscillation, and its kinetic energy as the leapfrog has it goes down to -1.8 of
/// their sum, which is constant. This is four times that.
constexpr double kFarMore = 10.0;

/// How a simulation has become meaningless.
struct Divergence {
  enum class Sign : std::uint8_t {
    motion,  ///< a node is nowhere any more, or moved further in a step than elements could notice
    spin,    ///< a node turned by half a turn or more in a step: it may as well turn the other way
    energy   ///< far more energy has come from nowhere than there ever was
  };
  Sign sign;
  NodeId node;         ///< that moves or spins; of energy, the one that has most of it
  double made = 0.0;   ///< J, of energy
  double there = 0.0;  ///< J, of energy: the most that was accounted for
};

/// The simulation has become meaningless. The message names step, time, node and position, how it
/// shows, which contact or element is at fault, and what to do.
class Diverged : public std::runtime_error {
 public:
  /// @param time   s, at the begin of the step
  /// @param state  after the step
  /// @param fault  who is at fault, and what to do
  Diverged(const Divergence& divergence, std::int64_t step, double time, const NodeState& state,
           const std::string& fault);

  std::int64_t step() const noexcept { return step_; }
  NodeId node() const noexcept { return divergence_.node; }
  const Divergence& divergence() const noexcept { return divergence_; }

 private:
  Divergence divergence_;
  std::int64_t step_;
};

/// The node that moved too far in the last step by the largest factor, or else the one that spins
/// fastest of those that spin too fast.
/// @param furthest  m, by node: what it may move in a step of dt (s), furthest_in_a_step()
std::optional<Divergence> find_runaway(const NodeState& state, std::span<const double> furthest,
                                       double dt);

/// The free node that has most kinetic energy; node 0 if none moves.
NodeId most_energetic(const NodeState& state, const NodeProperties& properties);

/// J, kinetic energy of all that is free if it moved as fast as what is prescribed does: about what
/// bodies have of a moving wall before the ledger knows of any work.
/// @param plane_speed  m/s, of the fastest plane
double prescribed_energy(const NodeState& state, const NodeProperties& properties,
                         double plane_speed);

}  // namespace plekton::dynamics
