// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/command_line/run_estimate.hpp"

#include "apps/run/frames.hpp"
#include "apps/run/history.hpp"
#include "apps/run/reactions.hpp"
#include "dynamics/measures/diverged.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace plekton::apps {
namespace {

using Bounds = RunEstimate::Bounds;

constexpr std::chrono::milliseconds kLongestTiming{500};
constexpr std::int64_t kMostTimedSteps = 1000;
/// As a packing without friction has: six contacts touch each grain.
constexpr double kContactsPerGrain = 3.0;
constexpr Bounds kNumberInTable{2.0, 25.0};  // bytes of a number and its comma

double seconds(Progress::Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

/// Makes steps, and takes the time of all but the first, which has more to set up.
void time_steps(double duration, dynamics::Simulation& simulation, RunEstimate& estimate) {
  auto start = Progress::Clock::now();
  const auto end = start + kLongestTiming;
  try {
    if (!simulation.step_until(duration)) return;
    estimate.timed_steps = 1;
    estimate.step_time = seconds(Progress::Clock::now() - start);
    start = Progress::Clock::now();
    std::int64_t steps = 0;
    while (steps < kMostTimedSteps && Progress::Clock::now() < end &&
           simulation.step_until(duration))
      ++steps;
    if (steps == 0) return;
    estimate.timed_steps = steps;
    estimate.step_time = seconds(Progress::Clock::now() - start) / static_cast<double>(steps);
  } catch (const dynamics::Diverged& error) {
    estimate.failure = error.what();
  }
}

Bounds steps_of(double duration, const dynamics::Simulation& simulation) {
  const double dt = std::min(simulation.time_step(), duration);
  const double shortest = simulation.chooses_time_step()
                              ? std::min(dt, dynamics::kSafety * simulation.critical_step().dt)
                              : dt;
  return {std::ceil(duration / dt), std::ceil(duration / shortest)};
}

/// How often something is written: at the start, then not more often than there are steps, and at
/// the end in any case.
double times_of(double interval, double duration, double steps) {
  // A quotient of rounded numbers may be just above a whole one.
  constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
  return std::min(std::ceil((1.0 - kRounding) * duration / interval), steps) + 1.0;
}

Bounds scaled(const Bounds& bounds, double factor) {
  return {factor * bounds.low, factor * bounds.high};
}

Bounds operator+(const Bounds& a, const Bounds& b) {
  return {a.low + b.low, a.high + b.high};
}

/// Bytes of the files of a frame and of its rows in contacts.csv.
/// @param most_contacts  at a time
Bounds frame_bytes(const Scenario& scenario, PreparedRun& prepared, double most_contacts) {
  dynamics::Simulation& simulation = *prepared.simulation;
  const BodyTables bodies(scenario, prepared.built, simulation);
  const auto contacts = simulation.list_contacts();
  const auto count = static_cast<double>(contacts.size());
  Bounds bytes;
  for (const auto& [name, data] :
       frame_of(settings_for(scenario.output, simulation), simulation, bodies, contacts)) {
    const dynamics::VtpSize size = dynamics::vtp_size(data);
    bytes = bytes + Bounds{static_cast<double>(size.packed), static_cast<double>(size.unpacked)};
  }
  if (scenario.output.contacts) {
    // One more of them is as large as the first.
    const std::vector<contact::ContactRecord> one(1);
    const std::vector<dynamics::ContactLabels> labels(1);
    const auto with = vtp_size(dynamics::contacts_frame(one, 0.0, labels)).unpacked;
    const auto without = vtp_size(dynamics::contacts_frame({}, 0.0)).unpacked;
    bytes.high += (most_contacts - count) * static_cast<double>(with - without);
  }
  if (scenario.output.contact_list) {
    const auto numbers = static_cast<double>(dynamics::contact_columns().size());
    bytes = bytes + Bounds{kNumberInTable.low * numbers * count,
                           kNumberInTable.high * numbers * most_contacts};
  }
  return bytes;
}

/// Rows of energy.csv and reactions.csv.
Bounds table_bytes(const Scenario& scenario, double steps) {
  const double duration = scenario.simulation.duration;
  const double histories = times_of(scenario.output.history_interval, duration, steps) *
                           static_cast<double>(history_fields().size());
  const double reactions = times_of(scenario.output.reactions_interval, duration, steps) * 9.0 *
                           static_cast<double>(scenario.output.reactions.size());
  return scaled(kNumberInTable, histories + reactions);
}

std::string bytes_text(double bytes) {
  constexpr std::array<std::string_view, 5> kUnits = {"B", "kB", "MB", "GB", "TB"};
  std::size_t unit = 0;
  for (; bytes >= 1000.0 && unit + 1 < kUnits.size(); ++unit) bytes /= 1000.0;
  return fmt::format("{:.{}f} {}", bytes, bytes < 10.0 && unit > 0 ? 1 : 0, kUnits[unit]);
}

std::string time_text(double seconds) {
  return seconds < 1.0 ? "below 1 s" : duration_text(seconds);
}

std::string range_text(const std::string& low, const std::string& high) {
  return low == high ? low : low + " to " + high;
}

}  // namespace

RunEstimate estimate_run(const Scenario& scenario, PreparedRun& prepared) {
  dynamics::Simulation& simulation = *prepared.simulation;
  const double duration = scenario.simulation.duration;
  RunEstimate estimate;
  if (scenario.stage) estimate.stage = scenario.stage->name;
  estimate.threads = scenario.simulation.threads;
  estimate.may_stop_early = scenario.stop.has_value();
  estimate.steps = steps_of(duration, simulation);
  estimate.frames = times_of(scenario.output.interval, duration, estimate.steps.high);
  time_steps(duration, simulation, estimate);
  if (!estimate.failure.empty()) return estimate;

  const auto& counts = simulation.contacts().counts();
  const auto now = static_cast<double>(counts.sphere_sphere + counts.sphere_surface +
                                       counts.between_structures + counts.with_planes);
  const auto grains = static_cast<double>(simulation.elements().spheres.size());
  estimate.most_contacts = std::max(kLaterCost * now, kContactsPerGrain * grains);
  const auto start = Progress::Clock::now();
  const Bounds frame = frame_bytes(scenario, prepared, estimate.most_contacts);
  const double frame_time = seconds(Progress::Clock::now() - start);
  estimate.bytes = scaled(frame, estimate.frames) + table_bytes(scenario, estimate.steps.high);
  estimate.wall_time = {
      estimate.steps.low * estimate.step_time + estimate.frames * frame_time,
      kLaterCost * (estimate.steps.high * estimate.step_time + estimate.frames * frame_time)};
  return estimate;
}

std::string text_of(const RunEstimate& estimate) {
  if (!estimate.failure.empty())
    return fmt::format("warning: it diverges within the first steps: {}\n", estimate.failure);
  const std::string of = estimate.stage.empty()
                             ? ""
                             : fmt::format(" of stage {}, the others not counted", estimate.stage);
  return fmt::format(
      "wall time{}: {} with {} {}, for {} steps; {} steps timed now took {:.3g} "
      "ms each, the higher figure has {:g} times that for the contacts that come; what else this "
      "machine does, fast motion and elements that break are not in it{}\n"
      "disk{}: {} in {:.0f} frames, energy.csv and reactions.csv; the higher figure is without any "
      "packing, and with {:.0f} contacts at a time; other tables and checkpoints come on top\n",
      of, range_text(time_text(estimate.wall_time.low), time_text(estimate.wall_time.high)),
      estimate.threads, estimate.threads == 1 ? "thread" : "threads",
      range_text(fmt::format("{:.0f}", estimate.steps.low),
                 fmt::format("{:.0f}", estimate.steps.high)),
      estimate.timed_steps, 1e3 * estimate.step_time, kLaterCost,
      estimate.may_stop_early ? "; [stop] may end it sooner" : "", of,
      range_text(bytes_text(estimate.bytes.low), bytes_text(estimate.bytes.high)), estimate.frames,
      estimate.most_contacts);
}

}  // namespace plekton::apps
