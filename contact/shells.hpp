// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace plekton::contact {

/// A facet whose corners are all nearer than the range, and so is all of it.
struct WholeFacet {
  std::uint32_t upper;  ///< its farthest corner
  std::array<std::uint32_t, 3> corners;
  std::array<std::uint32_t, 3> sides;  ///< any numbers that facets with a common side agree about
  std::array<std::int8_t, 3> signs;    ///< 1: round the facet along the side, -1: against it
};

/// The shells of some facets: facets, each taken some times (mostly 1 or -1), whose sides cancel.
/// What a shell encloses is a hollow.
///
/// Shells can be added, so they are a space; these are a basis of it, and those whose last corner
/// is below a level are one of the shells below that level. The facets that no shell takes are
/// dropped from the rims inwards, then the sides of the rest are reduced from the nearest facet on.
/// Source: persistence, Edelsbrunner & Harer, Computational Topology (2010), VII.
class Shells {
 public:
  /// A facet or a side, and how often it is taken.
  struct Entry {
    std::uint32_t at;
    double times;
  };
  struct Shell {
    std::uint32_t upper;  ///< corner from which on it is there
    std::uint32_t first;  ///< of its entries; the last one is the last facet, which is in no other
    std::uint32_t count;  ///< shell
  };

  /// Keeps its working space, so that a warm call does not allocate. Takes F log F for F facets if
  /// there is no shell, and at most the square of the facets that are left when no rim is left.
  /// @param facets  ascending by upper
  void build(std::span<const WholeFacet> facets);

  /// Those of build() that shells may take.
  std::span<const WholeFacet> facets() const noexcept { return facets_; }
  /// Ascending by upper.
  std::span<const Shell> shells() const noexcept { return shells_; }
  /// Ascending by facet.
  std::span<const Entry> entries(const Shell& shell) const noexcept {
    return std::span(facet_entries_).subspan(shell.first, shell.count);
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  struct Side {
    std::uint32_t facets;  ///< how many there are on it
    std::uint32_t ids;     ///< exclusive or of them: the last one if there is one
  };
  /// Facets whose sides were added up: what is left of the sides, and the facets.
  struct Reduced {
    std::uint32_t first_side, side_count;
    std::uint32_t first_facet, facet_count;
  };

  void number_sides();
  void drop_rims();
  void reduce(std::uint32_t facet);
  void subtract(const Reduced& older, double factor);

  std::vector<WholeFacet> facets_;       ///< sides are numbered 0, 1, ..
  std::vector<std::uint32_t> side_ids_;  ///< ascending: the number of a side is its place
  std::vector<Side> sides_;
  std::vector<std::uint32_t> rims_;  ///< sides with one facet, to be dropped
  std::vector<char> is_dropped_;     ///< by facet
  std::vector<Shell> shells_;
  std::vector<Reduced> reduced_;
  std::vector<std::uint32_t> reducer_;  ///< by side: which of reduced_ has it as its last, or kNone
  std::vector<Entry> side_entries_;     ///< of reduced_
  std::vector<Entry> facet_entries_;    ///< of shells_ and reduced_
  std::vector<double> side_times_, facet_times_;  ///< of the facet being reduced; then all 0
};

}  // namespace plekton::contact
