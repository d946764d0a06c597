// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/stage_watch.hpp"

#include "apps/run/reactions.hpp"
#include "apps/run/servo_force.hpp"
#include "apps/scene/node_set.hpp"
#include "geometry/base/state_archive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace plekton::apps {
namespace {

using geometry::index_of;
using geometry::NodeId;

/// m
Vec3 mean_place(const std::vector<NodeId>& nodes, const std::vector<Vec3>& positions) {
  Vec3 sum = Vec3::Zero();
  for (const NodeId node : nodes) sum += positions[index_of(node)];
  return sum / static_cast<double>(nodes.size());
}

}  // namespace

/// m, of a container also by how much it has become narrower or wider.
double EndWatch::moved(const DisplacementEnd& end, const dynamics::Simulation& simulation) const {
  if (!end.nodes) {
    const contact::Plane& plane = simulation.planes()[end.plane];
    const double way = (plane.point - start_.planes[end.plane]).norm();
    if (plane.form == contact::Plane::Form::flat) return way;
    return std::max(way, std::abs(plane.radius - start_.radii[end.plane]));
  }
  return (mean_place(built_.moved_nodes, simulation.state().position) -
          mean_place(built_.moved_nodes, start_.positions))
      .norm();
}

double EndWatch::strain_of(const StrainEnd& end, const dynamics::Simulation& simulation) const {
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
double EndWatch::force_of(const ForceEnd& end, const dynamics::Simulation& simulation) const {
  const auto reaction =
      std::find_if(built_.reactions.begin(), built_.reactions.end(),
                   [&](const BuiltReaction& one) { return one.name == end.reaction; });
  std::vector<contact::ContactRecord> contacts;
  if (reaction->kind == ReactionKind::contacts) contacts = simulation.contact_rows();
  return reaction_in(simulation, *reaction, contacts).value.force[end.axis];
}

bool EndWatch::is_beyond(const ForceEnd& end, const dynamics::Simulation& simulation) const {
  const double force = force_of(end, simulation);
  return end.is_above ? force > end.force : force < end.force;
}

/// @param seen  of it in this stage; noted here
bool EndWatch::counts(bool holds, Seen& seen, double time, int looks) const {
  seen.in_a_row = holds ? seen.in_a_row + 1 : 0;
  if (!holds) seen.was_off = true;
  if (seen.in_a_row < looks) return false;
  return end_.after ? time >= start_.time + *end_.after : seen.was_off;
}

std::string EndWatch::look(const dynamics::Simulation& simulation) {
  const StageEnd& end = end_;
  const double time = simulation.time();
  if (end.servo &&
      counts(servo_force(*end.servo, simulation).is_within(end.servo->tolerance), servo_, time))
    return "servo";
  if (end.kinetic_energy && counts(simulation.energy().kinetic < *end.kinetic_energy,
                                   kinetic_energy_, time, looks_.at_kinetic_energy))
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
      stage_.path, *stage_.max_duration, ends_.state(simulation)));
}

std::string EndWatch::all_along(const Seen& seen) const {
  if (end_.after || seen.was_off || seen.in_a_row == 0) return "";
  return ", as it has been since the stage began: that counts where the end says after";
}

std::string EndWatch::state(const dynamics::Simulation& simulation) const {
  const StageEnd& end = end_;
  std::vector<std::string> all;
  if (end.servo) {
    all.push_back(fmt::format("servo \"{}\" {} within {:.3g} %{}", end.servo->load,
                              servo_force(*end.servo, simulation).text(),
                              100.0 * end.servo->tolerance, all_along(servo_)));
  }
  if (end.kinetic_energy)
    all.push_back(fmt::format("the kinetic energy is {:.4g} J, to be below {:.4g} J{}",
                              simulation.energy().kinetic, *end.kinetic_energy,
                              all_along(kinetic_energy_)));
  if (end.unbalanced_force)
    all.push_back(fmt::format("the unbalanced force ratio is {:.4g}, to be below {:.4g}{}",
                              simulation.unbalanced_force_ratio(), *end.unbalanced_force,
                              all_along(unbalanced_)));
  if (end.displacement)
    all.push_back(fmt::format("what is to move has moved by {:.4g} m of {:.4g} m",
                              moved(*end.displacement, simulation), end.displacement->distance));
  if (end.strain)
    all.push_back(fmt::format("the strain is {:.4g} of {:.4g}", strain_of(*end.strain, simulation),
                              end.strain->strain));
  if (end.force)
    all.push_back(
        fmt::format("the force of \"{}\" along {} is {:.4g} N, to be {} {:.4g} N{}",
                    end.force->reaction, "xyz"[end.force->axis], force_of(*end.force, simulation),
                    end.force->is_above ? "above" : "below", end.force->force, all_along(force_)));
  return fmt::format("{}", fmt::join(all, "; "));
}

void EndWatch::exchange(const geometry::StateArchive& archive) {
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
