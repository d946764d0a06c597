// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/stiffness/spring_shares.hpp"

#include <algorithm>

namespace plekton::dynamics {

void SpringShares::add(const ContactSprings& springs, const NodeProperties& properties,
                       NodalStiffness& stiffness) {
  constexpr int kProducts = 3;
  springs.for_each_single(
      [&](NodeId node, const IsotropicStiffness& single) { stiffness.add(node, single); });
  measure_.resize(properties.size());
  base_.resize(properties.size());
  product_.resize(properties.size());
  for (std::size_t i = 0; i < properties.size(); ++i) {
    const auto node = geometry::id_at<NodeId>(i);
    measure_[i] = stiffness.measure_of(node);
    base_[i] = stiffness.rate_of(node, properties);
  }
  mobility_.clear();
  springs.for_each(
      [&](const ContactStiffness& contact, std::span<const SpringEnd> ends, std::size_t) {
        for (const SpringEnd& end : ends)
          mobility_.push_back(stiffness.mobility_of(end, contact.normal));
      });
  for (int i = 0; i < kProducts; ++i) multiply(springs);
  springs.for_each(
      [&](const ContactStiffness& contact, std::span<const SpringEnd> ends, std::size_t first) {
        share_spring(
            stiffness, contact, ends, [&](std::size_t i) { return mobility_[first + i]; },
            [&](NodeId node) { return measure_[index_of(node)]; });
      });
}

/// d <- N d. A node that nothing holds keeps a part of what it has: its share in a contact must not
/// vanish.
void SpringShares::multiply(const ContactSprings& springs) {
  double largest = 0.0;  // 1/s², of N d / d
  for (std::size_t i = 0; i < measure_.size(); ++i) product_[i] = base_[i] * measure_[i];
  springs.for_each(
      [&](const ContactStiffness& contact, std::span<const SpringEnd> ends, std::size_t first) {
        double normal = 0.0;
        double tangential = 0.0;
        for (std::size_t i = 0; i < ends.size(); ++i) {
          const double d = measure_[index_of(ends[i].node)];
          normal += mobility_[first + i].normal * d;
          tangential += mobility_[first + i].tangential * d;
        }
        normal *= contact.normal_stiffness;
        tangential *= contact.tangential_stiffness;
        for (std::size_t i = 0; i < ends.size(); ++i) {
          product_[index_of(ends[i].node)] +=
              normal * mobility_[first + i].normal + tangential * mobility_[first + i].tangential;
        }
      });
  for (std::size_t i = 0; i < measure_.size(); ++i)
    largest = std::max(largest, product_[i] / measure_[i]);
  if (!(largest > 0.0)) return;
  constexpr double kLeast = 1e-3;
  for (std::size_t i = 0; i < measure_.size(); ++i)
    measure_[i] = std::max(product_[i] / largest, kLeast * measure_[i]);
}

}  // namespace plekton::dynamics
