// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/counting/wrap.hpp"
#include "contact/surface_surface/pair_term.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::contact::structure {

/// The joints of bars among the terms of a list of pairs, and what wraps give back at them
/// (contact/counting/wrap.hpp): to the terms themselves, and to the other ends of the bars.
///
/// A joint is a node of a term that only bars have, with all of them in all the pairs of cells that
/// have the term. Where some of these pairs are not in the list, because the cells share a node
/// where a chain folds onto itself, nothing is given back.
class WrappedJoints {
 public:
  /// No joints, of so many pairs of cells.
  void clear(std::size_t pairs);
  /// To be called for every term, in order.
  /// @param pairs  of cells, the list that holders are places in
  void add(const PairTerm& term, std::span<const Holder> holders,
           std::span<const geometry::CellPair> pairs, const geometry::Surface& surface);
  /// After the last.
  void finish(std::span<const PairTerm> terms, std::span<const std::uint32_t> term_of_pair);

  bool empty() const noexcept { return joints_.empty(); }

  /// Adds what a term in range gets back to its forces, and keeps what its bars' other ends do. For
  /// any term once a step, from any thread.
  /// @param pulls  of the attraction; of the pushing spring otherwise
  /// @returns  N, how much harder the features push each other apart; what turns bars is not in it
  double evaluate(std::size_t term, const PairTerm& features, const TermProximity& found,
                  const NormalSpring& spring, Positions x, bool pulls, PairForces& to);
  /// Then gathers what these ends do.
  /// @param acting  terms in range
  void gather(std::span<const std::uint32_t> acting);

  /// How many contacts a term in range gets back.
  double contacts(std::size_t term) const noexcept {
    double sum = 0.0;
    for (std::uint32_t j = first_joints_[term]; j < first_joints_[term + 1]; ++j)
      sum += joints_[j].weight * joints_[j].contacts;
    return sum;
  }

  /// On the nodes of both cells of a pair, as the other ends of bars: a, b as of its term. Null if
  /// nothing does anything.
  const PairForces* on_pair(std::uint32_t pair) const noexcept { return of(pair, ends_); }
  /// The same of the attraction.
  const PairForces* attraction_on_pair(std::uint32_t pair) const noexcept {
    return of(pair, pulled_ends_);
  }

 private:
  struct Joint {
    bool is_a;            ///< feature a of its term is the node
    double weight;        ///< of the features opposite
    std::uint32_t first;  ///< of its arms
    std::uint32_t count;
    double contacts = 0.0;  ///< that it gave back in the present step
  };
  struct Arm {
    NodeId end;
    std::uint32_t pair;        ///< one of those whose cell it is
    std::uint8_t place;        ///< of the end in that pair's term: corner of a, or 3 + corner of b
    Vec3 push = Vec3::Zero();  ///< N
    Vec3 pull = Vec3::Zero();  ///< N
  };
  const PairForces* of(std::uint32_t pair, const std::vector<PairForces>& ends) const noexcept {
    return ends.empty() || has_ends_[pair] == 0 ? nullptr : &ends[pair];
  }
  void add_side(const PairTerm& term, bool is_a, std::span<const Holder> holders,
                std::span<const geometry::CellPair> pairs, const geometry::Surface& surface);

  std::vector<std::uint32_t> first_joints_;  ///< by term, and the number of all
  std::vector<Joint> joints_;
  std::vector<Arm> arms_;
  std::vector<WrapArm> bars_;           ///< by arm
  std::vector<char> has_ends_;          ///< by pair
  std::vector<std::uint32_t> touched_;  ///< pairs that have
  std::vector<PairForces> ends_;        ///< by pair; empty if there are no joints
  std::vector<PairForces> pulled_ends_;
  std::vector<geometry::CellId> cells_, opposite_;  ///< working space
};

}  // namespace plekton::contact::structure
