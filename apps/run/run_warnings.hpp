// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/run/run_report.hpp"
#include "dynamics/time_step/motion_step.hpp"

#include <string>
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
/// Motion in a step over the smallest radius above which contacts are seen late. A chosen step
/// comes to kLargestMotion itself but for rounding.
inline constexpr double kFastMotion = 1.001 * dynamics::kLargestMotion;

/// What in a report makes its results doubtful, each with what to do about it: deep overlaps,
/// steps too long for the motion, energy that does not add up or comes from tracking, lost grains.
std::vector<std::string> warnings_about(const RunReport& report);

}  // namespace plekton::apps
