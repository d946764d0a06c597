// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run.hpp"

#include "apps/history.hpp"
#include "apps/lost_grains.hpp"
#include "apps/output_folder.hpp"
#include "dynamics/output/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <system_error>
#include <utility>

namespace plekton::apps {
namespace {

constexpr std::int64_t kStepsBetweenLooks = 16;  // at the grains and the clock
constexpr std::int64_t kStepsBetweenCriticalSteps =
    512;  // the critical step costs about as much as a few steps

/// One run: what is written, and what is watched.
class Run {
 public:
  Run(const Scenario& scenario, PreparedRun& prepared, const RunSettings& settings)
      : scenario_(scenario),
        settings_(settings),
        simulation_(*prepared.simulation),
        lost_(simulation_.elements(), simulation_.state().position),
        frames_(settings.out, scenario.output, simulation_, scenario.simulation.gravity),
        history_(settings.out),
        progress_(settings.progress, settings.style, scenario.simulation.duration) {
    report_.warnings = prepared.built.warnings;
    describe();
  }

  RunReport execute() {
    try {
      report_.status = loop();
      write_last();
    } catch (const std::exception& error) {
      report_.status = RunStatus::failed;
      report_.message = error.what();
      progress_.finish();
      write_report_if_possible();
      throw;
    }
    progress_.finish();
    complete_report();
    write_run_report(settings_.out, report_);
    return report_;
  }

 private:
  RunStatus loop() {
    watch_time_step();
    write_due(0.0);
    while (simulation_.time() < scenario_.simulation.duration - 0.5 * simulation_.time_step()) {
      simulation_.step();
      const bool looks = simulation_.steps() % kStepsBetweenLooks == 0;
      if (looks) lost_.look(simulation_.state().position, simulation_.contacts().neighbours());
      if (simulation_.steps() % kStepsBetweenCriticalSteps == 0) watch_time_step();
      write_due(simulation_.time());
      if (looks) progress_.update(simulation_.time(), simulation_.steps());
      if (settings_.is_interrupted()) return RunStatus::interrupted;
      if (looks && is_at_rest()) return RunStatus::at_rest;
    }
    return RunStatus::finished;
  }

  /// Frames and rows whose time has come.
  void write_due(double time) {
    const double soon = 0.5 * simulation_.time_step();
    if (time >= next_row_ - soon) {
      history_.add(simulation_, lost_);
      next_row_ = std::max(next_row_ + scenario_.output.history_interval, time);
    }
    if (time >= next_frame_ - soon) {
      write_frame();
      next_frame_ = std::max(next_frame_ + scenario_.output.interval, time);
    }
  }

  void write_frame() {
    frames_.write(simulation_);
    history_.flush();
    last_frame_step_ = simulation_.steps();
  }

  /// The state at the end, however it came about.
  void write_last() {
    lost_.look(simulation_.state().position, simulation_.contacts().neighbours());
    if (last_frame_step_ != simulation_.steps()) {
      history_.add(simulation_, lost_);
      write_frame();
    }
    history_.close();
  }

  void watch_time_step() {
    const double critical = simulation_.critical_step().dt;
    if (!scenario_.simulation.time_step && dynamics::kSafety * critical < simulation_.time_step()) {
      simulation_.set_time_step(dynamics::kSafety * critical);
    }
    const double ratio = simulation_.time_step() / critical;
    if (ratio > dynamics::kLargestStep && report_.dt_over_critical <= dynamics::kLargestStep) {
      report_.warnings.push_back(
          fmt::format("from {:.4g} s on the time step is {:.2f} of the critical one ({:.4g} s); "
                      "run with a smaller one",
                      simulation_.time(), ratio, critical));
    }
    report_.dt_over_critical = std::max(report_.dt_over_critical, ratio);
  }

  bool is_at_rest() const {
    if (!scenario_.stop || simulation_.time() < scenario_.stop->after) return false;
    return simulation_.energy().kinetic < scenario_.stop->kinetic_energy;
  }

