// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/time_step/stiffest_motion.hpp"

#include "geometry/base/state_archive.hpp"

#include <algorithm>
#include <cmath>

namespace plekton::dynamics {
namespace {

constexpr int kFirstProducts = 32;

/// In [-1, 1), of a place in a sequence: the bits of a product with an odd number (Knuth's
/// multiplicative hashing).
double scattered(std::size_t i) noexcept {
  const auto bits = static_cast<std::uint64_t>(i + 1) * 0x9e3779b97f4a7c15U;
  return static_cast<double>(bits >> 11) * 0x1p-52 - 1.0;
}

}  // namespace

double per_root_of_mass(const NodeProperties& properties, std::size_t node) noexcept {
  return holds_translation(properties.held[node]) ? 0.0 : 1.0 / std::sqrt(properties.mass[node]);
}

int StiffestMotion::start(const NodeProperties& properties, int next) {
  const std::size_t count = properties.size();
  const bool is_first = is_new_ || motion_.size() != count;
  is_new_ = false;
  if (forces_.force.size() != count) forces_ = NodeForces(count);
  moved_.resize(count);
  product_.assign(count, Vec3::Zero());
  rates_.assign(part_count_, 0.0);
  if (is_first) motion_.assign(count, Vec3::Zero());
  // What takes part anew has no motion yet: all get a small one beside that of the last look.
  const double share = is_first ? 1.0 : 0.1;
  sums_.assign(part_count_, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    if (takes_part_[i] == 0) motion_[i].setZero();
    if (takes_part_[i] != 0) sums_[part_[i]] += 1.0;
  }
  steps_.assign(part_count_, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    if (takes_part_[i] == 0) continue;
    const double size = share / std::sqrt(3.0 * sums_[part_[i]]);
    motion_[i] += size * Vec3(scattered(3 * i), scattered(3 * i + 1), scattered(3 * i + 2));
    steps_[part_[i]] += motion_[i].squaredNorm();
  }
  for (std::size_t i = 0; i < count; ++i)
    if (takes_part_[i] != 0) motion_[i] /= std::sqrt(steps_[part_[i]]);
  return is_first ? kFirstProducts : next;
}

bool StiffestMotion::find_steps(const NodeProperties& properties, double difference) {
  steps_.assign(part_count_, 0.0);
  for (std::size_t i = 0; i < motion_.size(); ++i) {
    double& largest = steps_[part_[i]];
    largest = std::max(largest, per_root_of_mass(properties, i) * motion_[i].norm());
  }
  bool is_any = false;
  for (double& step : steps_) {
    is_any = is_any || step > 0.0;
    step = step > 0.0 ? difference / step : 0.0;
  }
  return is_any;
}

void StiffestMotion::displace(const NodeProperties& properties, geometry::Positions x,
                              double sign) {
  for (std::size_t i = 0; i < motion_.size(); ++i)
    moved_[i] = x[i] + (sign * steps_[part_[i]] * per_root_of_mass(properties, i)) * motion_[i];
  for (std::size_t i = 0; i < rigid_->followed().size(); ++i) {
    const std::size_t mover = index_of(rigid_->mover_of(geometry::id_at<NodeId>(i)));
    if (mover != i) moved_[i] = x[i] + (moved_[mover] - x[mover]);
  }
}

void StiffestMotion::take_forces(double factor) {
  for (std::size_t i = 0; i < product_.size(); ++i) {
    const std::size_t mover = index_of(rigid_->mover_of(geometry::id_at<NodeId>(i)));
    const double step = steps_[part_[mover]];
    if (step > 0.0) product_[mover] += (factor / step) * forces_.force[i];
  }
}

void StiffestMotion::follow(const NodeProperties& properties) {
  sums_.assign(part_count_, 0.0);
  for (std::size_t i = 0; i < motion_.size(); ++i) {
    if (product_[i] != Vec3::Zero()) takes_part_[i] = 1;
    product_[i] *= per_root_of_mass(properties, i);
    sums_[part_[i]] += product_[i].squaredNorm();
  }
  for (std::size_t part = 0; part < sums_.size(); ++part) rates_[part] = std::sqrt(sums_[part]);
  for (std::size_t i = 0; i < motion_.size(); ++i) {
    const double length = rates_[part_[i]];
    if (length > 0.0) motion_[i] = product_[i] / length;
    product_[i].setZero();
  }
}

void StiffestMotion::exchange(const geometry::StateArchive& archive) {
  archive("is_new", is_new_);
  archive("motion", motion_);
}

}  // namespace plekton::dynamics
