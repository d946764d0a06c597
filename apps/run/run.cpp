// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/run/run.hpp"

#include "apps/run/broken_at_start.hpp"
#include "apps/run/checkpoints.hpp"
#include "apps/run/clock_checkpoints.hpp"
#include "apps/run/enclosed_bodies.hpp"
#include "apps/run/first_rank.hpp"
#include "apps/run/history.hpp"
#include "apps/run/lost_grains.hpp"
#include "apps/run/measures.hpp"
#include "apps/run/other_file.hpp"
#include "apps/run/output_folder.hpp"
#include "apps/run/plane_places.hpp"
#include "apps/run/pressures.hpp"
#include "apps/run/reactions.hpp"
#include "apps/run/refused_self_contact.hpp"
#include "apps/run/rigid_motions.hpp"
#include "apps/run/run_origin.hpp"
#include "apps/run/run_state.hpp"
#include "apps/run/run_warnings.hpp"
#include "apps/run/same_outputs.hpp"
#include "apps/run/scenario_copy.hpp"
#include "apps/run/servo_force.hpp"
#include "apps/run/stage_watch.hpp"
#include "apps/run/stiffness_warnings.hpp"
#include "apps/run/tie_histories.hpp"
#include "apps/run/unit_warnings.hpp"
#include "apps/run/written_files.hpp"
#include "apps/scene/build_stage.hpp"
#include "contact/among_ranks.hpp"
#include "contact/models.hpp"
#include "dynamics/output/file.hpp"
#include "dynamics/output/sync.hpp"
#include "dynamics/structure/beam_bonds.hpp"
#include "geometry/base/sign_totals.hpp"
#include "geometry/base/state_archive.hpp"
#include "geometry/base/vector_width.hpp"
#include "geometry/neighbor/neighbours.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <stdexcept>
#include <utility>

namespace plekton::apps {
namespace {

constexpr std::int64_t kStepsBetweenLooks = 16;  // at the clock and for rest
constexpr std::int64_t kStepsBetweenCriticalSteps =
    512;                             // the critical step costs about as much as a few steps
constexpr double kMostSteps = 1e12;  // years, and time still advances by full steps
constexpr double kNever = std::numeric_limits<double>::infinity();

double seconds_since(Progress::Clock::time_point start) {
  return std::chrono::duration<double>(Progress::Clock::now() - start).count();
}

/// Adds the time (s) from its making to its end to a sum.
class TimeInto {
 public:
  explicit TimeInto(double& sum) : sum_(sum) {}
  TimeInto(const TimeInto&) = delete;
  TimeInto& operator=(const TimeInto&) = delete;
  ~TimeInto() { sum_ += seconds_since(start_); }

