// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/stage_watch.hpp"

#include "dynamics/loads/plane_servo.hpp"
#include "geometry/base/state_archive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace plekton::apps {
namespace {

/// In a row: a force that swings through the wanted one has not reached it, and a few grains that
/// strike hard make the mean force that contacts carry large for a moment.
constexpr int kLooksWithin = 10;

struct ServoForce {
  double felt = 0.0;    ///< N, along the normal
  double wanted = 0.0;  ///< N, at the end of its factor
};

ServoForce servo_force(const ServoEnd& end, const dynamics::Simulation& simulation) {
  const dynamics::Scene& scene = simulation.scene();
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

double moved(const DisplacementEnd& end, const StageStart& start,
             const dynamics::Simulation& simulation) {
  return (simulation.planes()[end.plane].point - start.planes[end.plane]).norm();
}

double strain_of(const StrainEnd& end, const StageStart& start,
                 const dynamics::Simulation& simulation) {
  const auto& planes = simulation.planes();
  const auto [a, b] = end.planes;
  const geometry::Vec3& normal = planes[a].normal;
  const double before = normal.dot(start.planes[b] - start.planes[a]);
  const double now = normal.dot(planes[b].point - planes[a].point);
  return std::abs((now - before) / before);
}

}  // namespace

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
  if (end.displacement &&
      moved(*end.displacement, start_, simulation) >= end.displacement->distance)
    return "displacement";
  if (end.strain && strain_of(*end.strain, start_, simulation) >= end.strain->strain)
    return "strain";
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
    all.push_back(fmt::format("the plane has moved by {:.4g} m of {:.4g} m",
                              moved(*end.displacement, start_, simulation),
                              end.displacement->distance));
  if (end.strain)
    all.push_back(fmt::format("the strain is {:.4g} of {:.4g}",
                              strain_of(*end.strain, start_, simulation), end.strain->strain));
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
}

}  // namespace plekton::apps
