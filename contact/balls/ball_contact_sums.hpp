// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/balls/ball_contacts.hpp"

/// From the sums of blocks to the forces of nodes.
namespace plekton::contact {

template <ContactLaw Law>
void BallContacts<Law>::hand_over(const BallBlocks::Block& block, const Work& work,
                                  NodeForces& forces) {
  constexpr std::size_t kAhead = 16;
  const auto owned = blocks_.owned(block);
  const BallSum* const sums = work.sums.data();
  for (std::size_t m = 0; m < owned.size(); ++m) {
    const std::size_t ahead = index_of(owned[std::min(m + kAhead, owned.size() - 1)].node);
    __builtin_prefetch(&forces.force[ahead], 1);
    __builtin_prefetch(&forces.torque[ahead], 1);
    forces.force[index_of(owned[m].node)] = sums[m].force;
    forces.torque[index_of(owned[m].node)] = sums[m].torque;
  }
  std::copy_n(sums + owned.size(), block.borrowed(), lent_.begin() + block.first_borrowed);
}

template <ContactLaw Law>
void BallContacts<Law>::set_others_zero(NodeForces& forces, geometry::ThreadPool& pool) const {
  if (blocks_.other_nodes().empty()) return;
  pool.for_each_range(forces.force.size(), [&](std::size_t begin, std::size_t end, int) {
    for (const BallBlocks::NodeRange& range : blocks_.other_nodes()) {
      const std::size_t first = std::max(begin, range.begin);
      const std::size_t last = std::min(end, range.end);
      if (first < last) forces.set_zero(first, last);
    }
  });
}

template <ContactLaw Law>
void BallContacts<Law>::return_loans(NodeForces& forces, geometry::ThreadPool& pool) const {
  const auto add = [&](NodeId node, std::size_t borrowed) {
    forces.force[index_of(node)] += lent_[borrowed].force;
    forces.torque[index_of(node)] += lent_[borrowed].torque;
  };
  const auto ask = [&](NodeId node, std::size_t borrowed) {
    __builtin_prefetch(&lent_[borrowed]);
    __builtin_prefetch(&forces.force[index_of(node)]);
    __builtin_prefetch(&forces.torque[index_of(node)]);
  };
  pool.for_each_range(blocks_.blocks().size(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t k = begin; k < end; ++k) blocks_.for_each_loan(k, add, ask);
  });
}

}  // namespace plekton::contact
