// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/units.hpp"

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What the keys of a scenario take: the reader checks values by it, and lists, schemas and
/// reference pages say it.
namespace plekton::apps {

/// Values that are allowed.
struct Range {
  double low = -std::numeric_limits<double>::infinity();  ///< SI
  double high = std::numeric_limits<double>::infinity();  ///< SI
  bool with_low = true;
  bool with_high = true;
  std::string_view text;  ///< continues "expected a length", as in " above 0"

  bool holds(double value) const noexcept {
    return (with_low ? value >= low : value > low) && (with_high ? value <= high : value < high);
  }
};

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr Range kAny{};
inline constexpr Range kPositive{0.0, kInfinity, false, true, " above 0"};
inline constexpr Range kNotNegative{0.0, kInfinity, true, true, " of at least 0"};
inline constexpr Range kFraction{0.0, 1.0, true, true, " from 0 to 1"};
inline constexpr Range kBelowOne{0.0, 1.0, true, false, " from 0 to below 1"};

/// A kind of quantity and its range.
struct Quantity {
  Dimension dimension;
  Range range = kAny;
};

/// What the value of a key may be.
struct ValueType {
  enum class Kind {
    quantity,
    quantities,  ///< a list of such
    vector,      ///< three quantities
    vectors,     ///< a list of such
    pairs,       ///< a list of pairs of quantities
    whole_number,
    whole_numbers,  ///< so many as there are entries of `low`
    whole_rows,     ///< a list of such
    truth,
    text,
    texts,
    word,  ///< one of `words`
    table
  };

  Kind kind = Kind::text;
  Quantity quantity = {};          ///< of lists and vectors that of each; the first one of pairs
  Quantity second = {};            ///< of pairs
  std::size_t least = 1;           ///< entries of a list of vectors
  std::vector<std::int64_t> low;   ///< of whole numbers
  std::int64_t high = 0;           ///< of whole numbers
  std::vector<std::string> words;  ///< of a word; of a quantity those that stand for one
  struct Member;
  std::vector<Member> members;  ///< of a table, all required; of any if empty

  static ValueType of(Kind kind, const Quantity& quantity = {}, const Quantity& second = {});
  /// @param low  one for each number
  static ValueType whole_from(Kind kind, std::vector<std::int64_t> low, std::int64_t high);
  static ValueType word_of(std::span<const std::string_view> words);
};

struct ValueType::Member {
  std::string name;
  ValueType type;
};

/// What it is, with its SI unit and range, as in "length (m) above 0".
std::string text_of(const ValueType& type);
/// What it is alone, as in "3 x length".
std::string name_of(const ValueType& type);
/// Its SI unit; "-" without one.
std::string unit_of(const ValueType& type);
/// What it may be, as in "above 0"; empty where it may be anything.
std::string range_of(const ValueType& type);

}  // namespace plekton::apps
