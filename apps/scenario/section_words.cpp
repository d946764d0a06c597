// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/closest_word.hpp"
#include "apps/scenario/section.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plekton::apps {

std::string problem_with_name(const std::string& name) {
  const bool is_one_line = std::none_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) < ' ' || c == 127;
  });
  if (!is_one_line)
    return "has a line break or another control character; expected a name on one line";
  // A spreadsheet would carry out what stands there.
  if (name.find_first_of("=+-@") != 0) return "";
  return fmt::format(
      "got \"{}\"; expected a name that does not begin with = + - or @, which a spreadsheet takes "
      "for a formula",
      name);
}

std::vector<std::string> Section::texts(std::string_view key) {
  if (records(key, ValueType::of(ValueType::Kind::texts), {})) return {};
  const Value* value = require(key);
  if (value == nullptr) return {};
  const auto* array = std::get_if<Array>(&value->data);
  std::vector<std::string> texts;
  for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
    const auto* text = std::get_if<std::string>(&(*array)[i].data);
    if (text != nullptr && !text->empty()) texts.push_back(*text);
  }
  if (array != nullptr && texts.size() == array->size() && !texts.empty()) return texts;
  complain(key, fmt::format("got {}; expected a list of texts in quotes", shown(*value)));
  return {};
}

bool Section::truth(std::string_view key, bool fallback) {
  if (records(key, ValueType::of(ValueType::Kind::truth), fallback ? "true" : "false"))
    return fallback;
  const Value* value = find(key);
  if (value == nullptr) return fallback;
  if (const auto* truth = std::get_if<bool>(&value->data)) return *truth;
  complain(key, fmt::format("got {}; expected true or false", shown(*value)));
  return fallback;
}

std::string Section::text(std::string_view key, const std::optional<std::string>& fallback) {
  if (records(key, ValueType::of(ValueType::Kind::text), fallback == "" ? "none" : fallback))
    return fallback.value_or("");
  const Value* value = fallback ? find(key) : require(key);
  if (value == nullptr) return fallback.value_or("");
  const auto* text = std::get_if<std::string>(&value->data);
  if (text && !text->empty()) return *text;
  complain(key, fmt::format("got {}; expected a text in quotes, not empty", shown(*value)));
  return "";
}

std::string Section::name(std::string_view key, const std::optional<std::string>& fallback) {
  const std::string name = text(key, fallback);
  const std::string problem = problem_with_name(name);
  if (problem.empty()) return name;
  complain(key, problem);
  return "";
}

std::optional<std::size_t> Section::position_of(const Value& value, std::string_view key,
                                                std::span<const std::string_view> words) {
  const auto* text = std::get_if<std::string>(&value.data);
  const auto found = text ? std::find(words.begin(), words.end(), *text) : words.end();
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  complain(key, fmt::format("got {}; expected one of {}{}", shown(value), listed(words),
                            text ? did_you_mean(*text, words) : ""));
  return std::nullopt;
}

std::size_t Section::choice(std::string_view key, std::span<const std::string_view> words,
                            std::optional<std::size_t> fallback) {
  if (!recorder_ && !fallback && require(key) == nullptr) return 0;
  return known_choice(key, words, fallback).value_or(0);
}

std::optional<std::size_t> Section::known_choice(std::string_view key,
                                                 std::span<const std::string_view> words,
                                                 std::optional<std::size_t> fallback) {
  if (records(key, ValueType::word_of(words),
              fallback ? std::optional(fmt::format("\"{}\"", words[*fallback])) : std::nullopt))
    return recorder_->choice(path_of(key), words).value_or(fallback.value_or(0));
  const Value* value = find(key);
  if (value) return position_of(*value, key, words);
  if (fallback) return fallback;
  problems_->add(place_,
                 fmt::format("{}: missing; expected one of {}", path_of(key), listed(words)));
  return std::nullopt;
}
}  // namespace plekton::apps
