// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/viewer/packing.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <utility>

namespace plekton::apps {
namespace {

constexpr double kNoWay = std::numeric_limits<double>::infinity();
constexpr double kLargestHalf = 60000.0;  // below the largest number of half precision, 65504

/// Bytes of whole numbers or bit patterns, the lowest ones first.
template <class Bits>
std::string sorted_bytes(const std::vector<Bits>& numbers) {
  std::string bytes(numbers.size() * sizeof(Bits), '\0');
  for (std::size_t k = 0; k < sizeof(Bits); ++k)
    for (std::size_t i = 0; i < numbers.size(); ++i)
      bytes[k * numbers.size() + i] = static_cast<char>(numbers[i] >> (8 * k) & 0xff);
  return bytes;
}

/// One component after the other.
std::vector<double> by_component(std::span<const double> values, std::size_t components) {
  const std::size_t count = values.size() / components;
  std::vector<double> sorted(values.size());
  for (std::size_t c = 0; c < components; ++c)
    for (std::size_t i = 0; i < count; ++i) sorted[c * count + i] = values[i * components + c];
  return sorted;
}

void pack_steps(std::span<const double> values, std::size_t components, PackedNumbers& packed) {
  const std::size_t count = values.size() / components;
  std::vector<std::uint16_t>& steps = packed.steps;
  steps.reserve(values.size());
  for (std::size_t c = 0; c < components; ++c) {
    const auto own = values.subspan(c * count, count);
    double low = 0.0, high = 0.0;
    bool is_first = true;
    for (const double x : own) {
      if (!std::isfinite(x)) continue;
      low = is_first ? x : std::min(low, x);
      high = is_first ? x : std::max(high, x);
      is_first = false;
    }
    packed.low.push_back(low);
    packed.high.push_back(high);
    for (const double x : own) {
      const double share = high > low && std::isfinite(x) ? (x - low) / (high - low) : 0.0;
      steps.push_back(static_cast<std::uint16_t>(std::lround(65535.0 * share)));
    }
  }
  packed.bytes = sorted_bytes(steps);
}

void pack_halves(std::span<const double> values, PackedNumbers& packed) {
  double largest = 0.0;
  for (const double x : values)
    if (std::isfinite(x)) largest = std::max(largest, std::abs(x));
  if (largest > 0.0) packed.scale = largest / kLargestHalf;
  std::vector<std::uint16_t> halves;
  halves.reserve(values.size());
  for (const double x : values) halves.push_back(half_of(x / packed.scale));
  packed.bytes = sorted_bytes(halves);
}

template <class Stored, class Bits>
std::string bit_patterns(std::span<const double> values) {
  std::vector<Bits> patterns;
  patterns.reserve(values.size());
  for (const double x : values) patterns.push_back(std::bit_cast<Bits>(static_cast<Stored>(x)));
  return sorted_bytes(patterns);
}

std::string differences(std::span<const double> values) {
  std::vector<std::uint32_t> differences;
  differences.reserve(values.size());
  std::uint32_t before = 0;
  for (const double x : values) {
    constexpr double kLeast = std::numeric_limits<std::int32_t>::min();
    constexpr double kMost = std::numeric_limits<std::int32_t>::max();
    const auto number = static_cast<std::uint32_t>(
        std::isnan(x) ? 0 : static_cast<std::int32_t>(std::clamp(x, kLeast, kMost)));
    differences.push_back(number - before);  // modulo 2^32, and so is the sum
    before = number;
  }
  return sorted_bytes(differences);
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    const std::size_t left = std::min<std::size_t>(bytes.size() - i, 3);
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < left ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= left ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

/// @param parts  equal ones, each with a code of its own
std::string deflated(std::string_view bytes, std::size_t parts, int strategy) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, MAX_WBITS, MAX_MEM_LEVEL, strategy) !=
      Z_OK)
    throw std::bad_alloc();  // zlib fails for no other reason here
  std::string packed(deflateBound(&stream, static_cast<uLong>(bytes.size())) + 64 * parts, '\0');
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const std::size_t length = bytes.size() / parts;
  int outcome = Z_OK;
  for (std::size_t part = 0; part < parts; ++part) {
    const bool is_last = part + 1 == parts;
    const std::string_view own = bytes.substr(part * length, is_last ? bytes.npos : length);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(own.data()));
    stream.avail_in = static_cast<uInt>(own.size());
    outcome = deflate(&stream, is_last ? Z_FINISH : Z_BLOCK);
  }
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (outcome != Z_STREAM_END) throw std::logic_error("zlib asks for more room than it said");
  return packed;
}

}  // namespace