 private:
  double& sum_;
  Progress::Clock::time_point start_ = Progress::Clock::now();
};

/// What is told of a run as it begins, also where it goes on later.
struct RunStart {
  RunReport report;
  OutputSettings output;  ///< of what there is
  LostGrains lost;
  StageStart stop;  ///< from where [stop] counts; empty without it
};

RunReport begun_report(const Scenario& scenario, const PreparedRun& prepared) {
  const dynamics::Simulation& simulation = *prepared.simulation;
  RunReport report;
  report.warnings = prepared.built.warnings;
  report.states = StateHashes(scenario.output.hash_interval);
  report.date = date_of_now();
  report.host = name_of_host();
  report.vector_width = geometry::vector_width();
  report.scenario = scenario.file.string();
  report.overrides = scenario.overrides;
  if (!scenario.stage) report.duration = scenario.simulation.duration;
  report.threads = scenario.simulation.threads;
  if (scenario.simulation.ranks != nullptr) report.ranks = scenario.simulation.ranks->count();
  report.seed = scenario.simulation.seed;
  report.damping = scenario.simulation.damping;
  report.grains = simulation.elements().spheres.size();
  report.nodes = simulation.state().size();
  // As they are made: where a run goes on, those that broke before are not known yet.
  for (const BuiltMembrane& membrane : prepared.built.membranes) {
    if (!simulation.scene().is_there(geometry::id_at<geometry::NodeId>(membrane.first_node)))
      continue;
    report.facets += membrane.facets;
    report.cylinders += membrane.cylinders;
  }
  report.bonds = simulation.bonds().size();
  report.planes = simulation.planes().size();
  report.ties = simulation.ties().size();
  report.names = names_of(scenario);
  return report;
}

/// How things stand before a run without stages begins.
StageStart start_now(const dynamics::Simulation& simulation) {
  StageStart start;
  start.positions = simulation.state().position;
  for (const contact::Plane& plane : simulation.planes()) {
    start.planes.push_back(plane.point);
    start.radii.push_back(plane.radius);
  }
  return start;
}

/// Of a run that nothing ends before its duration is over.
const StageEnd kNoEnd{};

RunStart start_of(const Scenario& scenario, const PreparedRun& prepared) {
  const dynamics::Simulation& simulation = *prepared.simulation;
  return {begun_report(scenario, prepared), settings_for(scenario.output, simulation),
          LostGrains(simulation.elements(), simulation.state().position, simulation.planes()),
          scenario.stop ? start_now(simulation) : StageStart{}};
}

/// One run: what is written, and what is watched.
class Run {
 public:
  Run(const Scenario& scenario, PreparedRun& prepared, const RunSettings& settings, RunStart start)
      : scenario_(scenario),
        settings_(settings),
        simulation_(*prepared.simulation),
        bodies_of_stage_(prepared.bodies),
        stage_(stage_watch(scenario, prepared)),
        end_time_(stage_ ? stage_->latest() : scenario.simulation.duration),
        bodies_(scenario, prepared.built, simulation_),
        lost_(std::move(start.lost)),
        stop_start_(std::move(start.stop)),
        stop_(scenario.stop ? *scenario.stop : kNoEnd, stop_start_, prepared.built,
              EndWatch::kOfRuns),
        servos_(scenario),
        before_(files_before(settings)),
        reactions_(settings.out, prepared.built.reactions, scenario.names_of_stages.reactions,
                   before()),
        frames_(settings.out, start.output, bodies_, before()),
        history_(settings.out, before()),
        pressures_(settings.out, scenario, before()),
        measures_(settings.out, scenario, before()),
        rigid_bodies_(settings.out, prepared.built, before()),
        ties_(settings.out, prepared.built, before()),
        planes_(settings.out, scenario, before()),
        clock_checkpoints_(settings.out, scenario.output.checkpoint_wall_interval),
        progress_(settings.progress, settings.style, end_time_),
        report_(std::move(start.report)) {
    if (reactions_.empty()) next_reactions_ = kNever;
    next_checkpoint_ = checkpoint_interval();
    if (settings.resume != nullptr) go_on_from(*settings.resume);
    if (before_) keep_other_files();
  }

  /// For its report, once, however often it goes on. @param warning  may be empty
  void warn(const std::string& warning) {
    std::vector<std::string>& known = report_.warnings;
    const bool is_new = std::find(known.begin(), known.end(), warning) == known.end();
    if (!warning.empty() && is_new) known.push_back(warning);
  }

  RunReport execute() {
    try {
      report_.status = loop();
      if (!ended_by_.empty()) return end_of_stage();
      // What is written at the end is no part of it: a run that goes on has it not.
      if (last_checkpoint_step_ != simulation_.steps()) write_checkpoint();
      if (report_.status != RunStatus::interrupted) simulation_.check_energy();
      write_last();
    } catch (const std::exception& error) {
      report_.status = RunStatus::failed;
      report_.message = error.what();
      progress_.finish();
      // All ranks diverge in the same step, and all see a stage fail. What fails on one alone is not
      // answered by the others.
      const bool is_alone = scenario_.simulation.ranks != nullptr &&
                            dynamic_cast<const dynamics::Diverged*>(&error) == nullptr &&
                            dynamic_cast<const StageFailed*>(&error) == nullptr;
      write_report_if_possible(!is_alone);
      throw;
    }
    progress_.finish();
    complete_report();
    if (!stage_ && report_.status != RunStatus::interrupted) warn_of_servos();
    write_whole_report();
    return report_;
  }

 private:
  static std::optional<StageWatch> stage_watch(const Scenario& scenario,
                                               const PreparedRun& prepared) {
    if (!scenario.stage) return std::nullopt;
    return StageWatch(*scenario.stage, prepared.bodies.starts.back(), prepared.built);
  }

  /// What was reached is written before the checkpoint: the next stage begins after it.
  RunReport end_of_stage() {
    simulation_.check_energy();
    write_last_rows();
    complete_report();
    const StageSettings& stage = *scenario_.stage;
    report_.ended_by = ended_by_;
    report_.stages.push_back(
        to_json({stage.name, ended_by_, bodies_of_stage_.starts.back().time}, report_));
    write_checkpoint();
    close_files();
    progress_.finish();
    if (!settings_.has_next_stage) write_whole_report();
    return report_;
  }

