// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/closest/primitive_pairs.hpp"

#include <optional>

namespace plekton::geometry {

/// A primitive during a step: every corner moves along a line, so that it may stretch and turn as
/// well. t goes from 0 to 1.
struct MovingProbe {
  Core from;      ///< m, at t = 0
  Core to;        ///< m, at t = 1; as many corners
  double radius;  ///< m, >= 0

  static MovingProbe resting(const Probe& probe) { return {probe.core, probe.core, probe.radius}; }
  static MovingProbe translated(const Probe& probe, const Vec3& way);
};

/// m, >= 0; 0 asks for what rounding allows (see first_contact()).
struct ContactTolerance {
  double length = 0.0;
};

/// When two moving primitives come into contact.
struct FirstContact {
  double t;             ///< not later than the contact; 0 if they overlap from the start
  Proximity proximity;  ///< at t; the core points name corners as proximity() of two probes does
};

/// The first contact of two moving primitives in a step, by conservative advancement: a plane that
/// separates them with a margin goes on doing so until their supports along its normal, which are
/// linear in time for linear motion of corners, have used the margin up (after Mirtich,
/// Impulse-based Dynamic Simulation of Rigid Body Systems, PhD thesis, Berkeley 1996).
///
/// Certified: whatever rounding does, t is not later than the true contact, and no answer means
/// that there is none in the step. The gap at t is at most the tolerance, or 1e-13 of the size of
/// both with their ways and 64 ulps of their coordinates if that is more; primitives that pass each
/// other that closely may be reported. Only motion that turns while it stays about as close as the
/// tolerance may use up the 10 000 steps that are taken at most; then t is still not later, and the
/// gap says how far they are.
/// @returns nothing if they stay apart
/// @throws std::invalid_argument for numbers that no distance can be taken of (as SurfaceQuery),
/// for corners that differ in number at both ends, a tolerance that is negative or not finite
std::optional<FirstContact> first_contact(const MovingProbe& a, const MovingProbe& b,
                                          ContactTolerance tolerance = {});

}  // namespace plekton::geometry
