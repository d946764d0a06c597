// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace plekton::geometry {

/// Rows of so many numbers each.
struct StateArray {
  std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<std::int32_t>,
               std::vector<std::uint8_t>>
      numbers;
  std::size_t columns = 1;

  std::size_t size() const noexcept {
    return std::visit([](const auto& all) { return all.size(); }, numbers);
  }
  std::size_t rows() const noexcept { return size() / columns; }
};

/// The state of something as plain numbers: arrays by name, as in "contacts/spheres/gap". All that
/// decides how a simulation goes on, in an order that depends on neither threads nor memory, so
/// that two of the same state are the same to the bit.
struct StateTree {
  std::map<std::string, StateArray> arrays;

  /// Over all names and bits, by BitHash: 64 bits that differ where a number does.
  std::uint64_t hash() const;
};

/// A state that is not one of what it is read into, or not whole.
class StateMismatch : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace plekton::geometry
