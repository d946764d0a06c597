// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step/spread_stiffness.hpp"

#include <cmath>

namespace plekton::dynamics {
namespace {

/// A weight is that of one contact, or of a saddle between two, but for the rounding of a force.
bool is_one(double weight) noexcept {
  constexpr double kRounding = 1e-6;
  return std::abs(std::abs(weight) - 1.0) <= kRounding;
}

}  // namespace

bool SpreadStiffness::begin(ContactSprings& springs, std::size_t node_count) {
  bool is_any = false;
  is_spread_.assign(node_count, 0);
  springs.for_each_on_surface(
      [&](const ContactStiffness& contact, std::span<const SpringEnd> ends) {
        if (is_one(contact.weight)) return;
        is_spread_[index_of(ends[0].node)] = 1;
        is_any = true;
      });
  if (!is_any) {
    motion_.forget();
    return false;
  }
  springs.leave_out_turning([&](NodeId ball) { return is_spread(ball); });
  motion_.begin(node_count);
  springs.for_each_on_surface([&](const ContactStiffness&, std::span<const SpringEnd> ends) {
    if (!is_spread(ends[0].node)) return;
    for (const SpringEnd& end : ends) motion_.add(index_of(end.node));
  });
  return true;
}

void SpreadStiffness::take_springs(const ContactSprings& springs,
                                   const NodeProperties& properties) {
  springs.for_each_on_surface(
      [&](const ContactStiffness& contact, std::span<const SpringEnd> ends) {
        if (!is_spread(ends[0].node)) return;
        double way = 0.0;
        for (const SpringEnd& end : ends) {
          const std::size_t i = index_of(end.node);
          way += end.weight * per_root_of_mass(properties, i) * contact.normal.dot(motion_[i]);
        }
        const double signed_stiffness =
            contact.elastic_stiffness() * contact.weight / std::max(1.0, std::abs(contact.weight));
        for (const SpringEnd& end : ends)
          motion_.add_to_product(index_of(end.node),
                                 -(end.weight * signed_stiffness * way) * contact.normal);
      });
}

void SpreadStiffness::add_rate(const NodeProperties& properties, NodalStiffness& stiffness) const {
  for (std::size_t i = 0; i < properties.size(); ++i) {
    if (motion_.has(i))
      stiffness.add(geometry::id_at<NodeId>(i), {motion_.rate(i) * properties.mass[i], 0.0});
  }
}

void SpreadStiffness::exchange(const geometry::StateArchive& archive) {
  motion_.exchange(archive);
}

}  // namespace plekton::dynamics
