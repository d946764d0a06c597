// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace plekton::apps {

/// The fewest insertions, deletions, replacements and swaps of neighbours that turn one text into
/// the other; each place is changed at most once (optimal string alignment). Upper and lower case
/// count as different, but only half.
double edit_distance(std::string_view a, std::string_view b);

/// The known word that somebody meant who wrote this: the nearest, unless more than a third of the
/// longer of both would have to change (and at least one change is allowed). The first of several.
/// Empty if none is near.
std::string closest_word(std::string_view written, std::span<const std::string_view> known);

/// As in `; did you mean "radius"?`, to end a message with; empty if no word is near.
std::string did_you_mean(std::string_view written, std::span<const std::string_view> known);

/// Words in quotes with commas between them.
std::string listed(std::span<const std::string_view> words);

}  // namespace plekton::apps
