// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/stress/shrink.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>

namespace plekton::stress {
namespace {

using Clock = std::chrono::steady_clock;

/// Each whole number above 1 that stands by itself in a value, halved: a value for each of them.
std::vector<std::string> with_halves(const std::string& value) {
  const auto belongs = [&](std::size_t i) {
    const char c = value[i];
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '_' ||
           c == '+' || c == '"';
  };
  std::vector<std::string> values;
  for (std::size_t i = 0; i < value.size();) {
    std::size_t end = i;
    while (end < value.size() && belongs(end)) ++end;
    std::int64_t number = 0;
    const auto [stop, error] = std::from_chars(value.data() + i, value.data() + end, number);
    if (end > i && error == std::errc() && stop == value.data() + end && number > 1)
      values.push_back(value.substr(0, i) + std::to_string(number / 2) + value.substr(end));
    i = end + 1;
  }
  return values;
}

/// A plain number, halved.
std::optional<std::string> half_of(const std::string& value) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (error != std::errc() || end != value.data() + value.size()) return std::nullopt;
  return fmt::format("{:.4g}", 0.5 * number);
}

class Shrinking {
 public:
  Shrinking(SceneText scene, const std::function<bool(const SceneText&)>& fails,
            Clock::time_point end)
      : scene_(std::move(scene)), fails_(fails), end_(end) {}

  SceneText execute() {
    while (!is_over() && (halve_duration() | drop_tables() | drop_keys() | halve_numbers())) {
    }
    return std::move(scene_);
  }

 private:
  bool is_over() const { return Clock::now() > end_; }

  bool take_if_it_fails(SceneText smaller) {
    if (is_over() || !fails_(smaller)) return false;
    scene_ = std::move(smaller);
    return true;
  }

  /// The last ones first: loads name bodies, and bodies name materials.
  bool drop_tables() {
    bool changed = false;
    for (std::size_t i = scene_.tables.size(); i-- > 0;) {
      SceneText smaller = scene_;
      smaller.tables.erase(smaller.tables.begin() + static_cast<std::ptrdiff_t>(i));
      changed = take_if_it_fails(std::move(smaller)) || changed;
    }
    return changed;
  }

  bool drop_keys() {
    bool changed = false;
    for (std::size_t i = scene_.tables.size(); i-- > 0;) {
      for (std::size_t k = scene_.tables[i].keys.size(); k-- > 0;) {
        SceneText smaller = scene_;
        auto& keys = smaller.tables[i].keys;
        keys.erase(keys.begin() + static_cast<std::ptrdiff_t>(k));
        changed = take_if_it_fails(std::move(smaller)) || changed;
      }
    }
    return changed;
  }

  bool halve_duration() {
    bool changed = false;
    // To a single step and further, where the first one fails already.
    while (!is_over() && halvings_ < kMostHalvings) {
      SceneText smaller = scene_;
      std::string* const duration = find_value(smaller, "[simulation]", "duration");
      const auto half = duration == nullptr ? std::nullopt : half_of(*duration);
      if (!half) break;
      *duration = *half;
      if (!take_if_it_fails(std::move(smaller))) break;
      ++halvings_;
      changed = true;
    }
    return changed;
  }

  bool halve_numbers() {
    bool changed = false;
    for (std::size_t i = 0; i < scene_.tables.size(); ++i)
      for (std::size_t k = 0; k < scene_.tables[i].keys.size(); ++k)
        if (counts(scene_.tables[i].keys[k].first)) changed = halve_numbers_of(i, k) || changed;
    return changed;
  }

  bool halve_numbers_of(std::size_t table, std::size_t key) {
    bool changed = false;
    bool goes_on = true;
    while (goes_on && !is_over()) {
      goes_on = false;
      for (std::string& value : with_halves(scene_.tables[table].keys[key].second)) {
        SceneText smaller = scene_;
        smaller.tables[table].keys[key].second = std::move(value);
        goes_on = take_if_it_fails(std::move(smaller));
        if (goes_on) break;
      }
      changed = changed || goes_on;
    }
    return changed;
  }

  /// Other whole numbers are stiffnesses and the like, which would become what nobody has.
  static bool counts(const std::string& key) {
    return key == "count" || key == "shape" || key == "cells";
  }

  static constexpr int kMostHalvings = 12;

  SceneText scene_;
  int halvings_ = 0;  // of the duration
  const std::function<bool(const SceneText&)>& fails_;
  Clock::time_point end_;
};

}  // namespace

SceneText shrunk(SceneText scene, const std::function<bool(const SceneText&)>& fails,
                 std::chrono::seconds longest) {
  return Shrinking(std::move(scene), fails, Clock::now() + longest).execute();
}

}  // namespace plekton::stress
