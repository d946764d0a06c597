// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Numbers as the page of a run reads them (web/src/data.js): few bytes that deflate well.
///
/// The numbers of an array come one component after the other, not one tuple after the other, and
/// their bytes sorted: first the lowest byte of every number, then the next. So bytes that are much
/// alike, such as those of exponents, are neighbours.
namespace plekton::apps {

/// How numbers are stored.
enum class NumberType : std::uint8_t {
  u16,  ///< 65536 steps from the lowest to the highest of their component
  f16,  ///< half precision with 8 bits of fraction, times a scale; not a number stays what it is
  f32,
  f64,
  i32  ///< differences from the number before, the first from 0
};
std::string_view name_of(NumberType type) noexcept;

/// Numbers as bytes, and what it takes to read them.
struct PackedNumbers {
  NumberType type = NumberType::f32;
  std::string bytes;
  std::vector<double> low;           ///< of u16: of each component
  std::vector<double> high;          ///< likewise
  double scale = 1.0;                ///< of f16
  std::vector<std::uint16_t> steps;  ///< of u16: what the bytes are, one component after the other
};

/// @param values      `components` for each element, one element after the other. Of i32: whole
///                    numbers that int32 has.
/// @param components  > 0
PackedNumbers pack_numbers(std::span<const double> values, std::size_t components, NumberType type);

/// Values as their way from earlier ones, in steps of the box of those: 0, -1, 1, -2, ... stored as
/// 0, 1, 2, 3, ... in two bytes each. What hardly moves takes few bits.
/// @param before  u16, of as many components
/// @returns nothing where there are more or fewer values than before, a way is longer than 32767
///          steps, a component's box was more than twice as wide as it is, or a value is no number
std::optional<std::string> pack_ways(std::span<const double> values, std::size_t components,
                                     const PackedNumbers& before);

/// A number in half precision with 8 bits of fraction, rounded to nearest: a relative error of at
/// most 1/512 from 6e-5 to 65000. Beyond, the largest; not a number becomes one of those.
std::uint16_t half_of(double value) noexcept;

/// What zlib makes of bytes ("deflate" of browsers), as base64 without line ends.
/// @param width  of numbers whose bytes are sorted; lowest and higher bytes then have codes of their
///               own, where that is shorter
std::string deflated_text(std::string_view bytes, std::size_t width = 1);
/// Bytes of a number.
std::size_t width_of(NumberType type) noexcept;

}  // namespace plekton::apps
