// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/stress/scene_text.hpp"

#include <sstream>

namespace plekton::stress {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Whether a quoted text goes on at a place.
class Quotes {
 public:
  bool holds(char c) {
    if (quote_ != 0) {
      if (c == quote_) quote_ = 0;
      return true;
    }
    if (c == '"' || c == '\'') quote_ = c;
    return quote_ != 0;
  }

 private:
  char quote_ = 0;
};

std::string_view without_comment(std::string_view line) {
  Quotes quotes;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (!quotes.holds(line[i]) && line[i] == '#') return line.substr(0, i);
  return line;
}

int open_brackets(std::string_view value) {
  Quotes quotes;
  int open = 0;
  for (const char c : value) {
    if (quotes.holds(c)) continue;
    if (c == '[' || c == '{') ++open;
    if (c == ']' || c == '}') --open;
  }
  return open;
}

}  // namespace

std::string SceneText::text(std::string_view note) const {
  std::string all;
  std::istringstream lines{std::string(note)};
  for (std::string line; std::getline(lines, line);) all += "# " + line + '\n';
  for (const TextTable& table : tables) {
    if (!table.head.empty()) all += table.head + '\n';
    for (const auto& [key, value] : table.keys) all.append(key).append(" = ").append(value) += '\n';
  }
  return all;
}

SceneText taken_apart(std::string_view text) {
  SceneText scene;
  std::istringstream lines{std::string(text)};
  bool goes_on = false;
  for (std::string whole; std::getline(lines, whole);) {
    const std::string line(trimmed(without_comment(whole)));
    if (line.empty()) continue;
    if (goes_on) {
      scene.tables.back().keys.back().second += ' ' + line;
    } else if (line.front() == '[') {
      scene.tables.push_back({line, {}});
      continue;
    } else {
      const std::size_t equals = line.find('=');
      if (scene.tables.empty()) scene.tables.emplace_back();
      const std::string_view value =
          equals == std::string::npos ? "" : trimmed(std::string_view(line).substr(equals + 1));
      scene.tables.back().keys.emplace_back(trimmed(std::string_view(line).substr(0, equals)),
                                            value);
    }
    goes_on = open_brackets(scene.tables.back().keys.back().second) > 0;
  }
  return scene;
}

std::string* find_value(SceneText& scene, std::string_view head, std::string_view key) {
  for (TextTable& table : scene.tables) {
    if (table.head != head) continue;
    for (auto& [name, value] : table.keys)
      if (name == key) return &value;
  }
  return nullptr;
}

}  // namespace plekton::stress
