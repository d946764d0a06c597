// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/stage_settings.hpp"
#include "apps/scene/build_scene.hpp"
#include "dynamics/simulation.hpp"

#include <stdexcept>
#include <string>

namespace plekton::apps {

/// A stage whose end has not come in time.
struct StageFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Looks whether what is to end a stage, or a run before its duration is over, has come.
class EndWatch {
 public:
  /// How many looks in a row count.
  struct Looks {
    int at_kinetic_energy;
    int at_forces;  ///< of servos, of reactions, and unbalanced ones
  };
  /// In a row: a force that swings through the wanted one has not reached it, and a few grains that
  /// strike hard make the mean force that contacts carry large for a moment.
  static constexpr Looks kOfStages{10, 10};
  /// Kinetic energy swings too, but a run that is at rest ends at once.
  static constexpr Looks kOfRuns{1, 10};

  /// @param start  of the stage or run
  /// @param built  all must outlive this
  EndWatch(const StageEnd& end, const StageStart& start, const BuiltScene& built, Looks looks)
      : end_(end), start_(start), built_(built), looks_(looks) {}

  /// To be called every so many steps. @returns what has ended it, as in "unbalanced_force"; empty:
  /// it goes on
  std::string look(const dynamics::Simulation& simulation);

  /// How far all of it is off.
  std::string state(const dynamics::Simulation& simulation) const;

  void exchange(const geometry::StateArchive& archive);

 private:
  /// What looks have seen of an end: bodies that are let go have no kinetic energy either.
  struct Seen {
    bool was_off = false;  ///< whether it has not held at some look
    int in_a_row = 0;      ///< looks, the last ones, at which it has held
  };
  bool counts(bool holds, Seen& seen, double time) const {
    return counts(holds, seen, time, looks_.at_forces);
  }
  bool counts(bool holds, Seen& seen, double time, int looks) const;
  /// What to say of an end that has held from the start, and so does not count.
  std::string all_along(const Seen& seen) const;
  bool is_beyond(const ForceEnd& end, const dynamics::Simulation& simulation) const;
  double moved(const DisplacementEnd& end, const dynamics::Simulation& simulation) const;
  double strain_of(const StrainEnd& end, const dynamics::Simulation& simulation) const;
  double force_of(const ForceEnd& end, const dynamics::Simulation& simulation) const;

  const StageEnd& end_;
  const StageStart& start_;
  const BuiltScene& built_;
  Looks looks_;
  Seen kinetic_energy_;
  Seen unbalanced_;
  Seen servo_;
  Seen force_;
};

/// Looks whether a stage has ended.
class StageWatch {
 public:
  /// @param start  of the stage
  /// @param built  all must outlive this
  StageWatch(const StageSettings& stage, const StageStart& start, const BuiltScene& built)
      : stage_(stage), start_(start), ends_(stage.end, start, built, EndWatch::kOfStages) {}

  /// s, at which it ends or fails at the latest.
  double latest() const noexcept { return start_.time + stage_.longest(); }

  /// As of EndWatch.
  std::string look(const dynamics::Simulation& simulation) { return ends_.look(simulation); }

  /// What has ended it at latest(). @throws StageFailed with how far its ends are off
  std::string end_in_time(const dynamics::Simulation& simulation) const;

  void exchange(const geometry::StateArchive& archive) { ends_.exchange(archive); }

 private:
  const StageSettings& stage_;
  const StageStart& start_;
  EndWatch ends_;
};

}  // namespace plekton::apps