std::size_t width_of(NumberType type) noexcept {
  constexpr std::array<std::size_t, 5> kWidths = {2, 2, 4, 8, 4};
  return kWidths[static_cast<std::size_t>(type)];
}

std::string_view name_of(NumberType type) noexcept {
  constexpr std::array<std::string_view, 5> kNames = {"u16", "f16", "f32", "f64", "i32"};
  return kNames[static_cast<std::size_t>(type)];
}

PackedNumbers pack_numbers(std::span<const double> values, std::size_t components,
                           NumberType type) {
  PackedNumbers packed;
  packed.type = type;
  const std::vector<double> sorted = by_component(values, components);
  switch (type) {
    case NumberType::u16:
      pack_steps(sorted, components, packed);
      break;
    case NumberType::f16:
      pack_halves(sorted, packed);
      break;
    case NumberType::f32:
      packed.bytes = bit_patterns<float, std::uint32_t>(sorted);
      break;
    case NumberType::f64:
      packed.bytes = bit_patterns<double, std::uint64_t>(sorted);
      break;
    case NumberType::i32:
      packed.bytes = differences(sorted);
      break;
  }
  return packed;
}

std::optional<std::string> pack_ways(std::span<const double> values, std::size_t components,
                                     const PackedNumbers& before) {
  const std::size_t count = values.size() / components;
  if (before.steps.size() != values.size()) return std::nullopt;
  std::vector<std::uint16_t> ways;
  ways.reserve(values.size());
  for (std::size_t c = 0; c < components; ++c) {
    const double low = before.low[c], width = before.high[c] - low;
    double least = low, most = low;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = values[i * components + c];
      least = i == 0 ? x : std::min(least, x);
      most = i == 0 ? x : std::max(most, x);
      // All in one place have no width, and then no step to tell another place in.
      const double steps = width > 0.0 ? 65535.0 * ((x - low) / width) : x == low ? 0.0 : kNoWay;
      const double way = std::round(steps) - before.steps[c * count + i];
      if (!(std::abs(way) <= 32767.0)) return std::nullopt;
      ways.push_back(static_cast<std::uint16_t>(way < 0.0 ? -2.0 * way - 1.0 : 2.0 * way));
    }
    if (width > 2.0 * (most - least)) return std::nullopt;
  }
  return sorted_bytes(ways);
}

// An exponent from 1 to 30 (bias 15) and 10 bits of fraction, of which the last two stay 0; below
// 2^-14 the exponent is 0 and the fraction counts steps of 2^-24. A fraction that is rounded up to
// 1 carries over into the exponent, as it should. Source: IEEE 754-2019, binary16.
std::uint16_t half_of(double value) noexcept {
  if (std::isnan(value)) return 0x7e00;
  const std::uint16_t sign = std::signbit(value) ? 0x8000 : 0;
  const double size = std::min(std::abs(value), kLargestHalf);
  if (size == 0.0) return sign;
  int exponent = 0;
  const double fraction = std::frexp(size, &exponent);  // in [0.5, 1), times 2^exponent
  long bits = 0;
  if (exponent + 14 >= 1) {
    bits = ((exponent + 14L) << 10) + (std::lround((2.0 * fraction - 1.0) * 256.0) << 2);
  } else {
    bits = std::lround(size * 0x1p22) << 2;
  }
  return static_cast<std::uint16_t>(sign | bits);
}

std::string deflated_text(std::string_view bytes, std::size_t width) {
  std::string shortest = deflated(bytes, 1, Z_DEFAULT_STRATEGY);
  if (width > 1)
    if (std::string other = deflated(bytes, width, Z_FILTERED); other.size() < shortest.size())
      shortest = std::move(other);
  return base64(shortest);
}

}  // namespace plekton::apps
