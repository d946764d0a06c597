// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrators/nodes_of_ranks.hpp"

#include "contact/sphere_sphere/shared_motion.hpp"

#include <utility>

namespace plekton::dynamics {

void NodesOfRanks::share(contact::SharedMotion* shared, std::vector<std::uint8_t> acted_on,
                         std::vector<std::uint8_t> planes) {
  shared_ = shared;
  if (shared_ == nullptr) return;
  shared_->keep_common(std::move(acted_on));
  shared_->keep_common_near(std::move(planes));
}

/// They are common from the next list on; that is made at once.
void NodesOfRanks::act_on(std::span<const NodeId> nodes) {
  if (shared_ == nullptr) return;
  know_all();
  shared_->keep_common(nodes);
}

bool NodesOfRanks::are_shared() const noexcept {
  return shared_ != nullptr && shared_->is_of_use();
}

contact::NodesInMotion NodesOfRanks::nodes() const noexcept {
  return {state_.position,    state_.velocity, state_.angular_velocity,
          state_.orientation, forces_.force,   forces_.torque};
}

void NodesOfRanks::tell_all() const {
  shared_->tell_all(nodes());
  knows_all_ = true;
}

void NodesOfRanks::found_forces() noexcept {
  knows_all_ = !are_shared();
}

StepWork NodesOfRanks::step(const NodeProperties& properties, const MotionOptions& options,
                            const StepLengths& lengths, geometry::ThreadPool& pool) {
  if (!are_shared())
    return leapfrog_.step(state_, forces_, properties, options, lengths, pool).total();
  const auto step_some = [&](std::span<const NodeId> some) {
    return leapfrog_.step_some(some, state_, forces_, properties, options, lengths, pool);
  };
  StepSums sums = step_some(shared_->common());
  const StepSums of_own = step_some(shared_->own());
  shared_->add_up(of_own, sums);
  shared_->tell_neighbours(nodes());
  knows_all_ = false;
  return sums.total();
}

}  // namespace plekton::dynamics
