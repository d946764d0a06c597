// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/near_complex.hpp"
#include "contact/spanning_weights.hpp"

#include <span>
#include <vector>

namespace plekton::contact {

/// A level at which rings are born or filled: a pass whose branches hang together already, or a
/// top.
struct RingEvent {
  double level;          ///< m
  std::uint32_t vertex;  ///< for the caller
  int rings;             ///< born minus filled
};

/// What the holes of a surface near a point get back, because contacts are counted by pieces and
/// the coefficients of critical features count pieces minus holes (patch.hpp).
///
/// At every level each hole is one, shared over the links of the rings around it; a link stands for
/// its upper vertex. The shares are integrated over the levels from the first event to the range.
/// They are smooth between events, so one interval takes those of its middle: an interval vanishes
/// where two events meet, so this is continuous, and exact to the second order in its length.
class RingWeights {
 public:
  /// What a foot point gets: the integral of its shares (m), over its overlap.
  struct Share {
    const NearComplex::Vertex* foot;
    double weight;
  };

  /// Keeps its working space, so that a warm call does not allocate.
  /// @param cells   ascending; every cell nearer than range
  /// @param events  ascending
  /// @returns       nearest first; valid until the next call
  std::span<const Share> find(const geometry::Surface& surface, const Vec3& point, double range,
                              std::span<const geometry::CellId> cells, Positions x,
                              std::span<const RingEvent> events);

  /// The same for a structure without facets, whose rings nothing fills: the shares of the last
  /// level instead of the integral, which change continuously with the position already and cost
  /// less.
  std::span<const Share> find_of_wires(const geometry::Surface& surface, const Vec3& point,
                                       double range, std::span<const geometry::CellId> cells,
                                       Positions x);

  /// By event of the last call: how many hollows it closes. The top that shuts the last opening of
  /// a closed surface fills no ring, and no piece begins with it.
  std::span<const int> hollows() const noexcept { return hollows_; }

 private:
  void add_interval(double lower, double upper);
  void find_hollows(std::span<const RingEvent> events);

  NearComplex near_;
  HarmonicShares shares_of_holes_;
  SpanningWeights spanning_;
  std::vector<double> sums_;     ///< m, by vertex of near_
  std::vector<int> ring_count_;  ///< by event, in the interval above it; -1 of one left out
  std::vector<int> hollows_;
  std::vector<Share> shares_;
};

}  // namespace plekton::contact
