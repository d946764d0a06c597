// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/counting/cycle_weights.hpp"
#include "contact/surface_surface/clearances.hpp"
#include "contact/surface_surface/cycle_search.hpp"
#include "contact/surface_surface/pair_term.hpp"
#include "contact/surface_surface/product_complex.hpp"
#include "contact/surface_surface/term_parts.hpp"
#include "contact/surface_surface/wrapped_joints.hpp"
#include "geometry/base/function_ref.hpp"
#include "geometry/base/thread_pool.hpp"
#include "geometry/critical/product_features.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::contact::structure {

/// All pairs of features of the listed pairs of cells, and what they do in the present step.
///
/// A feature is a part of its cell: it is in range only if all pairs of cells that have it are, and
/// where their nearest points lie in it, these are its own. So pairs of cells are looked at first,
/// as far as they may be in range (clearances.hpp), and for most of their features nothing more has
/// to be found.
///
/// Their weights add up to Euler's number of what is in range. Where that is not the number of
/// pieces (cycle_search.hpp), because a saddle that closes a cycle takes one contact away that no
/// pieces have merged for, and the maximum that fills it adds one again, the rule for a sphere on a
/// surface holds (patch.hpp): contacts are counted by pieces, and a cycle gives back what its
/// saddle takes, smoothly (cycle_weights.hpp), here with the pairs of features of both bodies
/// (product_complex.hpp). With the weights W of that rule, and the w of all terms that stand at one
/// place, each place adds g * (W - sum of w) * phi(distance) to the energy. That is 0 where there
/// are pieces alone, and changes continuously from there on, as W does; for each energy of the law
/// the force is its gradient. g is the product of the point shares of all pairs of facets of the
/// part (point_share.hpp): 1 where none lie flat on each other, 0 where some do. There the area is
/// measured and nearest points are anywhere, so cycles of them mean nothing. As one g is for all of
/// a part, the energy leaps where a part with cycles comes to touch one that lies partly flat: seen
/// with 3 of 10 000 pairs of shells that are pressed through each other, by up to 20 % of what they
/// store. (With a g for each place, the mean of the product over all levels at which others hang
/// together with it, three that were tried did not leap, but cycles of all sheets that lie nearly
/// flat have to be found: two sheets of 10 x 10 squares on each other take more than 30 times as
/// long.)
///
/// The cost grows with the third power of the cycles of a part that something fills. So a part of
/// more than kMostCycles, as of a sheet that lies on a fine net, keeps what its terms add up to:
/// one contact less for each cycle, beside all that the extents of bars and facets count there. Its
/// energy jumps where it comes to have more.
class PairTerms {
 public:
  /// At 64 a sheet on a net takes 12 ms a step, six times what it takes without.
  static constexpr double kMostCycles = 64.0;

  explicit PairTerms(const geometry::Surface& surface) : surface_(&surface) {}

  /// @param pairs      sorted, each once
  /// @param spring_of  (lower structure, other one) -> its place among the springs of evaluate()
  void rebuild(std::span<const geometry::CellPair> pairs,
               geometry::FunctionRef<std::uint32_t(std::int32_t, std::int32_t)> spring_of);

  /// Finds which terms are in range, and their forces.
  /// @param springs  by the rows of the upper triangle of pairs of structures
  void evaluate(std::span<const NormalSpring> springs, const Motion& motion,
                geometry::ThreadPool& pool);

  bool empty() const noexcept { return terms_.empty(); }
  const PairTerm& operator[](std::size_t term) const noexcept { return terms_[term]; }
  std::span<const Holder> holders(const PairTerm& term) const noexcept {
    return {holders_.data() + term.first_holder, term.holder_count};
  }

  /// The term of both cells of a pair.
  const PairTerm& of_cells(std::uint32_t pair) const noexcept {
    return terms_[term_of_pair_[pair]];
  }

