// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/state_archive.hpp"

#include <cstddef>
#include <limits>
#include <vector>

namespace plekton::contact::structure {

/// Which of many pairs need no look because they were far enough apart not long ago.
///
/// A core is the set of the means sum w_k x_k of its corners, w_k >= 0 of sum 1. If no node moves
/// by more than u, no point of a core does, and the distance of two cores shrinks by at most 2 u.
/// So cores that are c further apart than the range of their contact stay out of range until the
/// nodes have gone c / 2; the way of the fastest node in every step, added up, is not less than
/// what any of them goes.
///
/// Rounding: a step x += v dt is rounded twice, by at most eps / 2 of the way and of the coordinate
/// in each of three components, and a distance by a few eps of the coordinates: four eps of each
/// for every step pay for all of it, 1e-9 of the clearance for the sums of a million steps.
class Clearances {
 public:
  /// Of as many new pairs, that all need a look.
  /// @param furthest  m, largest coordinate of a node of the cores
  void reset(std::size_t count, double furthest) {
    due_.assign(count, 0.0);
    gone_ = 0.0;
    furthest_ = furthest;
  }

  /// Of no pairs: those of another list are to come.
  void clear() noexcept { due_.clear(); }
  std::size_t size() const noexcept { return due_.size(); }

  void exchange(const geometry::StateArchive& archive) {
    archive.fixed("due", due_, "pairs of cells");
    archive("gone", gone_);
    archive("furthest", furthest_);
  }

  /// @param way  m, how far any node has moved at most since the last call, but for rounding; finite
  void move(double way) { gone_ += (1.0 + kRounding) * way + kRounding * (furthest_ + gone_); }

  /// Calls visit(pair) for all that may be in range, in ascending order.
  template <class Visit>
  void for_each_due(Visit&& visit) const {
    for (std::size_t pair = 0; pair < due_.size(); ++pair) {
      if (!(gone_ < due_[pair])) visit(pair);
    }
  }

  /// Whether a pair may be in range, or so much (m) out of it, for all that is known. Of pairs that
  /// are listed anew nothing is known before the next step.
  bool may_be_within(std::size_t pair, double margin) const noexcept {
    return pair >= due_.size() || !(gone_ + 0.5 * margin < due_[pair]);
  }

  /// @param clearance  m, by how much a pair is at least out of range now; less than 0: it is not
  void set(std::size_t pair, double clearance) {
    const double certain = (1.0 - 1e-9) * clearance - 2.0 * kRounding * (furthest_ + gone_);
    due_[pair] = certain > 0.0 ? gone_ + 0.5 * certain : 0.0;
  }

 private:
  static constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();

  std::vector<double> due_;  ///< m, what nodes may go before the pair needs a look
  double gone_ = 0.0;        ///< m, no node has gone further since reset
  double furthest_ = 0.0;    ///< m, largest coordinate at reset
};

}  // namespace plekton::contact::structure
