// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace plekton::dynamics {

/// The moment at which loads act, between two drifts.
struct LoadStep {
  double time;    ///< s, now
  double before;  ///< s, length of the drift that ends now; 0 at the start
  double after;   ///< s, length of the drift that begins now
};

/// Work (J) of loads over half of a drift.
struct LoadWork {
  double external = 0.0;  ///< done on the bodies
  double damped = 0.0;    ///< taken by viscous damping
};

}  // namespace plekton::dynamics
