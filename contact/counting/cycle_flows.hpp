// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/counting/cycle_basis.hpp"
#include "contact/counting/elimination.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace plekton::contact {

/// How the holes of a complex of vertices, links and filled cycles are shared over its links.
///
/// The flows of a part are the currents without sources that are orthogonal to every filled cycle,
/// when a current i in a link weighs resistance * i^2: as many, independent of each other, as there
/// are holes. Those that a step takes away, when it shuts some of the holes, are orthogonal to what
/// it leaves. The share of a link is what resistance * i^2 adds up to over an orthonormal set of
/// them. So the shares add up to the number of holes that are shut; a hole is shared over the links
/// around it in proportion to how much of its current passes through each, and how much that link
/// resists. They depend on nothing but resistances and connections: not on numbers, nor on which
/// cycles stand for the holes.
/// Source: Eckmann, Harmonische Funktionen und Randwertaufgaben in einem Komplex, Comment. Math.
/// Helv. 17 (1945); without fillings the shares are those of the transfer-current theorem, Burton &
/// Pemantle, Annals of Probability 21 (1993): how likely a random spanning forest leaves a link
/// out. So nets take a time that is almost linear in their links (elimination.hpp); where cycles
/// are filled it grows with the third power of the holes.
class CycleFlows {
 public:
  /// Keeps its working space, so that a warm call does not allocate.
  /// @param links     a > b (the upper vertex is a), ascending by a
  /// @param fillings  ascending by upper
  void build(std::uint32_t vertex_count, std::span<const Link> links,
             std::span<const Filling> fillings);

  const CycleBasis& basis() const noexcept { return basis_; }

  /// Finds the flows of a part that are gone when fillings with an upper vertex in
  /// [part.filling_count, end) shut holes; with an end of CycleBasis::kNone all flows of the part.
  /// @param resistances  of the links of the part, which come first; > 0, in any unit
  /// @returns            their number
  std::size_t find(const ComplexPart& part, std::uint32_t end, std::span<const double> resistances);

  /// By link of the last part.
  /// @param values  those that slopes() will be asked with
  std::span<const double> shares(std::span<const double> values);

  /// How much the sum of share * value grows with the resistance of each link, if the values stay.
  /// @param values  by link of the last part
  std::span<const double> slopes(std::span<const double> values);

 private:
  void find_currents(const ComplexPart& part, std::uint32_t end);
  void factor_products();
  void find_flows(bool all);
  void solve_lower(std::span<double> row) const noexcept;
  void solve_upper(std::span<double> row) const noexcept;
  void add_currents(std::span<const double> coefficients, std::span<double> flow) const noexcept;
  double sum_of_products(std::span<const double> a, std::span<const double> b,
                         std::span<const double> values) const noexcept;
  void take_off_other_flows(std::span<const double> values, std::span<const double> flow);
  std::span<double> flow(std::size_t i) noexcept {
    return {flows_.data() + i * links_.size(), links_.size()};
  }
  std::span<const double> current(std::size_t hole) const noexcept {
    return {currents_.data() + hole * links_.size(), links_.size()};
  }

  std::vector<Link> all_links_;  ///< of build()
  std::uint32_t vertex_count_ = 0;
  CycleBasis basis_;
  Elimination elimination_;
  bool is_planned_ = false;  ///< elimination_, for the links of the last build()
  bool has_fillings_ = false;
  // Of the last find().
  bool is_graph_ = false;    ///< all flows of links alone: no set of them has to be found
  std::vector<Link> links_;  ///< of the part, with resistances
  std::size_t hole_count_ = 0;
  std::size_t flow_count_ = 0;
  std::vector<double> conductances_;
  std::vector<double> currents_;  ///< hole x link
  std::vector<double> units_;     ///< by hole: root of its product with itself, inverted
  std::vector<double> factor_;    ///< hole x hole: Cholesky factor of the products, in these units
  std::vector<double> gone_;      ///< flow x hole: what shuts the holes
  std::vector<double> flows_;     ///< flow x link, orthonormal
  std::vector<double> shares_, slopes_;
  // Working space.
  std::vector<double> shut_;         ///< hole x cycle
  std::vector<double> differences_;  ///< hole x join
  std::vector<double> rest_;         ///< by link
  std::vector<double> row_;          ///< by hole
};

}  // namespace plekton::contact
