// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/closest/decide.hpp"

#include "geometry/base/predicates.hpp"

#include <array>
#include <bit>
#include <optional>

namespace plekton::geometry {

ClosestCounters& closest_counters() noexcept {
  thread_local ClosestCounters counters;
  return counters;
}

namespace closest {
namespace {

constexpr std::array kCorners{1U, 2U, 4U};
constexpr std::array kSidesInOrder{3U, 5U, 6U};
constexpr std::array kFace{7U};

/// Features of one dimension that a core has.
std::span<const unsigned> features(std::size_t dimension, Corners x) {
  if (dimension >= x.size()) return {};
  if (dimension == 0) return {kCorners.data(), x.size()};
  if (dimension == 2) return kFace;
  return {kSidesInOrder.data(), x.size() == 2 ? std::size_t{1} : std::size_t{3}};
}

/// The first pair of features of these dimensions that carries nearest points.
std::optional<Decision> search(Corners a, std::size_t dimension_a, Corners b,
                               std::size_t dimension_b) {
  for (const unsigned of_a : features(dimension_a, a)) {
    for (const unsigned of_b : features(dimension_b, b)) {
      const Verdict verdict = certify(a, b, {of_a, of_b});
      if (verdict == Verdict::refuted) continue;
      const bool is_touching = verdict == Verdict::touching;
      return Decision{{of_a, of_b}, is_touching ? Relation::touching_or_crossing : Relation::apart};
    }
  }
  return std::nullopt;
}

/// Cores of which no lower features meet, but which cross: a side of one goes through the face of
/// the other.
std::optional<Decision> search_crossing(Corners a, Corners b) {
  if (b.size() == 3) {
    for (const unsigned side : features(1, a)) {
      if (crosses(a, side, b)) return Decision{{side, 7U}, Relation::touching_or_crossing};
    }
  }
  if (a.size() == 3) {
    for (const unsigned side : features(1, b)) {
      if (crosses(b, side, a)) return Decision{{7U, side}, Relation::touching_or_crossing};
    }
  }
  return std::nullopt;
}

/// Whether other corners lie where a corner is, or on the line of a side.
bool has_rivals(Corners x, unsigned feature) {
  const auto first = static_cast<std::size_t>(std::countr_zero(feature));
  const auto last = static_cast<std::size_t>(std::bit_width(feature)) - 1;
  if (feature == 7U) return false;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (k == first || k == last) continue;
    if (first == last && x[k] == x[first]) return true;
    const Difference along{x[first], x[last]};
    const Difference other{x[first], x[k]};
    if (first != last && sign_of_crosses(along, other, other) == 0) return true;
  }
  return false;
}

/// Where a point's foot lies if it is not inside the guessed feature: rounding moves a foot from a
/// side to a face or to a corner, and back.
std::span<const unsigned> beside(unsigned feature, std::size_t corners) {
  static constexpr std::array<std::array<unsigned, 3>, 8> kBeside{{{},
                                                                   {3U, 5U, 7U},
                                                                   {3U, 6U, 7U},
                                                                   {7U, 1U, 2U},
                                                                   {5U, 6U, 7U},
                                                                   {7U, 1U, 4U},
                                                                   {7U, 2U, 4U},
                                                                   {3U, 5U, 6U}}};
  if (corners == 3) return kBeside[feature];
  static constexpr std::array kSegment{1U, 2U, 3U};
  return kSegment;
}

/// The feature that carries a point's foot and nothing else does, if one beside the guess is it.
std::optional<Decision> search_beside(Corners a, Corners b, unsigned guess) {
  for (const unsigned feature : beside(guess, b.size())) {
    if (certify(a, b, {1U, feature}) == Verdict::unique)
      return Decision{{1U, feature}, Relation::apart};
  }
  return std::nullopt;
}

}  // namespace

Decision enumerate(Corners a, Corners b) noexcept {
  if (is_lower_side(b, a)) {
    const Decision swapped = enumerate(b, a);
    return {{swapped.witness_features.b, swapped.witness_features.a}, swapped.relation};
  }
  ++closest_counters().enumerated;
  constexpr std::array<std::array<std::size_t, 2>, 6> kDimensions{
      {{0, 0}, {0, 1}, {1, 0}, {0, 2}, {2, 0}, {1, 1}}};
  for (const auto& [of_a, of_b] : kDimensions) {
    if (const auto found = search(a, of_a, b, of_b)) return *found;
  }
  if (const auto found = search_crossing(a, b)) return *found;
  return {{1U, 1U}, Relation::touching_or_crossing};  // only coordinates out of range come here
}

Decision decide_for_point(Corners a, Corners b, unsigned guess) noexcept {
  const Verdict verdict = certify(a, b, {1U, guess});
  if (verdict == Verdict::unique) return {{1U, guess}, Relation::apart};
  if (verdict == Verdict::refuted) {
    if (const auto found = search_beside(a, b, guess)) return *found;
  }
  if (verdict == Verdict::refuted || has_rivals(b, guess)) return enumerate(a, b);
  const bool is_touching = verdict == Verdict::touching;
  return {{1U, guess}, is_touching ? Relation::touching_or_crossing : Relation::apart};
}

}  // namespace closest
}  // namespace plekton::geometry
