// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/stage_watch.hpp"

#include "apps/run/reactions.hpp"
#include "apps/scene/node_set.hpp"
#include "dynamics/loads/plane_servo.hpp"
#include "dynamics/loads/rigid_servo.hpp"
#include "geometry/base/state_archive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace plekton::apps {
namespace {

using geometry::index_of;
using geometry::NodeId;

/// In a row: a force that swings through the wanted one has not reached it, and a few grains that
/// strike hard make the mean force that contacts carry large for a moment.
constexpr int kLooksWithin = 10;

struct ServoForce {
  double felt = 0.0;    ///< N, along the normal
  double wanted = 0.0;  ///< N, at the end of its factor
};

ServoForce servo_force(const ServoEnd& end, const dynamics::Simulation& simulation) {
  const dynamics::Scene& scene = simulation.scene();
  if (end.body_servo) {
    const dynamics::BodyServo& servo = scene.loads.body_servos[*end.body_servo];
    const Vec3 direction = dynamics::DrivenBodies::direction_of(servo);
    return {0.0 - simulation.gathered_force(servo.body).dot(direction),
            servo.factor.rows().back().value * (servo.force + servo.pressure * servo.area)};
  }
  const auto servo = std::find_if(scene.loads.servos.begin(), scene.loads.servos.end(),
                                  [&](const auto& one) { return one.plane == end.plane; });
  const contact::Plane& plane = scene.planes[end.plane];
  return {0.0 - simulation.plane_reaction(end.plane).force.dot(plane.normal),
          servo->factor.rows().back().value *
              (servo->force + servo->pressure * dynamics::plate_area(*servo, scene.planes))};
}

bool is_within(const ServoForce& force, double tolerance) {
  return std::abs(force.felt - force.wanted) <= tolerance * std::abs(force.wanted);
}

/// m
Vec3 mean_place(const std::vector<NodeId>& nodes, const std::vector<Vec3>& positions) {
  Vec3 sum = Vec3::Zero();
  for (const NodeId node : nodes) sum += positions[index_of(node)];
  return sum / static_cast<double>(nodes.size());
}

}  // namespace

/// m
double StageWatch::moved(const DisplacementEnd& end, const dynamics::Simulation& simulation) const {
  if (!end.nodes) return (simulation.planes()[end.plane].point - start_.planes[end.plane]).norm();
  return (mean_place(built_.moved_nodes, simulation.state().position) -
          mean_place(built_.moved_nodes, start_.positions))
      .norm();
}

double StageWatch::strain_of(const StrainEnd& end, const dynamics::Simulation& simulation) const {
  const auto [a, b] = end.of;
  Vec3 before, now, normal;  // from a to b
  if (end.are_rigid_bodies) {
    const std::size_t node_a = index_of(rigid_body_of(a, built_).node);
    const std::size_t node_b = index_of(rigid_body_of(b, built_).node);
    const auto& positions = simulation.state().position;
    before = start_.positions[node_b] - start_.positions[node_a];
    now = positions[node_b] - positions[node_a];
    normal = before.normalized();
  } else {
    const auto& planes = simulation.planes();
    before = start_.planes[b] - start_.planes[a];
    now = planes[b].point - planes[a].point;
    normal = planes[a].normal;
  }
  return std::abs(normal.dot(now - before) / normal.dot(before));
}

/// N
double StageWatch::force_of(const ForceEnd& end, const dynamics::Simulation& simulation) const {
  const auto reaction =
      std::find_if(built_.reactions.begin(), built_.reactions.end(),
                   [&](const BuiltReaction& one) { return one.name == end.reaction; });
  std::vector<contact::ContactRecord> contacts;
  if (reaction->kind == ReactionKind::contacts) contacts = simulation.contact_rows();
  return reaction_in(simulation, *reaction, contacts).value.force[end.axis];
}

bool StageWatch::is_beyond(const ForceEnd& end, const dynamics::Simulation& simulation) const {
  const double force = force_of(end, simulation);
  return end.is_above ? force > end.force : force < end.force;
}

