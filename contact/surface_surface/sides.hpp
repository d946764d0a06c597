// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry/base/state_archive.hpp"

#include <compare>
#include <string>

namespace plekton::contact::structure {

/// How the two sides of one thing go with those of another one: cells of a pair with the sides of
/// its patch, features of a term with the cells that have them. Each names its sides in an order of
/// its own, by ids, so the first of one may be on the second of the other. They form the group of
/// two elements: with(): of one with another, and of that with a third.
class Sides {
 public:
  /// Not crossed: the first goes with the first.
  constexpr Sides() = default;
  explicit constexpr Sides(bool are_crossed) noexcept : are_crossed_(are_crossed) {}

  constexpr bool are_crossed() const noexcept { return are_crossed_; }
  /// How the sides of this go with those of a third, which go with the other's so.
  constexpr Sides with(Sides other) const noexcept {
    return Sides(are_crossed_ != other.are_crossed_);
  }
  /// Of the two of one thing, that which goes with the first of the other one, or the second.
  template <class Thing>
  constexpr Thing& first(Thing& first, Thing& second) const noexcept {
    return are_crossed_ ? second : first;
  }
  template <class Thing>
  constexpr Thing& second(Thing& first, Thing& second) const noexcept {
    return are_crossed_ ? first : second;
  }
  /// What points from the first side to the second, in the other's order, is so many times that.
  constexpr double sign() const noexcept { return are_crossed_ ? -1.0 : 1.0; }

  void exchange(geometry::RowFields& row, const std::string& name) { row(name, are_crossed_); }

  friend constexpr auto operator<=>(const Sides&, const Sides&) = default;

 private:
  bool are_crossed_ = false;
};

}  // namespace plekton::contact::structure
