// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/run_report.hpp"
#include "dynamics/time_step/motion_step.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace plekton::apps {

/// Overlap over radius above which a contact is no small deformation any more.
inline constexpr double kDeepOverlap = 0.05;
/// Deep overlaps that are less than this apart count as the same: who is in whom is looked at anew
/// where the largest has grown by so much.
inline constexpr double kSameOverlap = 0.01;
/// Closure error over the energy that went through, above which the motion cannot be trusted.
inline constexpr double kPoorClosure = 0.01;
/// Energy lost or made where contacts are handed on over the energy that went through, above which
/// it is worth to know of it: a tenth of what a closure error may be.
inline constexpr double kMuchTracking = 0.1 * kPoorClosure;
/// Momentum that contacts, bonds and sheets make from nothing over what they carry, above which it
/// is no rounding: that of a sum of a million forces is below 1e-12 of them, and that of places far from
/// the origin, a hundred thousand times as far as the scene is wide, about 1e-11.
inline constexpr double kMomentumDrift = 1e-10;
/// Signs of a node in a step that took arithmetic of any length, above which that is much of the
/// work: one takes some microseconds, a grain in a step one or less.
inline constexpr double kManyExactDecisions = 1.0;
/// Motion in a step over the smallest radius above which contacts are seen late. A chosen step
/// comes to kLargestMotion itself but for rounding.
inline constexpr double kFastMotion = 1.001 * dynamics::kLargestMotion;

/// Something that a run is judged by.
struct Check {
  std::string_view name;
  double value = 0.0;
  double limit = 0.0;       ///< above which it is red; infinite: it is told, and never red
  bool in_percent = false;  ///< how people read it
  std::string advice;       ///< what is wrong and what to do about it, where there is anything
  std::string text;         ///< in place of the value, of what is no number

  bool is_red() const noexcept { return !(value <= limit); }
};

/// The certificate of a run: all that can make its results doubtful, with a verdict on each.
std::vector<Check> certificate_of(const RunReport& report);

/// That of it that is the same for any number of threads, and for a run that goes on from a
/// checkpoint.
std::vector<Check> certificate_of_motion(const RunReport& report);

/// Whether anything in it is red.
bool has_red(const std::vector<Check>& certificate);

/// As in "certificate: 11 of 12 green; red: largest_overlap_ratio 6.2 % (at most 5 %)".
std::string summary_of(const std::vector<Check>& certificate);

/// The advice of what is red.
std::vector<std::string> warnings_about(const RunReport& report);
/// Adds it to the warnings of the report.
void add_warnings_to(RunReport& report);

}  // namespace plekton::apps
