// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/hollow_shares.hpp"
#include "contact/near_complex.hpp"
#include "contact/spanning_weights.hpp"

#include <span>
#include <vector>

namespace plekton::contact {

/// What the holes of a surface near a point get back, because contacts are counted by pieces and
/// the coefficients of critical features count pieces minus holes (patch.hpp).
///
/// At every level each hole is one, shared over the links of the rings around it; a link stands for
/// its upper vertex. The shares are integrated over the levels from the first event to the range.
/// They are smooth between events, so one interval takes those of its middle: an interval vanishes
/// where two events meet, so this is continuous, and exact to the second order in its length. A
/// pass and the top that fills its ring may also be born together, in the middle of an interval;
/// tops are nodes, so intervals end at every node as well, whether it is an event or not.
///
/// A top that shuts the last opening of a closed surface fills no ring, and no piece begins with
/// it: it shuts a hollow, and coefficients count pieces minus holes plus hollows. So at every level
/// each hollow takes one back, shared over the corners of the facets around it with the weights
/// overlap^-2 (hollow_shares.hpp). Corners are there for as long as their facets are and no event
/// moves one to another, so with any smooth weights this is continuous. With these the top that
/// shuts a hollow has the whole share at first and takes back all that it adds, so the force has
/// not even a kink; as the hollow deepens its other corners take their part. A small closed body
/// deep inside the ball pushes once, from about its middle.
class RingWeights {
 public:
  /// What a foot point gets: the integral of its shares (m), over its overlap.
  struct Share {
    const NearComplex::Vertex* foot;
    double weight;
  };

  /// Keeps its working space, so that a warm call does not allocate.
  /// @param cells   ascending; every cell nearer than range
  /// @param events  ascending: levels (m) at which rings are born, or tops fill them or shut
  ///                hollows
  /// @returns       nearest first; valid until the next call
  std::span<const Share> find(const geometry::Surface& surface, const Vec3& point, double range,
                              std::span<const geometry::CellId> cells, Positions x,
                              std::span<const double> events);

  /// The same for a structure without facets, whose rings nothing fills: the shares of the last
  /// level instead of the integral, which change continuously with the position already and cost
  /// less.
  std::span<const Share> find_of_wires(const geometry::Surface& surface, const Vec3& point,
                                       double range, std::span<const geometry::CellId> cells,
                                       Positions x);

 private:
  void list_levels(std::span<const double> events);
  void add_interval(double lower, double upper);
  void take_hollows(std::uint32_t below, double level, double length);

  NearComplex near_;
  HarmonicShares shares_of_holes_;
  HollowShares hollows_;
  SpanningWeights spanning_;
  std::vector<double> corner_weights_;  ///< 1/m^2, by vertex of near_
  std::vector<double> levels_;          ///< m
  std::vector<double> sums_;            ///< m, by vertex of near_
  std::vector<Share> shares_;
};

}  // namespace plekton::contact