  void warn_of_servos() {
    for (std::string& warning : servos_.warnings(simulation_))
      report_.warnings.push_back(std::move(warning));
  }

  /// One step. @returns whether there was any left
  bool advance() {
    if (!stage_) return simulation_.step_until(end_time_);
    // Stages end with a whole step, so that where they are cut changes nothing.
    // One is taken at least: its end is kept as that of a step.
    constexpr double kRest = 1e-3;  // of a step
    const bool has_begun = simulation_.time() > bodies_of_stage_.starts.back().time;
    if (!has_begun || end_time_ - simulation_.time() > kRest * simulation_.time_step())
      return simulation_.step_until(kNever);
    ended_by_ = stage_->end_in_time(simulation_);
    return false;
  }

  bool stage_ends() {
    if (!stage_) return false;
    ended_by_ = stage_->look(simulation_);
    return !ended_by_.empty();
  }

  RunStatus loop() {
    if (settings_.resume == nullptr) {
      watch_time_step();
      watch_motion();
      write_due(0.0);
      report_.states.look(simulation_);
    }
    report_.start_up_time = settings_.stages_before != nullptr
                                ? settings_.stages_before->start_up_time
                                : seconds_since(settings_.began);
    while (advance()) {
      if (simulation_.largest_overlap_ratio() > next_overlap_) look_at_overlaps();
      const bool looks = simulation_.steps() % kStepsBetweenLooks == 0;
      if (simulation_.steps() >= next_look_at_grains_) look_at_grains();
      if (simulation_.steps() % kStepsBetweenCriticalSteps == 0) watch_time_step();
      // Where a chosen step has just been looked at, so that it is seen as it was chosen.
      if (simulation_.steps() % dynamics::kStepsBetweenLooks == 0) watch_motion();
      write_due(simulation_.time());
      report_.states.look(simulation_);
      // Before any checkpoint of this step: a run that goes on from it does not look again.
      if (looks && stops()) return stop_status();
      if (looks && stage_ends()) return RunStatus::finished;
      if (simulation_.time() >= next_checkpoint_) write_checkpoint();
      if (looks && clock_says_checkpoint()) write_checkpoint_by_clock();
      if (looks) progress_.update(simulation_.time(), simulation_.steps());
      if (settings_.is_interrupted()) return RunStatus::interrupted;
      if (is_far_enough()) return RunStatus::finished;
    }
    return RunStatus::finished;
  }

  bool is_far_enough() const {
    return settings_.until &&
           simulation_.time() >= *settings_.until - 0.5 * simulation_.time_step();
  }

  bool clock_says_checkpoint() const {
    return scenario_.output.checkpoint_wall_interval &&
           on_any_rank(scenario_.simulation.ranks, clock_checkpoints_.is_due());
  }

  void write_whole_report() {
    add_warnings_to(report_);
    write_run_report(settings_.out, report_);
  }

  /// What the files of a run were that goes on in its folder.
  static std::optional<WrittenFiles> files_before(const RunSettings& settings) {
    if (settings.resume == nullptr || !settings.resume->same_folder) return std::nullopt;
    if (settings.out == dynamics::kNowhere) return std::nullopt;
    WrittenFiles files;
    exchange_files(geometry::StateArchive::reader(settings.resume->state).group(kRunGroup), files);
    return files;
  }
  const WrittenFiles* before() const noexcept { return before_ ? &*before_ : nullptr; }

  /// Files that an earlier part of the run has written, and this one does not, as they were then:
  /// a later part may go on with them.
  void keep_other_files() {
    const WrittenFiles now = written_files();
    for (const auto& [name, size] : before_->sizes) {
      if (now.sizes.contains(name)) continue;
      dynamics::cut_back(settings_.out / name, size);
      other_files_.sizes[name] = size;
    }
  }

  WrittenFiles written_files() const {
    WrittenFiles files = other_files_;
    frames_.tell(files);
    for_each_history(*this, [&](const auto& history) { history.tell(files); });
    return files;
  }

  double checkpoint_interval() const noexcept {
    return scenario_.output.checkpoint_interval.value_or(kNever);
  }

  static void for_each_history(auto& run, const auto& visit) {
    visit(run.history_);
    visit(run.reactions_);
    visit(run.pressures_);
    visit(run.measures_);
    visit(run.rigid_bodies_);
    visit(run.ties_);
    visit(run.planes_);
  }

