// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/stiffness/contact_springs.hpp"
#include "dynamics/stiffness/spring_shares.hpp"
#include "dynamics/time_step/motion_step.hpp"
#include "dynamics/time_step/spread_stiffness.hpp"
#include "dynamics/time_step/step_limits.hpp"
#include "dynamics/time_step/wall_collisions.hpp"

#include <cstdint>
#include <limits>
#include <vector>

namespace plekton::geometry {
class StateArchive;
}

/// How a simulation chooses its time step.
///
/// What counts is what holds the nodes now and what may come to hold them until the step is looked
/// at again. Two bodies that are g apart touch only after one of them has moved by g / 2. So at a
/// look a way is fixed that nodes and planes may go until the next one; contacts that are nearer
/// than twice that way count as if they touched, and laws that get stiffer with the overlap as if
/// they were deeper by that. The next look comes before any of them has gone so far, by what the
/// fastest went in each step, after kStepsBetweenLooks steps at the latest, and whenever a list of
/// pairs is made anew: what is not in a list cannot touch before the next one. It comes after the
/// contacts of a step are known and before they act. So no kick and no drift is chosen without a
/// contact that acts in it.
///
/// What remains until the next look is how much the weights of the nodes of a facet change as a
/// contact slides on it, and what tension does: kSafety leaves a factor of (kLargestStep /
/// kSafety)² = 1.5 in the stiffness for these. In a search over some hundred random scenes
/// (near_step_test.cpp) no step was above 0.65 of the limit of its moment, so that nothing of it
/// was used.
///
/// Where a contact spreads over many features it is not enough: a boulder that presses a net in by
/// several times the thickness of its wires is twice or half as stiff from one step to the next, as
/// pieces of the contact merge and part. Where what spreads has changed by more than that factor
/// since the last regular look, looks follow each other after kStepsOfChange steps until there was
/// no such change between two regular ones. As a step grows slowly it then keeps to the stiffest of
/// many looks.
///
/// Beside what is stable a chosen step follows collisions (ContactSprings::collision_step(),
/// WallCollisions, ExpectedContacts::collision_step()), wires that become taut or slack
/// (ContactSprings::ending_step()), bars and ties that are crushed to nothing, motion
/// (motion_step.hpp) and spin.
namespace plekton::dynamics {

/// A chosen step grows by no more than this in kStepsBetweenLooks steps: the leapfrog keeps
/// energies while its step changes slowly.
constexpr double kGrowth = 1.1;
/// The way that nodes may go until a chosen step is looked at again is below this part of the
/// smallest radius, unless a single step is longer. The longer it is the more contacts count that
/// are still to come, and the shorter it is the more often they are counted.
constexpr double kLongestWay = 0.1;

/// A look at what spreads that has changed is followed by the next one after so many steps. Five
/// boulders of 300 to 800 kg/m³ in a net (defects_test.cpp), and one in a larger net, made 3 to 16 %
/// of the energy that went through with 64, up to 0.27 % with 4 and 0.08 % with 2.
constexpr std::int64_t kStepsOfChange = 2;

/// How fast a simulation is.
struct Pace {
  std::int64_t steps;  ///< so far
  double speed;    ///< m/s, of anything that moves, now or by what loads say until the next look
  double gravity;  ///< m/s², the largest there may be
};

/// s, that pass at most until a chosen step is looked at again, with the drift that begins then.
/// @param dt  s, the step before
constexpr double longest_to_next_look(double dt) noexcept {
  return static_cast<double>(kStepsBetweenLooks + 1) * kGrowth * dt;
}

class StepChooser {
 public:
  /// @param of, limits  what the one refers to and the other itself must outlive this
  StepChooser(const Resistance& of, const StepLimits& limits);

  /// The first step (s). Again, as for a scene that goes on from another: no longer than before.
  /// @param critical  s, StepLimits::critical()
  /// @param space     for all nodes
  double first(double critical, NodalStiffness space, const Pace& pace);

  /// Whether the step has to be looked at before the contacts of this step act.
  /// @param dt    s, as it is
  /// @param spin  rad/s, of the node that spins fastest
  bool is_due(std::int64_t steps, double dt, double spin) const noexcept;
  /// @param dt  s, the last one
  /// @returns the next steps (s)
  double choose(double dt, const Pace& pace);
  /// @param way  m, of any node or plane in a step
  void moved(double way) noexcept;

  /// s, the last step chosen: what is shorter since may be as long again after the next look.
  double last_chosen() const noexcept { return step_; }

  /// Something has become stiffer without moving: the next step is looked at.
  void look_again() noexcept { look_.longest_way = -1.0; }

  /// What is known from the last look.
  void exchange(const geometry::StateArchive& archive);

 private:
  double stable_near(double margin, double last);
  double step_of_wires(double margin);
  double step_of_bars() const;
  double step_of_ties();
  double step_of_meeting(double margin) const;
  double step_of_spin() const;
  bool structures_touch() const;
  void plan_next_look(std::int64_t steps);
  void add_near_structures(double margin, double rate);

  Resistance of_;
  const StepLimits* limits_;
  double pace_radius_;             ///< m, against which the motion in a chosen step is measured
  double thinnest_;                ///< m, smallest radius of a structure; infinite without any
  NodalStiffness space_{0};        ///< of all nodes, so that no look allocates
  ContactSprings springs_;         ///< of the last look
  ContactSprings wires_;           ///< likewise, that are taut or may be
  ContactSprings tied_;            ///< likewise, a tie that pushes
  SpringShares shares_;            ///< working space of a look
  SpreadStiffness spread_;         ///< likewise; goes on from look to look
  StructureStiffness structures_;  ///< likewise
  WallCollisions walls_;           ///< likewise
  std::vector<ExpectedOfNode> of_structures_;  ///< by node, of a contact with another structure
  std::vector<char> is_counted_;               ///< by node, working space of a look
  /// What is known from the last look to the next one.
  struct LastLook {
    std::int64_t lists = 0;    ///< of contact::Contacts::list_count()
    double way = 0.0;          ///< m, no node or plane has gone further since
    double longest_way = 0.0;  ///< m, for which it is good
  };
  LastLook look_;
  std::int64_t steps_between_ = kStepsBetweenLooks;  ///< looks at the latest
  /// 1/s², SpreadStiffness at the looks since the last regular one.
  double least_spread_ = 0.0;
  double most_spread_ = 0.0;
  double way_in_a_step_ = 0.0;                             ///< m, the last one
  double step_ = std::numeric_limits<double>::infinity();  ///< s, the last one chosen
  double collision_step_;                                  ///< s, ExpectedContacts
};

}  // namespace plekton::dynamics
