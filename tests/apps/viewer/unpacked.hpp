// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// What a page reads from the text of a run, written anew from the description of the format.
namespace plekton::apps {

inline std::string from_base64(std::string_view text) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t group = 0;
  int digits = 0;
  for (const char c : text) {
    if (c == '=') break;
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string_view::npos) throw std::runtime_error("no base64");
    group = group << 6 | static_cast<std::uint32_t>(digit);
    if (++digits % 4 == 0)
      for (int k = 2; k >= 0; --k) bytes += static_cast<char>(group >> 8 * k & 0xff);
  }
  if (digits % 4 == 3) bytes += {static_cast<char>(group >> 10), static_cast<char>(group >> 2)};
  if (digits % 4 == 2) bytes += static_cast<char>(group >> 4);
  return bytes;
}

inline std::string inflated_text(std::string_view text) {
  const std::string packed = from_base64(text);
  for (uLongf size = 1 << 16;; size *= 4) {
    std::string bytes(size, '\0');
    uLongf written = size;
    const int outcome = uncompress(reinterpret_cast<Bytef*>(bytes.data()), &written,
                                   reinterpret_cast<const Bytef*>(packed.data()),
                                   static_cast<uLong>(packed.size()));
    if (outcome == Z_BUF_ERROR && size < (1UL << 30)) continue;
    if (outcome != Z_OK) throw std::runtime_error("not deflated");
    bytes.resize(written);
    return bytes;
  }
}

inline double from_half(std::uint64_t half) {
  const auto exponent = static_cast<int>(half >> 10 & 31);
  const auto fraction = static_cast<double>(half & 1023);
  if (exponent == 31) return std::numeric_limits<double>::quiet_NaN();
  const double size =
      exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024.0 + fraction, exponent - 25);
  return half & 0x8000 ? -size : size;
}

/// Two bytes of a number, as they are sorted.
inline std::int32_t word_of(const std::string& bytes, std::size_t i) {
  return static_cast<unsigned char>(bytes[i]) |
         static_cast<unsigned char>(bytes[bytes.size() / 2 + i]) << 8;
}

/// Steps of the box of earlier numbers, from the ways from there.
inline std::vector<double> unpacked_ways(const std::string& bytes, const std::string& before,
                                         const nlohmann::json& record) {
  const std::size_t total = bytes.size() / 2, components = record["components"];
  std::vector<double> values(total);
  for (std::size_t i = 0; i < total; ++i) {
    const std::size_t component = i / (total / components);
    const double low = record["lo"][component], high = record["hi"][component];
    const std::int32_t way = word_of(bytes, i);
    const std::int32_t steps = word_of(before, i) + (way % 2 == 0 ? way / 2 : -(way + 1) / 2);
    values[i % (total / components) * components + component] =
        low + (high - low) * steps / 65535.0;
  }
  return values;
}

/// The numbers of stored bytes, one element after the other.
inline std::vector<double> unpacked(const std::string& bytes, const nlohmann::json& record) {
  const std::string type = record["type"];
  const std::size_t width = type == "f64" ? 8 : type == "f32" || type == "i32" ? 4 : 2;
  const std::size_t total = bytes.size() / width, components = record["components"];
  const std::size_t count = total / components;
  std::vector<double> values(total);
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < total; ++i) {
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < width; ++k)
      bits |= std::uint64_t{static_cast<unsigned char>(bytes[k * total + i])} << (8 * k);
    const std::size_t component = i / count;
    double value = 0.0;
    if (type == "u16") {
      const double low = record["lo"][component], high = record["hi"][component];
      value = low + (high - low) * static_cast<double>(bits) / 65535.0;
    } else if (type == "f16") {
      value = from_half(bits) * record["scale"].get<double>();
    } else if (type == "f32") {
      value = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    } else if (type == "f64") {
      value = std::bit_cast<double>(bits);
    } else {
      sum += static_cast<std::uint32_t>(bits);
      value = static_cast<std::int32_t>(sum);
    }
    values[i % count * components + component] = value;
  }
  return values;
}

/// The blocks of a run by name.
class Blocks {
 public:
  void add(const std::string& name, const std::string& text) { text_[name] = text; }

  nlohmann::json directory(const std::string& name) const {
    const std::string& text = text_.at(name);
    return nlohmann::json::parse(inflated_text(std::string_view(text).substr(0, text.find('.'))));
  }

  std::vector<double> values(const nlohmann::json& record) const {
    const std::string bytes = bytes_at(record["at"]);
    return record.contains("key") ? unpacked_ways(bytes, bytes_at(record["key"]), record)
                                  : unpacked(bytes, record);
  }

  /// An array of a series of a block. @throws std::out_of_range
  nlohmann::json record(const std::string& block, const std::string& series, const std::string& on,
                        const std::string& name) const {
    const nlohmann::json all = directory(block);
    for (const auto& record : all.at(series))
      if (record["on"] == on && record["name"] == name) return record;
    throw std::out_of_range(name);
  }

 private:
  std::string bytes_at(const nlohmann::json& at) const {
    const std::string& text = text_.at(at[0]);
    return inflated_text(
        text.substr(text.find('.') + 1 + at[1].get<std::size_t>(), at[2].get<std::size_t>()));
  }

  std::map<std::string, std::string> text_;
};

}  // namespace plekton::apps