  /// One that nobody has to wait for moves none of those that come.
  void write_checkpoint() {
    if (simulation_.time() >= next_checkpoint_)
      next_checkpoint_ = std::max(next_checkpoint_ + checkpoint_interval(), simulation_.time());
    geometry::StateTree state = written_state(CheckpointKind::stays);
    last_checkpoint_step_ = simulation_.steps();
    clock_checkpoints_.replaced();
    if (settings_.end_of_stage != nullptr && !ended_by_.empty())
      *settings_.end_of_stage = std::move(state);
  }

  /// As if there had been none: what is due by simulated time, and when, stays as it is.
  void write_checkpoint_by_clock() {
    if (last_checkpoint_step_ == simulation_.steps()) return;
    written_state(CheckpointKind::by_clock);
    clock_checkpoints_.written(simulation_.steps());
  }

  /// Histories are on the disk before the checkpoint that goes on with them.
  geometry::StateTree written_state(CheckpointKind kind) {
    const TimeInto output(report_.output_time);
    for_each_history(*this, [](auto& history) { history.flush(); });
    geometry::StateTree state = simulation_.snapshot();
    const auto archive = geometry::StateArchive::writer(state).group(kRunGroup);
    exchange(archive);
    WrittenFiles files = written_files();
    exchange_files(archive, files);
    ScenarioText text = text_of(scenario_);
    text.exchange(archive);
    if (stage_) exchange_stage(archive.group(kStageGroup));
    for (const auto& [name, size] : files.sizes) dynamics::sync_file(settings_.out / name);
    write_run_checkpoint(settings_.out, simulation_.steps(), state, kind);
    return state;
  }

  /// @returns whether the stage begins
  bool exchange_stage(const geometry::StateArchive& archive) {
    bool has_ended = !ended_by_.empty();
    archive("has_ended", has_ended);
    exchange_texts(archive, "ended", report_.stages);
    // A stage that begins has seen nothing yet.
    if (archive.is_reading() && has_ended) return true;
    bodies_of_stage_.exchange(archive);
    stage_->exchange(archive);
    return false;
  }

  /// The simulation has the state already.
  void go_on_from(const Resumption& from) {
    const auto archive = geometry::StateArchive::reader(from.state).group(kRunGroup);
    const std::vector<std::string> warnings = report_.warnings;  // of this stage
    exchange(archive);
    if (stage_ && exchange_stage(archive.group(kStageGroup)))
      for (const std::string& warning : warnings) warn(warning);
    report_.resumed = simulation_.time();
    report_.resumed_step = simulation_.steps();
    if (settings_.stages_before != nullptr) take_timing(*settings_.stages_before);
    follow_new_intervals();
    if (from.same_folder) {
      if (!from.by_clock) last_checkpoint_step_ = simulation_.steps();
      return;
    }
    if (!from.from) return;
    // A stage that begins in another folder is written when it would have been in that of the others.
    if (!from.is_there || *from.from > simulation_.time()) {
      next_row_ = next_frame_ = std::max(*from.from, simulation_.time());
      if (!reactions_.empty()) next_reactions_ = next_row_;
    }
    last_row_step_ = last_reactions_step_ = last_frame_step_ = -1;
  }

  /// What goes on may be written more often than before, what began with nothing due has something
  /// now, or nothing any more.
  void follow_new_intervals() {
    const OutputSettings& output = scenario_.output;
    if (!output.checkpoint_interval) next_checkpoint_ = kNever;
    if (reactions_.empty()) next_reactions_ = kNever;
    bring_forward(next_row_, output.history_interval);
    bring_forward(next_frame_, output.interval);
    if (!reactions_.empty()) bring_forward(next_reactions_, output.reactions_interval);
    bring_forward(next_checkpoint_, checkpoint_interval());
  }

  /// With the same interval as before nothing changes: what is due within half a step is written, and
  /// the next one comes an interval after it was due.
  void bring_forward(double& next, double interval) const {
    const double soonest = simulation_.time() + interval;
    if (next > soonest + simulation_.time_step()) next = soonest;
  }

  /// Of stages that the same run of the program has made before.
  void take_timing(const RunReport& before) {
    report_.resumed = before.resumed;
    report_.resumed_step = before.resumed_step;
    report_.output_time = before.output_time;
    wall_time_before_ = before.wall_time;
    decisions_before_ = before.exact_decisions;
  }

