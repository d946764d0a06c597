// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/closest_word.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace plekton::apps {
namespace {

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

double replacement_cost(char a, char b) {
  if (a == b) return 0.0;
  return lower(a) == lower(b) ? 0.5 : 1.0;
}

}  // namespace

double edit_distance(std::string_view a, std::string_view b) {
  // Row i holds the distances between the first i characters of a and each beginning of b.
  std::vector<double> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = static_cast<double>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = static_cast<double>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min(
          {last[j] + 1.0, row[j - 1] + 1.0, last[j - 1] + replacement_cost(a[i - 1], b[j - 1])});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1.0);
    }
  }
  return row[b.size()];
}

std::string closest_word(std::string_view written, std::span<const std::string_view> known) {
  std::string_view best;
  double smallest = 0.0;
  for (const std::string_view word : known) {
    const double distance = edit_distance(written, word);
    const double longest = static_cast<double>(std::max(written.size(), word.size()));
    if (distance > std::max(1.0, longest / 3.0) || distance >= longest) continue;
    if (best.empty() || distance < smallest) {
      best = word;
      smallest = distance;
    }
  }
  return std::string(best);
}

std::string did_you_mean(std::string_view written, std::span<const std::string_view> known) {
  const std::string closest = closest_word(written, known);
  return closest.empty() ? "" : fmt::format("; did you mean \"{}\"?", closest);
}

std::string listed(std::span<const std::string_view> words) {
  return words.empty() ? "" : fmt::format("\"{}\"", fmt::join(words, "\", \""));
}

}  // namespace plekton::apps
