// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step/spread_stiffness.hpp"

#include "geometry/base/state_archive.hpp"

#include <algorithm>
#include <cmath>

namespace plekton::dynamics {
namespace {

constexpr int kFirstProducts = 32;
constexpr int kProducts = 4;

/// A weight is that of one contact, or of a pass between two, but for the rounding of a force.
bool is_one(double weight) noexcept {
  constexpr double kRounding = 1e-6;
  return std::abs(std::abs(weight) - 1.0) <= kRounding;
}

double per_root_of_mass(const NodeProperties& properties, std::size_t i) noexcept {
  return holds_translation(properties.held[i]) ? 0.0 : 1.0 / std::sqrt(properties.mass[i]);
}

/// In [-1, 1), of a place in a sequence: the bits of a product with an odd number (Knuth's
/// multiplicative hashing).
double scattered(std::size_t i) noexcept {
  const auto bits = static_cast<std::uint64_t>(i + 1) * 0x9e3779b97f4a7c15U;
  return static_cast<double>(bits >> 11) * 0x1p-52 - 1.0;
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
    is_new_ = true;
    return false;
  }
  springs.leave_out_turning([&](NodeId ball) { return is_spread(ball); });
  takes_part_.assign(node_count, 0);
  springs.for_each_on_surface([&](const ContactStiffness&, std::span<const SpringEnd> ends) {
    if (!is_spread(ends[0].node)) return;
    for (const SpringEnd& end : ends) takes_part_[index_of(end.node)] = 1;
  });
  return true;
}

/// @returns how many products to take
int SpreadStiffness::start(const NodeProperties& properties) {
  const std::size_t count = properties.size();
  const bool is_first = is_new_ || motion_.size() != count;
  is_new_ = false;
  if (forces_.force.size() != count) forces_ = NodeForces(count);
  moved_.resize(count);
  product_.assign(count, Vec3::Zero());
  if (is_first) motion_.assign(count, Vec3::Zero());
  // What takes part anew has no motion yet: all get a small one beside that of the last look.
  const double part = is_first ? 1.0 : 0.1;
  double squared = 0.0;
  std::size_t parts = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (takes_part_[i] == 0) motion_[i].setZero();
    if (takes_part_[i] != 0) ++parts;
  }
  const double size = part / std::sqrt(3.0 * static_cast<double>(std::max<std::size_t>(parts, 1)));
  for (std::size_t i = 0; i < count; ++i) {
    if (takes_part_[i] == 0) continue;
    motion_[i] += size * Vec3(scattered(3 * i), scattered(3 * i + 1), scattered(3 * i + 2));
    squared += motion_[i].squaredNorm();
  }
  for (Vec3& motion : motion_) motion /= std::sqrt(squared);
  return is_first ? kFirstProducts : kProducts;
}

/// @returns the factor of the motion (m sqrt(kg)) that moves nodes by the difference at most
double SpreadStiffness::displace(const NodeProperties& properties, const Places& places,
                                 double sign) {
  double largest = 0.0;
  for (std::size_t i = 0; i < motion_.size(); ++i)
    largest = std::max(largest, per_root_of_mass(properties, i) * motion_[i].norm());
  const double step = largest > 0.0 ? places.difference / largest : 0.0;
  for (std::size_t i = 0; i < motion_.size(); ++i)
    moved_[i] = places.x[i] + (sign * step * per_root_of_mass(properties, i)) * motion_[i];
  for (std::size_t i = 0; i < rigid_->followed().size(); ++i) {
    const std::size_t mover = index_of(rigid_->mover_of(geometry::id_at<NodeId>(i)));
    if (mover != i) moved_[i] = places.x[i] + (moved_[mover] - places.x[mover]);
  }
  return step;
}

void SpreadStiffness::take_forces(double factor) {
  for (std::size_t i = 0; i < product_.size(); ++i)
    product_[index_of(rigid_->mover_of(geometry::id_at<NodeId>(i)))] += factor * forces_.force[i];
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
          product_[index_of(end.node)] -= (end.weight * signed_stiffness * way) * contact.normal;
      });
}

/// @returns 1/s², how long the product is
double SpreadStiffness::follow(const NodeProperties& properties) {
  double squared = 0.0;
  for (std::size_t i = 0; i < motion_.size(); ++i) {
    if (product_[i] != Vec3::Zero()) takes_part_[i] = 1;
    product_[i] *= per_root_of_mass(properties, i);
    squared += product_[i].squaredNorm();
  }
  const double length = std::sqrt(squared);
  for (std::size_t i = 0; i < motion_.size(); ++i) {
    if (length > 0.0) motion_[i] = product_[i] / length;
    product_[i].setZero();
  }
  return length;
}

void SpreadStiffness::add_rate(double rate, const NodeProperties& properties,
                               NodalStiffness& stiffness) const {
  for (std::size_t i = 0; i < takes_part_.size(); ++i) {
    if (takes_part_[i] != 0)
      stiffness.add(geometry::id_at<NodeId>(i), {rate * properties.mass[i], 0.0});
  }
}

void SpreadStiffness::exchange(const geometry::StateArchive& archive) {
  archive("is_new", is_new_);
  archive("motion", motion_);
}

}  // namespace plekton::dynamics
