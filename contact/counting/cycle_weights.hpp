// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/counting/cycle_flows.hpp"
#include "contact/counting/level_complex.hpp"

#include <limits>
#include <span>
#include <vector>

namespace plekton::contact {

/// What the holes of a surface near a point get back, because contacts are counted by pieces and a
/// saddle that closes a cycle joins none (patch.hpp).
///
/// A hole is there from the level at which a saddle closes the cycle around it to the level at
/// which a maximum fills it, or to the range. With phi(d) the energy of one contact at a distance
/// d, pieces alone are counted if each hole gives back phi where it begins. But that jumps from
/// saddle to saddle where two of them tie, and so does its gradient. So each link of the cycle has
/// a say, the shallower it is the more: a hole gives back the sum of share * phi(upper vertex) over
/// the links around it, with the shares of the flow that is gone with the hole (cycle_flows.hpp).
/// With overlaps o below the range and that of the maximum t (0 at the range) a link from o_u down
/// to o_l resists (o_u^2 - t^2)^-n - (o_l^2 - t^2)^-n. So
///   - where one saddle is shallower than the others by far, or all are on one level, the hole
///     gives back phi there exactly;
///   - resistances in a row add up, so a saddle and a minimum, or a saddle and a maximum, that are
///     born together change nothing but what they add themselves; nor does what comes into range;
///   - shares change with the overlaps, and the force has the part that comes of that. So it is the
///     gradient of the sum of weight * phi(distance) on the sphere and on every node, for every
///     law.
///
/// With n = 12 a cycle of springs with a deeper saddle is off by 0 to 2.5 % of the energy of
/// its shallowest one, with four of them by 0 to 6.4 %; what is given back too much is about in
/// proportion to 1 / n. Where bars alone are in range it is never too little: shares are chances of
/// links to be left out of a forest, pieces are what the best forest leaves, and the mean over all
/// forests is no less. So a sphere is never pushed by less than one contact. On nets with up to 240
/// meshes in range it adds up: one contact is up to 1.5. Where cycles are filled one after the
/// other, what the mean over forests gives too much at each level is taken off again with what is
/// left there, as of the level before: so as much as 6.4 % for a cycle that is left may be missing.
/// Seen is 0.13 % of one contact of a sphere on facets, and 1 % of the pieces of a chain on a net.
///
/// The force is continuous but where two maxima tie that end holes with common saddles: there
/// shares at the level of the one become shares at that of the other. A cycle of two saddles, with
/// overlaps such that o_1^2 - t^2 is q times o_2^2 - t^2, has a share w = 1 / (1 + q^n) of the
/// deeper one; as that changes with t the energy of springs changes by t n w (1 - w) (q - 1)^2 / q,
/// at most by 0.037 of the force of one contact at the maximum, and the force jumps by that times
/// the difference of the directions of both maxima. No energy comes or goes with it. Maxima that
/// tie but for rounding have equal parts, so symmetric bodies feel symmetric forces.
class CycleWeights {
 public:
  /// Of the range: rounding of a difference of distances. A hole that is there over no more than
  /// that ends as it begins, and gives back the energy at its end. Saddle and maximum stand within
  /// a range times sqrt(2 kLeastLife) of each other, so the force jumps by 4e-8 of that of one
  /// contact at most.
  static constexpr double kLeastLife = 4.0 * std::numeric_limits<double>::epsilon();

  /// What a foot point gets.
  struct Share {
    std::uint32_t vertex;  ///< of the complex
    double weight;         ///< of the energy of one contact there
    double slope;  ///< N, how much the energy grows with the overlap there as weights change
  };

  /// Keeps its working space, so that a warm call does not allocate.
  /// @param complex   all of it is nearer than range; must outlive the call
  /// @param range     m
  /// @param energies  J, of one contact at each vertex
  /// @returns         minima, saddles and what holes give back, all that is not 0, nearest first;
  ///                  valid until the next call
  std::span<const Share> find(const LevelComplex& complex, double range,
                              std::span<const double> energies);

  /// The lowest of the vertices that hang together with one.
  std::uint32_t root_of(std::uint32_t vertex) const noexcept {
    return flows_.basis().root_of(vertex);
  }

 private:
  /// Where holes end.
  struct End {
    double level;                           ///< m
    std::uint32_t first, end;               ///< vertices that tie there; those that fill cycles
    std::span<const std::uint32_t> maxima;  ///< that tie there; none at the range
  };
  std::span<const std::uint32_t> maxima_at(double level) const noexcept;
  bool is_at(double level, std::uint32_t vertex) const noexcept;
  void count_pieces();
  void end_holes(const End& end);
  void set_overlaps(const End& end);
  void set_resistances();
  void share_out();
  void add_slopes(const End& end);

  const LevelComplex* complex_ = nullptr;  ///< of the last find(), as the next
  CycleFlows flows_;
  double range_ = 0.0;  ///< m
  std::span<const double> energies_;
  std::vector<double> weights_, slopes_;
  std::vector<Share> shares_;
  // Of one end, in units of the deepest overlap.
  double level_overlap_ = 0.0;       ///< overlap of the level
  std::vector<double> overlaps_;     ///< by vertex
  std::vector<double> inverses_;     ///< by vertex: 1 / (overlap^2 - level overlap^2)
  std::vector<double> resistances_;  ///< by link
  std::vector<char> is_level_;       ///< by link: both vertices are at one distance
  std::vector<double> values_;       ///< J, by link
};

}  // namespace plekton::contact