  /// What a spring does in a term of two cells in range by itself, without joints and cycles: the
  /// gradient of its own energy.
  PairForces own_forces(std::size_t term, const NormalSpring& spring, Positions x) const;

  /// Whether any of the listed pairs has a cylinder.
  bool have_bars() const noexcept { return have_bars_; }

  /// What attracts the features of a term in range, besides its forces; null if nothing does.
  const PairForces* attraction(std::size_t term) const noexcept {
    return attracts_.empty() || attracts_[terms_[term].spring] == 0 ? nullptr : &attractions_[term];
  }

  /// What the extent of two facets does that a term in range is of: a part of its forces; null if
  /// it is of anything else.
  const PairForces* extent(std::size_t term) const noexcept {
    const PairTerm& of = terms_[term];
    if (of.a.count != 3 || of.b.count != 3) return nullptr;
    return &extents_[holders(of).front().pair];
  }

  /// How many contacts a term in range gets back at joints of chains that wrap around something.
  double wrapped(std::size_t term) const noexcept { return joints_.contacts(term); }
  /// What joints of bars do to the other ends of these, besides the forces of a term of two cells
  /// in range; null if nothing does anything.
  const PairForces* at_ends(std::size_t term) const noexcept {
    const PairTerm& of = terms_[term];
    return of.is_of_cells ? joints_.on_pair(holders(of).front().pair) : nullptr;
  }
  /// The same of the attraction.
  const PairForces* attraction_at_ends(std::size_t term) const noexcept {
    const PairTerm& of = terms_[term];
    return of.is_of_cells ? joints_.attraction_on_pair(holders(of).front().pair) : nullptr;
  }

  /// Of a pair of cells in range at the last evaluate(): the corners of the features that hold its
  /// nearest points, of its first cell and of its second.
  std::array<geometry::FeatureNodes, 2> witness_features(std::uint32_t pair) const noexcept;

  /// Whether a pair of cells may be in range, or so much (m) out of it.
  bool may_be_within(std::uint32_t pair, double margin) const noexcept {
    return clearances_.may_be_within(pair, margin);
  }

  /// What is known of the pairs of cells from earlier steps: how long those out of range need no
  /// look, which features held the nearest points of the others.
  void exchange(const geometry::StateArchive& archive);

  /// Terms in range, ascending.
  std::span<const std::uint32_t> acting() const noexcept { return acting_; }
  /// Whether these are others than in the step before, or the terms are new.
  bool acting_changed() const noexcept { return acting_changed_; }
  /// Which of them hang together.
  const TermParts& parts() const noexcept { return parts_; }

 private:
  /// The corners of a term's features that span those which hold its nearest points.
  struct NearestCorners {
    unsigned a;
    unsigned b;
  };
  void list_terms_of_pairs();
  double furthest(Positions x) const;
  void find_near_pairs(std::span<const NormalSpring> springs, const Motion& motion,
                       geometry::ThreadPool& pool);
  void prepare_springs(std::span<const NormalSpring> springs);
  /// The same as holders(), for who has no need of the term.
  std::span<const Holder> holders_of(std::uint32_t term) const noexcept {
    return {holders_.data() + first_holders_[term], holders_.data() + first_holders_[term + 1]};
  }
  /// All that a pair of cells has, ascending.
  std::span<const std::uint32_t> terms_of(std::uint32_t pair) const noexcept {
    return {terms_of_pairs_.data() + first_terms_[pair],
            terms_of_pairs_.data() + first_terms_[pair + 1]};
  }
  TermsInRange in_range() const noexcept { return {acting_, terms_, holders_}; }
  void evaluate_terms_of(std::uint32_t pair, std::span<const NormalSpring> springs, Positions x);
  bool evaluate_term(std::uint32_t term, std::span<const NormalSpring> springs, Positions x);
  void act(std::uint32_t term, const TermProximity& found, const NormalSpring& spring, Positions x);
  void list_acting();
  PointShare share_of(const PairTerm& term, const NearestCorners& nearest, double range,
                      Positions x) const;
  RimPlaces rims_of(const PairTerm& term, const NearestCorners& nearest, std::uint32_t pair) const;
  double turn_rims(std::uint32_t term, std::uint32_t pair, const std::array<double, 2>& energies,
                   Positions x);
  void give_back_of_cycles(std::span<const NormalSpring> springs, Positions x,
                           geometry::ThreadPool& pool);
  void give_back(std::uint32_t part, std::span<const NormalSpring> springs, Positions x);
  double most_cycles() const noexcept;
  double flatness_share(std::span<const std::uint32_t> pairs, double range) const noexcept;
  void add_cycles(std::span<const std::uint32_t> pairs, double share, const NormalSpring& spring,
                  bool pulls);
  void add_flatness(std::span<const std::uint32_t> pairs, double energy, double range, bool pulls);
  void tilt_cells(std::span<const NormalSpring> springs, Positions x, geometry::ThreadPool& pool);
  void tilt(std::uint32_t pair, std::span<const NormalSpring> springs, Positions x);

