// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/config_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace plekton::apps {

const Entry* Table::find(std::string_view key) const {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

Entry* Table::find(std::string_view key) {
  return const_cast<Entry*>(std::as_const(*this).find(key));
}

void refuse_depth(const Place& place) {
  throw InputError(fmt::format("{}: tables or lists are nested more than {} deep; no key is",
                               to_string(place), kDeepest));
}

std::string shown(const Value& value) {
  struct Show {
    std::string operator()(const std::string& text) const { return fmt::format("\"{}\"", text); }
    std::string operator()(std::int64_t number) const { return fmt::format("{}", number); }
    std::string operator()(double number) const { return fmt::format("{}", number); }
    std::string operator()(bool truth) const { return truth ? "true" : "false"; }
    std::string operator()(const Array& array) const {
      return fmt::format("a list of {}", array.size());
    }
    std::string operator()(const Table&) const { return "a table"; }
    std::string operator()(const OtherKind& other) const { return other.text; }
  };
  return std::visit(Show{}, value.data);
}

}  // namespace plekton::apps
