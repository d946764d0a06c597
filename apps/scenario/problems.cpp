// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/problems.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace plekton::apps {

std::string to_string(const Place& place) {
  if (place.line == 0) return place.source;
  return fmt::format("{}:{}:{}", place.source, place.line, place.column);
}

std::string printable(std::string_view text) {
  constexpr std::string_view kContinued = "\n  ";
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if ((byte >= 0x20 && byte != 0x7f) || text.substr(i).starts_with(kContinued)) {
      result += text[i];
    } else if (byte == '\n') {
      result += "\\n";
    } else {
      result += fmt::format("\\x{:02x}", byte);
    }
  }
  return result;
}

void Problems::add(const Place& place, const std::string& text) {
  problems_.push_back({place, text});
}

std::vector<std::string> Problems::lines() const {
  std::vector<Problem> sorted = problems_;
  const auto key = [](const Problem& p) {
    return std::tie(p.place.source, p.place.line, p.place.column);
  };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Problem& a, const Problem& b) { return key(a) < key(b); });
  std::vector<std::string> lines;
  lines.reserve(sorted.size());
  for (const Problem& problem : sorted)
    lines.push_back(printable(to_string(problem.place) + ": " + problem.text));
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

void Problems::throw_if_any() const {
  if (problems_.empty()) return;
  const std::vector<std::string> all = lines();
  throw InputError(fmt::format("{}", fmt::join(all, "\n")));
}

}  // namespace plekton::apps
