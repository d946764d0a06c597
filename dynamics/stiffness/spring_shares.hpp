// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/stiffness/contact_springs.hpp"
#include "dynamics/stiffness/nodal_stiffness.hpp"

#include <span>
#include <vector>

namespace plekton::dynamics {

/// Puts the springs of a contact under springs that each hold a single node (NodalStiffness).
/// @param mobility  (place in ends) -> h of NodalStiffness
/// @param measure   (node) -> d of it
template <class MobilityOf, class MeasureOf>
void share_spring(NodalStiffness& stiffness, const ContactStiffness& contact,
                  std::span<const SpringEnd> ends, const MobilityOf& mobility,
                  const MeasureOf& measure) {
  NodalStiffness::Shares all;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const NodalStiffness::Shares own = mobility(i);
    const double d = measure(ends[i].node);
    all.normal += own.normal * d;
    all.tangential += own.tangential * d;
  }
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const NodalStiffness::Shares own = mobility(i);
    const double d = measure(ends[i].node);
    const double squared = ends[i].weight * ends[i].weight;
    const auto share = [&](double total, double part) {
      return part > 0.0 ? squared * total / (part * d) : 0.0;
    };
    stiffness.add_end(ends[i], contact,
                      {share(all.normal, own.normal), share(all.tangential, own.tangential)});
  }
}

/// How contacts are shared among their nodes for a bound that is hardly below the true limit.
///
/// NodalStiffness gives a bound for any positive d. Let N be the matrix of all springs with the
/// magnitudes of its entries, sum k h h^T with one entry for each node: for a scalar of each node
/// the bound is max_i (N d)_i / d_i, which is never below the largest eigenvalue of N and comes
/// down to it with d <- N d (Collatz 1942, Wielandt 1950). So a few such products are taken. They
/// give a node that much else holds less of each of its contacts, and more of it to its partners.
class SpringShares {
 public:
  /// Adds contacts to what structures and loads have added to all nodes. Linear in both; allocates
  /// only where there are more of them than ever before.
  void add(const ContactSprings& springs, const NodeProperties& properties,
           NodalStiffness& stiffness);

 private:
  void multiply(const ContactSprings& springs);

  std::vector<double> measure_;                   ///< d, by node
  std::vector<double> product_;                   ///< N d, by node
  std::vector<double> base_;                      ///< 1/s², of what is there already, by node
  std::vector<NodalStiffness::Shares> mobility_;  ///< h, by end
};

}  // namespace plekton::dynamics
