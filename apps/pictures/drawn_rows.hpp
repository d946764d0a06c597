// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace plekton::apps {

/// The rows of a curve that are drawn: all, or of more than so many the first, the last, and of every
/// few in between those with the least and the greatest x and y, so that no peak is lost.
/// @param x, y  as long as each other; rows in which one is not finite stand only where none of the
///              few is, so that a gap remains one
/// @param most  rows, at least 8
/// @returns     in their order, at most that many and two more
std::vector<std::size_t> drawn_rows(const std::vector<double>& x, const std::vector<double>& y,
                                    std::size_t most);

}  // namespace plekton::apps
