// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/rigid_motions.hpp"

#include "geometry/base/elementary.hpp"

#include <array>
#include <limits>

namespace plekton::apps {
namespace {

using geometry::index_of;

/// Vectors of three components.
constexpr std::array<dynamics::OutputField, 6> kMotionFields = {{
    {"position", "m", "of the centre of mass"},
    {"velocity", "m/s", "of the centre of mass"},
    {"turn", "rad", "rotation vector from the start, at most half a turn long"},
    {"angular_velocity", "rad/s", "mean of the last step"},
    {"force", "N", "of contacts and loads in the last step, weight not included"},
    {"torque", "N m", "of these about the centre of mass"},
}};

/// rad
Vec3 rotation_vector(const geometry::Quat& turn) {
  const double sign = turn.w() < 0.0 ? -1.0 : 1.0;
  const Vec3 half = sign * Vec3(turn.x(), turn.y(), turn.z());
  const double size = half.norm();
  if (!(size > 0.0)) return Vec3::Zero();
  return (2.0 * elementary::atan2(size, sign * turn.w()) / size) * half;
}

}  // namespace

std::span<const dynamics::OutputField> rigid_fields() {
  return kMotionFields;
}

RigidMotions::RigidMotions(const std::filesystem::path& folder, const BuiltScene& built,
                           const WrittenFiles* before) {
  HistoryColumns columns;
  for (const BuiltRigidBody& body : built.rigid_bodies) {
    references_.push_back(body.node);
    starts_.push_back(body.orientation);
    are_absent_.push_back(body.is_absent);
    columns.add_vectors(body.name, kMotionFields);
  }
  open(folder, kRigidBodiesFile, columns, before);
}

void RigidMotions::add(const dynamics::Simulation& simulation) {
  if (!is_open()) return;
  const dynamics::NodeState& state = simulation.state();
  std::vector<double> row{simulation.time()};
  const auto add_vector = [&](const Vec3& v) { row.insert(row.end(), v.data(), v.data() + 3); };
  for (std::size_t b = 0; b < references_.size(); ++b) {
    if (are_absent_[b]) {
      row.insert(row.end(), 3 * kMotionFields.size(), std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    const std::size_t i = index_of(references_[b]);
    add_vector(state.position[i]);
    add_vector(state.velocity[i]);
    add_vector(rotation_vector(state.orientation[i] * starts_[b].conjugate()));
    add_vector(state.angular_velocity[i]);
    add_vector(simulation.forces().force[i]);
    add_vector(simulation.forces().torque[i]);
  }
  add_row(row);
}

}  // namespace plekton::apps