  /// What the run knows beside the simulation and its files.
  void exchange(const geometry::StateArchive& archive) {
    lost_.exchange(archive.group("lost_grains"));
    report_.states.exchange(archive);
    exchange_so_far(archive.group("report"), report_);
    archive("next_row", next_row_);
    archive("next_reactions", next_reactions_);
    archive("next_frame", next_frame_);
    archive("next_checkpoint", next_checkpoint_);
    archive("largest_turnover", largest_turnover_);
    archive("largest_tracking", largest_tracking_);
    archive("next_overlap", next_overlap_);
    archive("last_row_step", last_row_step_);
    archive("last_reactions_step", last_reactions_step_);
    archive("last_frame_step", last_frame_step_);
    archive("next_look_at_grains", next_look_at_grains_);
    stop_.exchange(archive.group("stop"));
    if (!stage_) servos_.exchange(archive.group("servos"));
  }

  /// Who is in whom where the largest overlap has grown: not often, since that lists all contacts.
  void look_at_overlaps() {
    next_overlap_ = (1.0 + kSameOverlap) * simulation_.largest_overlap_ratio();
    const auto deepest = deepest_overlap(simulation_.contact_rows(), bodies_, simulation_);
    if (!deepest) return;
    report_.deepest_overlap = {name_of(*deepest, 0, scenario_),
                               name_of(*deepest, 1, scenario_),
                               deepest->depth,
                               deepest->ratio,
                               deepest->place,
                               simulation_.time()};
  }

  void look_at_grains() {
    lost_.look(simulation_.state().position, simulation_.contacts().neighbours(),
               {simulation_.planes(), simulation_.gravity(), simulation_.state().velocity});
    next_look_at_grains_ =
        simulation_.steps() +
        lost_.steps_to_next_look(simulation_.state().velocity, simulation_.time_step());
  }

  /// Frames and rows whose time has come.
  void write_due(double time) {
    // Before a last step that is short (where a run goes on just before its end) nothing is due at the
    // end already.
    const bool ends_soon = !stage_ && end_time_ - time < 0.5 * simulation_.time_step();
    const double soon = ends_soon ? 0.0 : 0.5 * simulation_.time_step();
    if (time < std::min({next_row_, next_reactions_, next_frame_}) - soon) return;
    const TimeInto output(report_.output_time);
    if (time >= next_row_ - soon) {
      add_row();
      next_row_ = std::max(next_row_ + scenario_.output.history_interval, time);
    }
    if (time >= next_reactions_ - soon) {
      add_reactions();
      next_reactions_ = std::max(next_reactions_ + scenario_.output.reactions_interval, time);
    }
    if (time >= next_frame_ - soon) {
      write_frame();
      next_frame_ = std::max(next_frame_ + scenario_.output.interval, time);
    }
  }

  void add_row() {
    const dynamics::Energy energy = simulation_.energy();
    largest_turnover_ = std::max(largest_turnover_, energy.turnover());
    largest_tracking_ = std::max(largest_tracking_, std::abs(energy.tracking));
    history_.add(simulation_, energy, lost_);
    pressures_.add(simulation_);
    measures_.add(simulation_);
    rigid_bodies_.add(simulation_);
    ties_.add(simulation_);
    if (!stage_) servos_.look(simulation_);
    last_row_step_ = simulation_.steps();
  }

  void add_reactions() {
    reactions_.add(simulation_);
    last_reactions_step_ = simulation_.steps();
  }

  void write_frame() {
    frames_.write(simulation_);
    planes_.add(simulation_);
    for_each_history(*this, [](auto& history) { history.flush(); });
    last_frame_step_ = simulation_.steps();
  }

  /// The state at the end, however it came about.
  void write_last() {
    write_last_rows();
    close_files();
  }

  void write_last_rows() {
    look_at_grains();
    report_.states.take(simulation_);
    const TimeInto output(report_.output_time);
    if (last_row_step_ != simulation_.steps()) add_row();
    if (!reactions_.empty() && last_reactions_step_ != simulation_.steps()) add_reactions();
    if (last_frame_step_ != simulation_.steps()) write_frame();
  }

  void close_files() {
    for_each_history(*this, [](auto& history) { history.close(); });
  }

  void watch_time_step() {
    const double critical = simulation_.limit_of_step().dt;
    const double ratio = simulation_.time_step() / critical;
    if (ratio > dynamics::kLargestStep && report_.dt_over_critical <= dynamics::kLargestStep) {
      report_.warnings.push_back(
          fmt::format("from {:.4g} s on the time step is {:.2f} of the critical one ({:.4g} s); {}",
                      simulation_.time(), ratio, critical,
                      simulation_.chooses_time_step()
                          ? fmt::format("it was chosen, and something became stiffer faster than "
                                        "that follows; give simulation.time_step, {:.2g} s",
                                        dynamics::kSafety * critical)
                          : "run with a smaller one"));
    }
    report_.dt_over_critical = std::max(report_.dt_over_critical, ratio);
  }