  void describe() {
    report_.scenario = scenario_.file.string();
    report_.overrides = settings_.overrides;
    report_.duration = scenario_.simulation.duration;
    report_.threads = scenario_.simulation.threads;
    report_.seed = scenario_.simulation.seed;
    report_.damping = scenario_.simulation.damping;
    const geometry::Elements& elements = simulation_.elements();
    report_.grains = elements.spheres.size();
    report_.nodes = simulation_.state().size();
    report_.facets = elements.facets.size();
    report_.cylinders = elements.cylinders.size();
    report_.bonds = simulation_.bonds().size();
    report_.planes = simulation_.planes().size();
  }

  void complete_report() {
    const contact::ContactCounts counts = simulation_.contacts().counts();
    report_.contacts = counts.sphere_sphere + counts.sphere_surface + counts.with_planes;
    report_.frames = frames_.count();
    report_.simulated_time = simulation_.time();
    report_.steps = simulation_.steps();
    report_.time_step = simulation_.time_step();
    report_.wall_time = std::chrono::duration<double>(Progress::Clock::now() - start_).count();
    report_.largest_overlap_ratio = simulation_.largest_overlap_ratio();
    report_.energy = simulation_.energy();
    report_.lost_grains = lost_.total();
    report_.lost_through_membranes = lost_.through_membranes();
    report_.lost_out_of_bounds = lost_.out_of_bounds();
  }

  /// After an error: its message matters more than that the report cannot be written either.
  void write_report_if_possible() noexcept {
    try {
      complete_report();
      write_run_report(settings_.out, report_);
    } catch (const std::exception&) {
    }
  }

  const Scenario& scenario_;
  const RunSettings& settings_;
  Simulation& simulation_;
  LostGrains lost_;
  Frames frames_;
  History history_;
  Progress progress_;
  RunReport report_;
  Progress::Clock::time_point start_ = Progress::Clock::now();
  double next_row_ = 0.0;    // s
  double next_frame_ = 0.0;  // s
  std::int64_t last_frame_step_ = -1;
};

}  // namespace

PreparedRun prepare_run(const Scenario& scenario) {
  PreparedRun prepared;
  prepared.built = build_scene(scenario);
  dynamics::SimulationOptions options;
  options.motion = {scenario.simulation.gravity, scenario.simulation.damping,
                    scenario.simulation.damp_gravity};
  options.skin = scenario.simulation.skin;
  options.threads = scenario.simulation.threads;
  prepared.simulation = std::make_unique<Simulation>(std::move(prepared.built.scene), options);
  if (!scenario.simulation.time_step) {
    if (std::isfinite(prepared.simulation->time_step())) return prepared;
    throw InputError(
        "nothing in this scene moves freely, so no time step can be chosen; give "
        "simulation.time_step");
  }

  const double asked = *scenario.simulation.time_step;
  const double critical = prepared.simulation->critical_step().dt;
  if (!(asked < dynamics::kLargestStep * critical)) {
    Problems problems;
    problems.add(scenario.simulation.time_step_place,
                 fmt::format("simulation.time_step: {:.6g} s is not below {} of the critical time "
                             "step of this scene, which is {:.6g} s; "
                             "choose less than {:.6g} s, or \"auto\" for {:.6g} s",
                             asked, dynamics::kLargestStep, critical,
                             dynamics::kLargestStep * critical, dynamics::kSafety * critical));
    problems.throw_if_any();
  }
  prepared.simulation->set_time_step(asked);
  return prepared;
}

RunReport run(const Scenario& scenario, PreparedRun& prepared, const RunSettings& settings) {
  make_output_folder(settings.out);
  std::error_code ignored;
  std::filesystem::remove(settings.out / "run.json", ignored);
  return Run(scenario, prepared, settings).execute();
}

}  // namespace plekton::apps
