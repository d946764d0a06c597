// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/key_recorder.hpp"

#include "apps/scenario/section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plekton::apps {

bool KeyRecorder::ask(const std::string& path) {
  asked_.insert(path);
  return !absent_.contains(path);
}

void KeyRecorder::add(const std::string& path, std::string kind,
                      const std::optional<std::string>& standard,
                      std::span<const std::string_view> words) {
  const bool is_known =
      std::any_of(keys_.begin(), keys_.end(), [&](const auto& key) { return key.path == path; });
  if (is_known) return;
  const auto other = alternatives_.find(path);
  if (other != alternatives_.end()) kind += ", or " + other->second;
  keys_.push_back({path,
                   std::move(kind),
                   standard.value_or(asked_.contains(path) ? "-" : "required"),
                   {words.begin(), words.end()}});
}

void KeyRecorder::add_alternative(const std::string& path, const std::string& what) {
  alternatives_[path] = what;
}

std::optional<std::size_t> KeyRecorder::choice(const std::string& path,
                                               std::span<const std::string_view> words) const {
  const auto chosen = chosen_.find(path);
  if (chosen == chosen_.end()) return std::nullopt;
  const auto found = std::find(words.begin(), words.end(), chosen->second);
  if (found == words.end()) return std::nullopt;
  return static_cast<std::size_t>(found - words.begin());
}

std::string kind_text(const Quantity& expected) {
  const std::string_view name = expected.dimension.name;
  const std::string_view noun = name.substr(name.find(' ') + 1);  // without its article
  const std::string_view unit = expected.dimension.si_unit;
  return fmt::format("{}{}{}", noun, unit.empty() ? "" : fmt::format(" ({})", unit),
                     expected.range.text);
}

std::string standard_text(double value) {
  if (std::isnan(value)) return "other keys";
  return std::isinf(value) ? "none" : fmt::format("{:g}", value);
}

}  // namespace plekton::apps