  void watch_motion() {
    report_.largest_motion_ratio =
        std::max(report_.largest_motion_ratio, simulation_.motion_ratio());
  }

  bool stops() {
    report_.stopped_by = stop_.look(simulation_);
    return !report_.stopped_by.empty();
  }

  RunStatus stop_status() const {
    const std::string& by = report_.stopped_by;
    return by == "kinetic_energy" || by == "unbalanced_force" ? RunStatus::at_rest
                                                              : RunStatus::finished;
  }

  void complete_report() {
    const contact::ContactCounts counts = simulation_.contacts().counts();
    report_.contacts = counts.sphere_sphere + counts.sphere_surface + counts.between_structures +
                       counts.with_planes;
    report_.broken_bonds = broken_bonds(simulation_);
    report_.torn_facets = torn_facets(simulation_);
    report_.broken_ties = simulation_.ties().broken();
    report_.frames = frames_.count();
    report_.simulated_time = simulation_.time();
    report_.steps = simulation_.steps();
    report_.time_step = simulation_.time_step();
    report_.chose_time_step = simulation_.chooses_time_step();
    report_.wall_time = wall_time_before_ + seconds_since(start_);
    report_.largest_overlap_ratio = simulation_.largest_overlap_ratio();
    report_.pass_throughs = simulation_.pass_throughs();
    report_.most_crossings = simulation_.most_crossings();
    report_.energy = simulation_.energy();
    const double turnover = std::max(largest_turnover_, report_.energy.turnover());
    const double tracking = std::max(largest_tracking_, std::abs(report_.energy.tracking));
    report_.energy_closure = report_.energy.closure(turnover);
    report_.tracking_ratio = turnover > 0.0 ? tracking / turnover : 0.0;
    report_.momentum = simulation_.momentum_drift();
    report_.exact_decisions = exact_decisions();
    report_.lost_grains = lost_.total();
    report_.lost_through_membranes = lost_.through_membranes();
    report_.lost_out_of_bounds = lost_.out_of_bounds();
  }

  geometry::SignCounters exact_decisions() const noexcept {
    const geometry::SignCounters now = geometry::sign_totals();
    return {decisions_before_.double_double + now.double_double - decisions_.double_double,
            decisions_before_.interval + now.interval - decisions_.interval,
            decisions_before_.exact + now.exact - decisions_.exact};
  }

  /// After an error: its message matters more than that the report cannot be written either.
  /// @param with_figures  those of the simulation, which all ranks have to ask for
  void write_report_if_possible(bool with_figures) noexcept {
    try {
      if (with_figures) {
        complete_report();
        add_warnings_to(report_);
      }
      write_run_report(settings_.out, report_);
    } catch (const std::exception&) {
    }
  }

