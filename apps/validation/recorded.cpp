// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/validation/recorded.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string>
#include <utility>

namespace plekton::apps {
namespace {

double number_in(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw std::logic_error("recorded curve: no number: " + std::string(text));
  return value;
}

}  // namespace

std::pair<std::vector<double>, std::vector<double>> read_recorded(std::string_view text) {
  std::pair<std::vector<double>, std::vector<double>> points;
  bool has_heads = false;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (line.empty() || line.front() == '#') continue;
    if (!std::exchange(has_heads, true)) continue;
    const std::size_t comma = line.find(',');
    if (comma == std::string_view::npos)
      throw std::logic_error("recorded curve: no comma: " + std::string(line));
    points.first.push_back(number_in(line.substr(0, comma)));
    points.second.push_back(number_in(line.substr(comma + 1)));
  }
  return points;
}

Curve recorded_curve(std::string_view name) {
  auto [x, y] = read_recorded(recorded_text(name));
  return {"YADE 2023.02a", CurveStyle::points, std::move(x), std::move(y)};
}

}  // namespace plekton::apps
