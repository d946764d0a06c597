// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/value_type.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plekton::apps {
namespace {

using Kind = ValueType::Kind;

/// "a length" to "length".
std::string_view noun_of(const Quantity& quantity) {
  const std::string_view name = quantity.dimension.name;
  return name.substr(name.find(' ') + 1);
}

std::string unit_of(const Quantity& quantity) {
  return quantity.dimension.si_unit.empty() ? "-" : std::string(quantity.dimension.si_unit);
}

/// As in "length (m) above 0".
std::string text_of(const Quantity& quantity) {
  const std::string_view unit = quantity.dimension.si_unit;
  return fmt::format("{}{}{}", noun_of(quantity), unit.empty() ? "" : fmt::format(" ({})", unit),
                     quantity.range.text);
}

std::string in_quotes(const std::vector<std::string>& words) {
  return words.empty() ? "" : fmt::format("\"{}\"", fmt::join(words, "\", \""));
}

/// The least values of whole numbers: one for all that are the same.
std::string least_of(const std::vector<std::int64_t>& low) {
  const bool is_same = std::count(low.begin(), low.end(), low.front()) == std::ssize(low);
  return is_same ? std::to_string(low.front()) : fmt::format("{}", fmt::join(low, " and "));
}

/// As in "{ min = [..], max = [..] }".
std::string shape_of(const ValueType& table) {
  if (table.members.empty()) return "a table";
  std::vector<std::string> members;
  for (const auto& [name, type] : table.members)
    members.push_back(name + (type.kind == Kind::vector ? " = [..]" : " = .."));
  return fmt::format("{{ {} }}", fmt::join(members, ", "));
}

}  // namespace

ValueType ValueType::of(Kind kind, const Quantity& quantity, const Quantity& second) {
  ValueType type;
  type.kind = kind;
  type.quantity = quantity;
  type.second = second;
  return type;
}

ValueType ValueType::whole_from(Kind kind, std::vector<std::int64_t> low, std::int64_t high) {
  ValueType type = of(kind);
  type.low = std::move(low);
  type.high = high;
  return type;
}

ValueType ValueType::word_of(std::span<const std::string_view> words) {
  ValueType type = of(Kind::word);
  type.words.assign(words.begin(), words.end());
  return type;
}

std::string text_of(const ValueType& type) {
  switch (type.kind) {
    case Kind::quantity:
      return text_of(type.quantity) + (type.words.empty() ? "" : ", or " + in_quotes(type.words));
    case Kind::quantities:
      return "list of " + text_of(type.quantity);
    case Kind::vector:
      return "3 x " + text_of(type.quantity);
    case Kind::vectors:
      return "list of 3 x " + text_of(type.quantity);
    case Kind::pairs:
      return fmt::format("pairs of {} and {}", text_of(type.quantity), text_of(type.second));
    case Kind::whole_number:
      return fmt::format("whole number from {}", least_of(type.low));
    case Kind::whole_numbers:
      return fmt::format("{} x whole number from {}", type.low.size(), least_of(type.low));
    case Kind::whole_rows:
      return fmt::format("list of {} x whole number from {}", type.low.size(), least_of(type.low));
    case Kind::truth:
      return "true or false";
    case Kind::text:
      return "text";
    case Kind::texts:
      return "texts";
    case Kind::word:
      return in_quotes(type.words);
    case Kind::table:
      break;
  }
  return shape_of(type);
}

std::string name_of(const ValueType& type) {
  const std::string noun(noun_of(type.quantity));
  switch (type.kind) {
    case Kind::quantity:
      return noun;
    case Kind::quantities:
      return "list of " + noun;
    case Kind::vector:
      return "3 x " + noun;
    case Kind::vectors:
      return "list of 3 x " + noun;
    case Kind::pairs:
      return fmt::format("pairs of {} and {}", noun, noun_of(type.second));
    case Kind::whole_number:
      return "whole number";
    case Kind::whole_numbers:
      return fmt::format("{} x whole number", type.low.size());
    case Kind::whole_rows:
      return fmt::format("list of {} x whole number", type.low.size());
    case Kind::word:
      return "word";
    default:
      return text_of(type);
  }
}

std::string unit_of(const ValueType& type) {
  switch (type.kind) {
    case Kind::quantity:
    case Kind::quantities:
    case Kind::vector:
    case Kind::vectors:
      return unit_of(type.quantity);
    case Kind::pairs:
      return unit_of(type.quantity) + ", " + unit_of(type.second);
    default:
      return "-";
  }
}

std::string range_of(const ValueType& type) {
  const auto trimmed = [](std::string_view text) {
    return std::string(text.substr(text.starts_with(' ') ? 1 : 0));
  };
  switch (type.kind) {
    case Kind::quantity:
      return trimmed(type.quantity.range.text) +
             (type.words.empty() ? "" : ", or " + in_quotes(type.words));
    case Kind::quantities:
    case Kind::vector:
    case Kind::vectors:
      return trimmed(type.quantity.range.text);
    case Kind::pairs: {
      const std::string first = trimmed(type.quantity.range.text);
      const std::string second = trimmed(type.second.range.text);
      if (first.empty() && second.empty()) return "the first ones increase";
      return fmt::format("the first ones increase, {}; the second ones {}",
                         first.empty() ? "any" : first, second.empty() ? "any" : second);
    }
    case Kind::whole_number:
    case Kind::whole_numbers:
    case Kind::whole_rows:
      if (type.high == std::numeric_limits<std::int64_t>::max())
        return "from " + least_of(type.low);
      return fmt::format("from {} to {}", least_of(type.low), type.high);
    case Kind::word:
      return in_quotes(type.words);
    default:
      return "";
  }
}

}  // namespace plekton::apps