  const Scenario& scenario_;
  const RunSettings& settings_;
  dynamics::Simulation& simulation_;
  StageBodies& bodies_of_stage_;
  std::optional<StageWatch> stage_;
  double end_time_;       // s, at the latest
  std::string ended_by_;  // of a stage; empty: it goes on
  BodyTables bodies_;
  LostGrains lost_;
  StageStart stop_start_;
  EndWatch stop_;  // of a run without stages
  ServoWatch servos_;
  std::optional<WrittenFiles> before_;
  WrittenFiles other_files_;  // of parts of the run before
  Reactions reactions_;       // first: it may refuse to go on, and the others cut what is there
  Frames frames_;
  History history_;
  Pressures pressures_;
  Measures measures_;
  RigidMotions rigid_bodies_;
  TieHistories ties_;
  PlanePlaces planes_;
  ClockCheckpoints clock_checkpoints_;
  Progress progress_;
  RunReport report_;
  Progress::Clock::time_point start_ = Progress::Clock::now();
  double wall_time_before_ = 0.0;                               // s
  geometry::SignCounters decisions_ = geometry::sign_totals();  // as the run began
  geometry::SignCounters decisions_before_;                     // of stages before
  double next_row_ = 0.0;                                       // s
  double next_reactions_ = 0.0;                                 // s; infinite if there are none
  double next_frame_ = 0.0;                                     // s
  double next_checkpoint_ = 0.0;        // s; infinite if there is only one at the end
  double largest_turnover_ = 0.0;       // J, of all rows
  double largest_tracking_ = 0.0;       // J, magnitude, of all rows
  double next_overlap_ = kDeepOverlap;  // ratio above which overlaps are looked at
  std::int64_t last_row_step_ = -1;
  std::int64_t last_reactions_step_ = -1;
  std::int64_t last_frame_step_ = -1;
  std::int64_t last_checkpoint_step_ = -1;
  std::int64_t next_look_at_grains_ = 1;
};

/// The key by which a run, or a stage of it, ends at the latest.
std::string duration_key(const Scenario& scenario) {
  if (!scenario.stage) return "simulation.duration";
  const bool is_end = scenario.stage->end.duration == scenario.stage->longest();
  return scenario.stage->path + (is_end ? ".end.duration" : ".max_duration");
}

/// @param chosen  s, what "auto" would begin with; infinite if there is nothing to choose it by
/// @throws InputError
void require_sound_time_step(const Scenario& scenario, double critical, double chosen) {
  const SimulationSettings& settings = scenario.simulation;
  const double asked = *settings.time_step;
  const std::string stage = scenario.stage ? " as " + scenario.stage->path + " begins" : "";
  Problems problems;
  if (!(asked < dynamics::kLargestStep * critical)) {
    problems.add(settings.time_step_place,
                 fmt::format("simulation.time_step: {:.6g} s is not below {} of the critical time "
                             "step of this scene{}, which is {:.6g} s; "
                             "choose less than {:.6g} s, or \"auto\", which begins with {:.4g} s{}",
                             asked, dynamics::kLargestStep, stage, critical,
                             dynamics::kLargestStep * critical, chosen,
                             chosen > dynamics::kLargestStep * critical
                                 ? " and gets shorter as more bodies touch"
                                 : ""));
  }
  if (asked > settings.duration) {
    problems.add(settings.time_step_place,
                 fmt::format("simulation.time_step: {:.6g} s is longer than {}, {:.6g} s; choose a "
                             "shorter one, or \"auto\"",
                             asked, duration_key(scenario), settings.duration));
  }
  problems.throw_if_any();
}

contact::ContactModel model_of(const std::vector<PairSettings>& pairs, geometry::Ranks* ranks) {
  contact::PairProperties<contact::AnyLaw> properties;
  for (const PairSettings& pair : pairs) {
    properties[{geometry::id_at<contact::MaterialId>(pair.first),
                geometry::id_at<contact::MaterialId>(pair.second)}] =
        contact::properties_of(pair.contact);
  }
  const contact::ContactModel model = contact::any_law(properties);
  return ranks == nullptr ? model : contact::among_ranks(model, *ranks);
}

}  // namespace

void require_possible_duration(const char* name, double duration, double step) {
  if (duration <= kMostSteps * step) return;
  throw InputError(fmt::format(
      "{}: {:.6g} s are {:.3g} steps of {:.6g} s, above the {:.0e} that a run may have; ask for a "
      "shorter duration or longer steps (softer, larger and heavier bodies allow them)",
      name, duration, duration / step, step, kMostSteps));
}

void choose_time_step(const Scenario& scenario, dynamics::Simulation& simulation) {
  const SimulationSettings& settings = scenario.simulation;
  double chosen = simulation.time_step();
  if (settings.time_step) {
    require_sound_time_step(scenario, simulation.critical_step().dt, chosen);
    chosen = *settings.time_step;
  } else if (!std::isfinite(chosen)) {
    throw InputError(
        "nothing in this scene moves freely and meets a contact or a spring, so no time step "
        "can be chosen; give simulation.time_step");
  }
  require_possible_duration(duration_key(scenario).c_str(), settings.duration, chosen);
  // A chosen one stays so, also where it is longer than the run.
  if (settings.time_step && chosen != simulation.time_step()) simulation.set_time_step(chosen);
}

std::unique_ptr<dynamics::Simulation> simulation_of(const Scenario& scenario, BuiltScene& built) {
  dynamics::SimulationOptions options;
  options.motion = {scenario.simulation.gravity, scenario.simulation.damping,
                    scenario.simulation.damp_gravity};
  options.skin = scenario.simulation.skin;
  options.self_contact = scenario.simulation.self_contact;
  options.threads = scenario.simulation.threads;
  try {
    return std::make_unique<dynamics::Simulation>(
        std::move(built.scene), options, model_of(scenario.contacts, scenario.simulation.ranks));
  } catch (const std::length_error& error) {
    throw refused_self_contact(scenario, built.membranes, error.what());
  }
}

namespace {

/// "looking for contacts", and why that may take long: where a membrane is much thicker than its
/// facets or bars are wide, all of those within its thickness touch what touches one of them, and
/// the work goes with the square of their number.
std::string looking_for_contacts(const Scenario& scenario, const BuiltScene& built) {
  constexpr double kThick = 4.0;  // some fifty facets within the thickness around each
  std::string what = "looking for contacts";
  double most = kThick;
  for (std::size_t i = 0; i < built.membranes.size(); ++i) {
    const BuiltMembrane& membrane = built.membranes[i];
    const double width = membrane.facets > 0
                             ? std::sqrt(2.0 * membrane.area / static_cast<double>(membrane.facets))
                             : membrane.mean_edge;
    const double thickness = scenario.membranes[i].thickness;
    if (!(thickness > most * width)) continue;
    most = thickness / width;
    what = fmt::format(
        "looking for contacts, which takes long where membranes are much thicker than their facets "
        "or bars are wide: the thickness of \"{}\" is {:.3g} m, {:.3g} times the width of one; "
        "make it thinner, or its mesh coarser",
        membrane.name, thickness, most);
  }
  return what;
}

}  // namespace

PreparedRun prepare_run(const Scenario& scenario, const HearSetUp& hear) {
  PreparedRun prepared;
  prepared.built = build_scene(scenario, hear);
  if (hear) hear(looking_for_contacts(scenario, prepared.built), 0.0);
  if (scenario.stage) prepared.bodies = first_stage(prepared.built);
  prepared.simulation = simulation_of(scenario, prepared.built);
  prepared.duration = scenario.simulation.duration;
  // What is left of what breaks may be nothing that a step could be chosen for.
  const bool has_step =
      scenario.simulation.time_step || std::isfinite(prepared.simulation->time_step());
  for (std::string& warning : warnings_about_breaks(prepared.built, *prepared.simulation)) {
    if (!has_step) throw InputError(warning);
    prepared.built.warnings.push_back(std::move(warning));
  }
  choose_time_step(scenario, *prepared.simulation);
  prepared.start = initial_contacts(scenario, prepared.built, *prepared.simulation,
                                    first_contacts(*prepared.simulation));
  for (std::string& warning : warnings_about(prepared.start, scenario))
    prepared.built.warnings.push_back(std::move(warning));
  for (std::string& warning : warnings_about_units(scenario))
    prepared.built.warnings.push_back(std::move(warning));
  for (std::string& warning : warnings_about_stiffness(scenario, prepared.built))
    prepared.built.warnings.push_back(std::move(warning));
  for (std::string& warning :
       warnings_about_solids(scenario, prepared.built, prepared.simulation->scene()))
    prepared.built.warnings.push_back(std::move(warning));
  return prepared;
}

RunReport run(const Scenario& scenario, PreparedRun& prepared, const RunSettings& settings) {
  require_possible_start(prepared.start, scenario);
  const RunStart start = start_of(scenario, prepared);
  const bool goes_on = settings.resume != nullptr && settings.resume->same_folder;
  if (goes_on) require_same_outputs(settings.resume->state, scenario);
  // Before any file is touched: it may be the state of another scene.
  if (settings.resume != nullptr && !settings.resume->is_there)
    prepared.simulation->restore(settings.resume->state);
  std::optional<OutputFolderLock> lock;
  by_first_rank(scenario.simulation.ranks, [&] {
    make_output_folder(settings.out);
    lock.emplace(settings.out);
    if (!settings.overwrite && !goes_on) refuse_results(settings.out, "run", kResultFiles);
    refuse_other_measures(settings.out, scenario);
    remove_parts(settings.out);
    if (settings.overwrite && !goes_on && has_any_result(settings.out))
      remove_pictures(settings.out);
    // What came after is computed again, now perhaps with other intervals.
    goes_on ? remove_checkpoints_after(settings.out, prepared.simulation->steps())
            : remove_checkpoints(settings.out);
    if (goes_on) return;
    remove_report(settings.out);
    write_scenario_copy(settings.out, scenario);
  });
  Run all(scenario, prepared, settings, start);
  // Of a run that goes on when it is known that it can: its files are those that it had.
  by_first_rank(scenario.simulation.ranks, [&] {
    if (!goes_on) return;
    remove_report(settings.out);
    update_scenario_copy(settings.out, scenario);
  });
  if (lock) all.warn(lock->warning());
  return all.execute();
}

}  // namespace plekton::apps