  const geometry::Surface* surface_;
  geometry::ProductFeatureFinder features_;
  std::vector<PairTerm> terms_;
  std::vector<Holder> holders_;
  WrappedJoints joints_;
  std::vector<char> attracts_;  ///< by spring; empty if none does
  std::vector<PairForces>
      attractions_;  ///< by term, of those in range; empty if no spring attracts
  std::vector<std::uint32_t> first_holders_;   ///< by term, and the number of all
  std::vector<std::uint32_t> term_of_pair_;    ///< of both cells
  std::vector<std::uint32_t> terms_of_pairs_;  ///< of all pairs: which it holds, ascending
  std::vector<std::uint32_t> first_terms_;     ///< by pair, and the number of all these
  std::vector<std::uint32_t> next_terms_;      ///< working space
  double largest_range_ = 0.0;                 ///< m, of all springs
  bool terms_are_new_ = false;
  bool have_bars_ = false;
  Clearances clearances_;                 ///< of the pairs of cells
  std::vector<std::uint32_t> due_;        ///< pairs of cells that may be in range, ascending
  std::vector<std::uint32_t> near_;       ///< those of them that are
  std::vector<TermProximity> proximity_;  ///< by pair; of those in range, as it is now
  std::vector<double> tilts_;             ///< by pair; of those in range, of proximity_
  std::vector<PairForces> extents_;       ///< by pair; of those of facets in range
  std::vector<char> is_near_;             ///< by pair: in range
  /// J, by term: what the share of a term in range is of; of attraction in the second. Of terms out
  /// of range that a pair in range has first, 0.
  std::vector<std::array<double, 2>> shared_;
  std::vector<NearestCorners> nearest_;             ///< by term, of those in range
  std::vector<std::array<double, 2>> cycle_tilts_;  ///< J, by pair of cells: of cycles, by its tilt
  bool has_cycle_tilts_ = false;                    ///< any of them may not be 0
  std::vector<char> is_acting_;                     ///< by term; all 0 between calls
  std::vector<std::uint32_t> acting_;
  std::vector<std::uint32_t> acted_;  ///< in the step before
  bool acting_changed_ = false;
  TermParts parts_;
  CycleSearch search_;
  ProductComplex complex_;
  CycleWeights cycles_;
  std::vector<std::uint32_t> cycle_pairs_;
  std::vector<ProductComplex::CellPair> cycle_cells_;
  std::vector<double> counts_;    ///< by vertex: weights of the terms that stand there
  std::vector<double> energies_;  ///< J, by vertex
  std::vector<double> weights_;   ///< by vertex: beside those
  std::vector<double> slopes_;    ///< N, by vertex: of the energy by the overlap, as weights change
};

}  // namespace plekton::contact::structure
