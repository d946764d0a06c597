// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/scenario/config_tree.hpp"
#include "apps/scenario/problems.hpp"
#include "apps/scenario/value_type.hpp"
#include "geometry/base/types.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// A value of a file as what is expected of it. The path is what messages call it, as in
/// "membranes.hammock.thickness". After a problem a function returns what makes no further one.
namespace plekton::apps {

/// Stands for a quantity that could not be read.
inline constexpr double kUnread = std::numeric_limits<double>::quiet_NaN();

/// kUnread after a problem.
double read_quantity(const Value& value, const std::string& path, const Quantity& expected,
                     Problems& problems);
/// A list of so many quantities, or of any number. Empty after a problem.
std::vector<double> read_quantities(const Value& value, const std::string& path,
                                    const Quantity& expected, std::optional<std::size_t> count,
                                    Problems& problems);
/// Three quantities, kUnread where there was a problem.
geometry::Vec3 read_vector(const Value& value, const std::string& path, const Quantity& expected,
                           Problems& problems);
/// A list of vectors. Empty after a problem.
std::vector<geometry::Vec3> read_vectors(const Value& value, const std::string& path,
                                         const Quantity& expected, std::size_t least,
                                         Problems& problems);
/// A list of pairs, [[first, second], ...], at least one, whose first numbers increase. Empty
/// after a problem.
std::vector<std::array<double, 2>> read_rising_rows(const Value& value, const std::string& path,
                                                    const Quantity& first, const Quantity& second,
                                                    Problems& problems);

/// Limits included. Nothing after a problem.
std::optional<std::int64_t> read_whole_number(const Value& value, const std::string& path,
                                              std::int64_t low, std::int64_t high,
                                              Problems& problems);
/// A list of whole numbers, each from its least to most. The least ones after a problem.
std::vector<int> read_whole_numbers(const Value& value, const std::string& path,
                                    const std::vector<int>& least, int most, Problems& problems);
/// A list of rows of so many different places in a table, numbered from 0, one row after the
/// other; at least one row. Empty after a problem.
std::vector<std::int32_t> read_places(const Value& value, const std::string& path,
                                      std::size_t columns, std::size_t size, Problems& problems);

/// Nothing after a problem.
std::optional<bool> read_truth(const Value& value, const std::string& path, Problems& problems);
/// Not empty, but after a problem.
std::string read_text(const Value& value, const std::string& path, Problems& problems);
/// A list of texts, none of them empty; empty after a problem.
std::vector<std::string> read_texts(const Value& value, const std::string& path,
                                    Problems& problems);
/// Position among the words; nothing after a problem.
std::optional<std::size_t> read_word(const Value& value, const std::string& path,
                                     std::span<const std::string_view> words, Problems& problems);

}  // namespace plekton::apps