/// @param seen  of it in this stage; noted here
bool StageWatch::counts(bool holds, Seen& seen, double time) const {
  seen.in_a_row = holds ? seen.in_a_row + 1 : 0;
  if (!holds) seen.was_off = true;
  if (seen.in_a_row < kLooksWithin) return false;
  return stage_.end.after ? time >= start_.time + *stage_.end.after : seen.was_off;
}

std::string StageWatch::look(const dynamics::Simulation& simulation) {
  const StageEnd& end = stage_.end;
  const double time = simulation.time();
  if (end.servo &&
      counts(is_within(servo_force(*end.servo, simulation), end.servo->tolerance), servo_, time))
    return "servo";
  if (end.kinetic_energy &&
      counts(simulation.energy().kinetic < *end.kinetic_energy, kinetic_energy_, time))
    return "kinetic_energy";
  if (end.unbalanced_force &&
      counts(simulation.unbalanced_force_ratio() < *end.unbalanced_force, unbalanced_, time))
    return "unbalanced_force";
  if (end.force && counts(is_beyond(*end.force, simulation), force_, time)) return "force";
  if (end.displacement && moved(*end.displacement, simulation) >= end.displacement->distance)
    return "displacement";
  if (end.strain && strain_of(*end.strain, simulation) >= end.strain->strain) return "strain";
  return "";
}

std::string StageWatch::end_in_time(const dynamics::Simulation& simulation) const {
  if (stage_.end.duration) return "duration";
  throw StageFailed(fmt::format(
      "{}: has not ended within its max_duration of {:.6g} s: {}; give it longer, or an end that "
      "it "
      "can reach; the stages before it are kept, with checkpoints: go on from one of them with "
      "--from",
      stage_.path, *stage_.max_duration, state_of_ends(simulation)));
}

std::string StageWatch::state_of_ends(const dynamics::Simulation& simulation) const {
  const StageEnd& end = stage_.end;
  std::vector<std::string> all;
  if (end.servo) {
    const ServoForce force = servo_force(*end.servo, simulation);
    all.push_back(fmt::format("servo \"{}\" feels {:.4g} N and wants {:.4g} N within {:.3g} %",
                              end.servo->load, force.felt, force.wanted,
                              100.0 * end.servo->tolerance));
  }
  if (end.kinetic_energy)
    all.push_back(fmt::format("the kinetic energy is {:.4g} J, to be below {:.4g} J",
                              simulation.energy().kinetic, *end.kinetic_energy));
  if (end.unbalanced_force)
    all.push_back(fmt::format("the unbalanced force ratio is {:.4g}, to be below {:.4g}",
                              simulation.unbalanced_force_ratio(), *end.unbalanced_force));
  if (end.displacement)
    all.push_back(fmt::format("what is to move has moved by {:.4g} m of {:.4g} m",
                              moved(*end.displacement, simulation), end.displacement->distance));
  if (end.strain)
    all.push_back(fmt::format("the strain is {:.4g} of {:.4g}", strain_of(*end.strain, simulation),
                              end.strain->strain));
  if (end.force)
    all.push_back(fmt::format("the force of \"{}\" along {} is {:.4g} N, to be {} {:.4g} N",
                              end.force->reaction, "xyz"[end.force->axis],
                              force_of(*end.force, simulation),
                              end.force->is_above ? "above" : "below", end.force->force));
  return fmt::format("{}", fmt::join(all, "; "));
}

void StageWatch::exchange(const geometry::StateArchive& archive) {
  const auto exchange_seen = [&](const char* name, Seen& seen) {
    const auto of = archive.group(name);
    of("was_off", seen.was_off);
    of("in_a_row", seen.in_a_row);
  };
  exchange_seen("kinetic_energy", kinetic_energy_);
  exchange_seen("unbalanced_force", unbalanced_);
  exchange_seen("servo", servo_);
  exchange_seen("force", force_);
}

}  // namespace plekton::apps
