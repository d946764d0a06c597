// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/state_hashes.hpp"
#include "apps/scene/build_scene.hpp"
#include "dynamics/measures/energy.hpp"
#include "dynamics/measures/momentum_balance.hpp"
#include "geometry/base/predicates.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plekton::apps {

/// How a run ended.
enum class RunStatus : std::uint8_t {
  finished,     ///< the duration is over
  at_rest,      ///< [stop] found it so: by its kinetic energy or unbalanced force
  interrupted,  ///< by a signal
  failed        ///< by an error; see the message
};
std::string_view name_of(RunStatus status) noexcept;

/// Who was in whom, where and when.
struct DeepestOverlap {
  std::string a;  ///< as in "grains.sand grain 3"
  std::string b;
  double depth = 0.0;         ///< m
  double ratio = 0.0;         ///< as of BodyOverlap
  Vec3 place = Vec3::Zero();  ///< m
  double time = 0.0;          ///< s
};

/// Names by number, as the arrays of frames have the numbers. That of a plane may be empty.
struct TableNames {
  std::vector<std::string> materials;
  std::vector<std::string> grains;
  std::vector<std::string> membranes;
  std::vector<std::string> planes;
};

TableNames names_of(const Scenario& scenario);

/// What a run was asked to do and what came of it: the content of run.json.
struct RunReport {
  RunStatus status = RunStatus::finished;
  std::string message;  ///< of the error, if failed

  int vector_width = 2;           ///< numbers in the vectors of the kernels
  std::string date;               ///< when it began, as in "2026-05-01T12:00:00Z"
  std::string host;               ///< name of the machine
  std::optional<double> resumed;  ///< s, from where it went on; wall times count from there
  std::string scenario;
  std::vector<std::string> overrides;
  std::optional<double> duration = std::nullopt;  ///< s, asked for; nothing of stages
  int threads = 1;                                ///< of each rank
  int ranks = 1;                                  ///< processes that computed it together
  std::uint64_t seed = 0;
  double damping = 0.0;

  TableNames names;

  std::size_t grains = 0;
  std::size_t nodes = 0;
  std::size_t facets = 0;
  std::size_t cylinders = 0;
  std::size_t bonds = 0;
  std::size_t broken_bonds = 0;  ///< at the end
  std::size_t torn_facets = 0;   ///< of sheets, at the end
  std::size_t ties = 0;
  std::size_t broken_ties = 0;  ///< at the end
  std::size_t planes = 0;
  std::size_t contacts = 0;  ///< at the end
  std::size_t frames = 0;

  double simulated_time = 0.0;  ///< s
  std::int64_t steps = 0;
  std::int64_t resumed_step = 0;  ///< from which wall times count
  double time_step = 0.0;         ///< s, at the end
  bool chose_time_step = false;   ///< at the end, as none was given
  double start_up_time = 0.0;     ///< s, from reading the scenario to the first step
  double wall_time = 0.0;         ///< s, without reading the scenario and building its scene
  double output_time = 0.0;       ///< s, of the wall time: frames and rows of energy.csv

  double largest_overlap_ratio = 0.0;
  /// The overlap with that ratio to within kSameOverlap; nothing where none was above kDeepOverlap.
  std::optional<DeepestOverlap> deepest_overlap;
  std::int64_t pass_throughs = 0;     ///< of grain centres through facets and cylinders
  std::size_t most_crossings = 0;     ///< of facets and cylinders through each other, at a time
  double dt_over_critical = 0.0;      ///< the largest at any look
  double largest_motion_ratio = 0.0;  ///< likewise: motion in a step over the smallest radius
  dynamics::Energy energy;            ///< at the end
  /// Closure error over the energy that went through; 0 where that is no more than rounding.
  double energy_closure = 0.0;
  /// Energy lost or made in tracking, in magnitude and at most so far, over the same.
  double tracking_ratio = 0.0;
  dynamics::MomentumDrift momentum;
  /// Signs that a double could not tell, by all threads of the program in the steps that it took;
  /// how many of them there are depends on the threads.
  geometry::SignCounters exact_decisions;
  std::size_t lost_grains = 0;
  std::size_t lost_through_membranes = 0;
  std::size_t lost_out_of_bounds = 0;
  StateHashes states;
  std::vector<std::string> warnings;
  std::vector<std::string> stages;  ///< that have ended, each a JSON object
  std::string ended_by;             ///< what ended the last of them
  std::string stopped_by;           ///< what of [stop] ended it, as in "force"; empty: nothing
};

/// Signs that took arithmetic of any length, of a node and a step that this part of the run took.
inline double exact_decisions_per_node(const RunReport& report) noexcept {
  const double steps = static_cast<double>(report.steps - report.resumed_step);
  const double looks = steps * static_cast<double>(report.nodes);
  return looks > 0.0 ? static_cast<double>(report.exact_decisions.exact) / looks : 0.0;
}

/// ms, of a step that this part of the run took; 0 if there was none.
inline double ms_per_step(const RunReport& report) noexcept {
  const std::int64_t steps = report.steps - report.resumed_step;
  return steps > 0 ? 1e3 * report.wall_time / static_cast<double>(steps) : 0.0;
}

/// The report as a JSON object.
std::string to_json(const RunReport& report);

/// A stage that has ended, for RunReport::stages: when, by what, and the certificate of the run up
/// to there.
struct EndedStage {
  std::string name;
  std::string ended_by;
  double start = 0.0;  ///< s
};
std::string to_json(const EndedStage& stage, const RunReport& report);

/// Writes run.json into a folder, complete or not at all. @throws dynamics::OutputError
void write_run_report(const std::filesystem::path& folder, const RunReport& report);
/// Removes that, as far as it is there.
void remove_report(const std::filesystem::path& folder);

}  // namespace plekton::apps
